"""The workflow: plans, reruns, one full run on small settings, settings that are wrong, interrupted runs."""

import os
import re
import signal
import subprocess
import sys
import time
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
import xarray as xr
import yaml

from support.workflow import (
    ROOT,
    TEST,
    command,
    copy_project,
    environment,
    jobs,
    load_script,
    merged,
    plan,
    read_settings,
    settings_file,
    snakemake,
)
from viscorough.surfaces import cut_disc, self_affine_square
from viscorough_study.seeds import realization_seed

FIT_AND_FIGURES = {"fit_scaling", "plot_kinetics", "plot_master_curve", "plot_exponent", "plot_conventions"}
FIT_AND_FIGURES |= {"judge_claims", "compare_prefactors", "tabulate_calibration"}
FITS = {name for name in FIT_AND_FIGURES if not name.startswith("plot_")}
VALIDATION = {"validate", "check_validation", "judge_claims"}
FIGURES = ("fig1_surfaces", "fig2_kinetics", "fig3_master_curve", "fig4_exponent", "conventions", "validation")
FIGURES += ("prefactors", "direct", "reduction")


STABILITY = dict.fromkeys(("measure_stability", "measure_stability_curves", "plot_stability"), 1)


# ---- a full run


def test_everything_is_made_from_nothing(finished):
    results = finished / "results"
    for figure in FIGURES:
        assert (results / f"figures/{figure}.png").read_bytes().startswith(b"\x89PNG")
        assert (results / f"figures/{figure}.pdf").read_bytes().startswith(b"%PDF")
    for table in ("scaling", "validation"):
        csv = pd.read_csv(results / f"tables/{table}.csv")
        with xr.open_dataset(results / f"tables/{table}.nc") as nc:
            assert set(nc.data_vars) == set(csv.columns)
    assert (results / "tables/validation_passed.txt").read_text().startswith("sphere force\n")


def test_surfaces_of_ensembles_do_not_stay(finished):
    assert not list((finished / "results/surfaces").rglob("*-*.nc"))
    assert (finished / "results/surfaces/examples.nc").is_file()


def test_nothing_half_written_stays(finished):
    assert not list((finished / "results").rglob("*.part"))


def test_every_job_has_a_log_and_a_benchmark(finished):
    logs = {
        path.relative_to(finished / "results/logs").with_suffix("") for path in finished.rglob("results/logs/**/*.log")
    }
    benchmarks = {
        path.relative_to(finished / "results/benchmarks").with_suffix("")
        for path in finished.rglob("results/benchmarks/**/*.tsv")
    }
    assert logs == benchmarks
    assert len(logs) == 39


def test_prices_are_those_of_the_jobs(finished, tmp_path):
    load_script("tabulate_prices").main(
        tmp_path / "prices.csv", tmp_path / "prices.nc", benchmarks=finished / "results/benchmarks"
    )
    table = pd.read_csv(tmp_path / "prices.csv").set_index("rule")
    assert table["jobs"].sum() == 39
    assert table.loc["indent_discs", "jobs"] == 6
    assert (table["longest_s"] <= table["seconds"]).all()
    assert table["seconds"].is_monotonic_decreasing


def test_scaling_table_has_every_ensemble(finished):
    table = pd.read_csv(finished / "results/tables/scaling.csv")
    found = set(table[["source", "case_group", "hurst"]].itertuples(index=False, name=None))
    assert found == {
        (source, group, hurst)
        for source, group in (("discs", "base"), ("discs", "longer_period"), ("lines", "base"))
        for hurst in (0.4, 0.9)
    }
    # Both combinations are pooled; only discs of the base group have lines to compare with.
    assert set(table.loc[table["case_group"] == "base"].query("source == 'discs'")["realizations"]) == {4}
    with_lambda = table.dropna(subset=["lambda"])
    assert set(with_lambda["source"]) == {"discs"}
    assert set(with_lambda["case_group"]) == {"base"}


def test_combinations_are_in_real_units(finished):
    with xr.open_dataset(finished / "results/curves/discs/h04000_c9/0000-0001.nc") as curves:
        assert curves["diameter"] == 0.03
        assert curves["spacing"].item() == pytest.approx(0.03 / 33)
        np.testing.assert_allclose(curves["rms_disc"], 3e-7)
        assert curves["force"].attrs["units"] == "m2"
        assert "spawn_key" in curves.attrs["settings"]


def test_kernels_are_compiled_before_the_jobs(finished):
    """Once for these sources: the stamp holds their digests."""
    assert re.fullmatch(r"[0-9a-f]{16} [0-9a-f]{16}", (finished / ".snakemake/kernels").read_text())
    assert list((finished / "src/viscorough/contact/__pycache__").glob("grid_solver.*.nbi"))
    assert list((finished / "src/viscorough/__pycache__").glob("mdr.*.nbi"))


def test_again_there_is_nothing_to_be_done(finished):
    assert plan(finished, *TEST) == {}


def test_report(finished):
    snakemake(finished, *TEST, "--report", "results/report.html")
    page = (finished / "results/report.html").read_text()
    for text in ("fig4_exponent.png", "scaling.csv", "Beyond the paper", "collapse"):
        assert text in page


# ---- what a change reruns


def test_speed_is_a_target_of_its_own(fresh):
    planned = plan(fresh, *TEST, "--", "speed")
    once = dict.fromkeys(("tabulate_methods", "race_peers", "compare_scenes", "plot_methods"), 1)
    assert planned == once | {"measure_methods": 3}  # sphere, cone, one rough disc
    assert not set(planned) & set(plan(fresh, *TEST))


def test_stability_is_a_target_of_its_own(fresh):
    assert plan(fresh, *TEST, "--", "stability") == STABILITY
    assert not set(STABILITY) & set(plan(fresh, *TEST))


def test_stability(fresh):
    """From scripts to figures, on the smallest maps."""
    snakemake(fresh, *TEST, "--", "stability")
    for figure in ("stability", "stability_curves"):
        for kind in ("png", "pdf"):
            assert (fresh / f"results/figures/{figure}.{kind}").stat().st_size > 5000
    table = pd.read_csv(fresh / "results/tables/stability.csv")
    with xr.open_dataset(fresh / "results/tables/stability.nc") as nc:
        assert nc["verdict"].values.tolist() == table["verdict"].tolist()
    assert "unnoticed" not in set(table["verdict"])


def test_sizes_and_large_discs(fresh):
    """Ensembles on grids of their own, fitted and plotted; cost of one disc."""
    planned = plan(fresh, *TEST, "--", "sizes", "large")
    assert planned["indent_discs"] == 2 * planned["indent_lines"] == 2 * planned["measure_large"] == 4
    assert not set(planned) & {"fit_sizes", "plot_sizes", "measure_large"} & set(plan(fresh, *TEST))
    snakemake(fresh, *TEST, "--", "sizes", "large")
    sizes = pd.read_csv(fresh / "results/tables/sizes.csv")
    discs = sizes[(sizes["source"] == "discs") & (sizes["case_group"] == "sizes")]
    assert sorted(set(sizes.loc[sizes["case_group"] == "controls", "elements"])) == sorted(set(discs["elements"]))
    assert "finding" in pd.read_csv(fresh / "results/tables/sizes_trends.csv")
    assert sorted(set(discs["elements"])) == [int(disc_elements(n)) for n in (17, 33)]
    assert sorted(set(sizes.loc[sizes["source"] == "lines", "elements"])) == [64, 1024]
    costs = pd.read_csv(fresh / "results/tables/large.csv")
    assert costs["across"].tolist() == [17, 33]
    assert (costs["memory"] > 1e7).all()
    for figure in ("sizes", "large"):
        for kind in ("png", "pdf"):
            assert (fresh / f"results/figures/{figure}.{kind}").stat().st_size > 5000


def disc_elements(across):
    return np.isfinite(cut_disc(np.zeros((across, across)), across)).sum()


def test_speed_without_other_solvers(fresh):
    """Scenes and tables of few methods, from their scripts to the figures."""
    tasks = [{"name": "few", "elements": 17, "levels": 3, "fractions": [0.02, 0.5], "residual": 1e-6, "threads": [1]}]
    few = {"elements": [9], "bodies_elements": [9], "tasks": tasks, "scenes": {"elements": 17, "hurst": 0.7}}
    snakemake(fresh, *TEST, settings_file(fresh, "few", methods=few), "--", "speed")
    for figure in ("speed", "growth", "peers", "scenes"):
        for kind in ("png", "pdf"):
            assert (fresh / f"results/figures/{figure}.{kind}").stat().st_size > 5000
    methods = pd.read_csv(fresh / "results/tables/methods.csv")
    assert set(methods["problem"]) == {"sphere", "cone", "rough disc, H = 0.4"}
    assert not (methods["group"] == "other solver").any()
    with xr.open_dataset(fresh / "results/tables/peers.nc") as peers:
        assert "cores" in peers.attrs["title"]
        assert peers["solver"].values.tolist() == ["viscorough"]
    assert "is not installed: left out" in (fresh / "results/logs/race_peers.log").read_text()


@pytest.mark.parametrize(
    ("changed", "rerun"),
    [
        ({"scaling": {"stiffness_max": 0.25}}, FIT_AND_FIGURES),
        ({"figures": {"average": "arithmetic"}}, FIT_AND_FIGURES - {"fit_scaling"}),
        ({"ensemble": {"per_decade": 25}}, FIT_AND_FIGURES | {"aggregate_discs", "aggregate_lines"}),
        ({"validation": {"elements": [17, 31]}}, {"validate", "check_validation", "plot_validation", "judge_claims"}),
        ({"lines": {"points": 2048}}, FIT_AND_FIGURES | {"indent_lines", "aggregate_lines"}),
        (
            {"indentation": {"tolerance": 2e-3}},
            FIT_AND_FIGURES | {"generate_discs", "indent_discs", "aggregate_discs", "compare_reduction"},
        ),
        (
            {"surface": {"period": 1.5}},  # not of the variant that has a period of its own, nor of lines
            FIT_AND_FIGURES
            | {"generate_discs", "indent_discs", "aggregate_discs", "generate_example_discs", "plot_surfaces"},
        ),
    ],
    ids=lambda value: next(iter(value)) if isinstance(value, dict) else "",
)
def test_a_changed_setting_reruns_what_uses_it(finished, changed, rerun):
    planned = plan(finished, *TEST, settings_file(finished, "changed", **changed))
    assert set(planned) == rerun
    if "surface" in changed:
        assert planned["indent_discs"] == 4


def test_a_further_exponent_reruns_only_what_depends_on_it(finished):
    more = settings_file(finished, "more", discs={"hurst": [0.4, 0.6, 0.9]}, lines={"hurst": [0.4, 0.6, 0.9]})
    text = snakemake(finished, "--dry-run", *TEST, more)
    cases = set(re.findall(r"^Job \d+: .*\b(h\d{5}\w*)", text, re.MULTILINE))
    assert cases == {"h06000", "h06000_c1", "h06000_c9", "h06000_longer_period"}
    planned = jobs(text)
    assert planned["generate_discs"] == planned["indent_discs"] == planned["aggregate_discs"] == 3
    assert planned["aggregate_lines"] == 1
    assert "validate" not in planned


def test_more_realizations_keep_those_that_are_there(finished):
    planned = plan(finished, *TEST, settings_file(finished, "more", discs={"realizations": 4}))
    assert planned["indent_discs"] == 4  # the second batch of each of the four cases


@pytest.mark.parametrize(
    ("module", "rerun"),
    [
        ("viscorough_study/power_law", FITS),
        ("viscorough_study/validate_solvers", VALIDATION),
        ("viscorough/mdr", FITS | VALIDATION | {"indent_lines", "aggregate_lines", "compare_reduction"}),
        (
            "viscorough/contact/loading_path",
            FITS
            | VALIDATION
            | {"generate_discs", "indent_discs", "aggregate_discs", "compare_reduction", "compare_direct"},
        ),
    ],
)
def test_an_edit_of_the_package_reruns_what_imports_it(finished, module, rerun):
    path = finished / "src" / f"{module}.py"
    text, times = path.read_text(), path.stat()
    path.write_text(text + "# edited\n")
    try:
        planned = plan(finished, *TEST)
    finally:
        path.write_text(text)
        os.utime(path, ns=(times.st_atime_ns, times.st_mtime_ns))
    assert {name for name in planned if not name.startswith("plot_")} == rerun


def test_forcing_one_rule(finished):
    assert plan(finished, *TEST, "--forcerun", "plot_exponent") == {"plot_exponent": 1}


def test_one_figure_by_name(finished):
    figures = [finished / f"results/figures/{name}.png" for name in ("fig4_exponent", "fig1_surfaces")]
    times = [figure.stat().st_mtime_ns for figure in figures]
    figures[0].unlink()
    snakemake(finished, *TEST, "--", "figure_4")
    assert figures[0].stat().st_mtime_ns > times[0]
    assert figures[1].stat().st_mtime_ns == times[1]


def test_one_figure_needs_only_its_own(fresh):
    assert plan(fresh, *TEST, "--", "figure_1") == {"generate_example_discs": 1, "plot_surfaces": 1}


# ---- plans and form


@pytest.mark.parametrize(
    ("name", "numbers"),
    [
        ("config", {"indent_discs": 4 * (9 + 4), "indent_lines": 21, "aggregate_discs": 4 * (9 + 4)}),
        ("paper", {"indent_discs": 4 * (9 * 2 + 4 * 2), "indent_lines": 101, "aggregate_discs": 4 * (9 + 4)}),
        ("test", {"indent_discs": 2 * (2 + 1), "indent_lines": 2 * 2, "aggregate_discs": 2 * (2 + 1)}),
    ],
)
def test_plans_of_every_scale(fresh, name, numbers):
    planned = plan(fresh, "--configfile", f"config/{name}.yaml")
    assert {rule: planned[rule] for rule in numbers} == numbers
    assert planned["check_validation"] == planned["fit_scaling"] == 1


def test_lint(fresh):
    assert "good condition" in snakemake(fresh, "--lint")


def test_format():
    done = subprocess.run(
        [sys.executable, "-m", "snakefmt", "--check", "Snakefile", "workflow"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert done.returncode == 0, done.stderr


def test_scripts_are_short_and_named_like_their_rules():
    scripts = {path.stem: path.read_text() for path in (ROOT / "workflow/scripts").glob("*.py")}
    rules = set()
    for path in (ROOT / "workflow/rules").glob("*.smk"):
        for rule, script in re.findall(r"rule (\w+):.*?scripts/(\w+)\.py", path.read_text(), re.DOTALL):
            assert rule == script
            rules.add(rule)
    assert rules == set(scripts)
    for name, text in scripts.items():
        assert text.count("\n") <= 40, name


def test_functions_stand_apart_from_rules():
    for path in [ROOT / "Snakefile", *(ROOT / "workflow/rules").glob("*.smk")]:
        assert ("def " in path.read_text()) == (path.name in ("common.smk", "settings.smk"))


def test_slurm_profile(fresh):
    """It names rules that there are, and plans what a local run does; without its executor, which is not installed."""
    profile = yaml.safe_load((ROOT / "profiles/slurm/config.yaml").read_text())
    rules = {path.stem for path in (ROOT / "workflow/scripts").glob("*.py")}
    for key in ("groups", "set-resources", "set-threads"):
        assert set(profile[key]) <= rules, key
    assert profile.pop("executor") == "slurm"
    (fresh / "local").mkdir()
    (fresh / "local/config.yaml").write_text(yaml.safe_dump(profile))
    assert plan(fresh, *TEST, "--profile", "local", "--", "all", "speed") == plan(fresh, *TEST, "--", "all", "speed")


def test_slurm_lock_goes_with_the_other_lock():
    """Both are installed into one environment, so no package may stand in both; and no address may stand in either."""
    names = {}
    for name in ("requirements.lock", "requirements-slurm.lock"):
        text = (ROOT / name).read_text()
        names[name] = set(re.findall(r"^([\w.-]+)==", text, re.MULTILINE))
        assert "://" not in text
    assert "snakemake-executor-plugin-slurm" in names["requirements-slurm.lock"]
    assert not set.intersection(*names.values())


# ---- interrupted and failing runs


def test_a_killed_run_leaves_nothing_half_written_and_goes_on(tmp_path):
    folder = copy_project(tmp_path)
    long = settings_file(
        folder, "long", lines={"hurst": [0.4, 0.9], "points": 65536, "realizations": 300, "batch": 100}
    )
    target = "results/ensembles/lines/h09000.nc"
    finished = [folder / f"results/curves/lines/h09000/{batch}.nc" for batch in ("0000-0099", "0100-0199", "0200-0299")]
    run = subprocess.Popen(
        command(*TEST, long, "--cores", "1", "--", target),
        cwd=folder,
        env=environment(folder),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    deadline = time.monotonic() + 120
    while sum(path.exists() for path in finished) < 1 or not running(folder):
        assert time.monotonic() < deadline
        assert run.poll() is None
        time.sleep(0.02)
    os.killpg(run.pid, signal.SIGKILL)
    run.wait()
    done = [path for path in finished if path.exists()]
    assert 1 <= len(done) < 3
    assert not (folder / target).exists()
    before = {path: path.read_bytes() for path in done}
    for path in done:
        with xr.open_dataset(path) as curves:
            assert curves.sizes["realization"] == 100

    snakemake(folder, *TEST, long, "--unlock")
    snakemake(folder, *TEST, long, "--", target)
    with xr.open_dataset(folder / target) as ensemble:
        assert ensemble.sizes["realization"] == 300
    for path, content in before.items():
        assert path.read_bytes() == content
    assert not list((folder / "results").rglob("*.part"))


def running(folder):
    """Whether a job is under way that has logged its start but is not known to be finished."""
    logs = set((folder / "results/logs/indent_lines").rglob("*.log"))
    return len(logs) > len(list((folder / "results/curves/lines").rglob("*.nc")))


def test_a_failed_comparison_stops_the_workflow_and_is_named(finished):
    strict = settings_file(finished, "strict", validation={"limits": {"area": 1e-4}})
    text = snakemake(finished, *TEST, strict, "--directory", "strict", "--", "validation", fails=True)
    assert "validation failed, see results/tables/validation.csv: sphere area: error" in text
    assert "cone area" in text
    table = pd.read_csv(finished / "strict/results/tables/validation.csv")
    assert not table.loc[table["quantity"] == "area", "passed"].any()
    assert not (finished / "strict/results/tables/validation_passed.txt").exists()


# ---- settings


WRONG = [
    ({"discs": {"elemnts": 33}}, "unknown key elemnts in discs; did you mean elements?"),
    ({"colour": "blue"}, "unknown key colour; allowed: discs, ensemble"),
    ({"discs": {"elements": "many"}}, "discs.elements is 'many'; allowed: a whole number from 9 up to 4097"),
    ({"discs": {"elements": 33.0}}, "discs.elements is 33.0; allowed: a whole number"),
    ({"discs": {"realizations": True}}, "discs.realizations is True; allowed: a whole number"),
    ({"discs": {"hurst": [0.4, 1.2]}}, "discs.hurst[1] is 1.2; allowed: a number from 0 up to 1 (Hurst exponent H)"),
    ({"discs": {"hurst": []}}, "discs.hurst is []; allowed: a list of at least 1"),
    ({"discs": None}, "discs is empty; allowed: keys with values"),
    ({"discs": [1, 2]}, "discs is [1, 2]; allowed: keys with values"),
    ({"indentation": {"tolerance": "1e-3"}}, "numbers are written as 1.0e-3, with a point"),
    ({"indentation": {"until_x": float("nan")}}, "indentation.until_x is nan; allowed: a number above 0"),
    ({"surface": {"amplitudes": "constant"}}, "surface.amplitudes is 'constant'; allowed: one of random, fixed"),
    ({"surface": {"corners": 1}}, "surface.corners is 1; allowed: true or false"),
    ({"seed": -1}, "seed is -1; allowed: a whole number from 0"),
    ({"discs": {"combinations": [{"number": 1, "force": 1.0}]}}, "viscosity in discs.combinations[0] is missing"),
    (
        {"variants": {"cases": [{"name": "nothing"}]}},
        "variants.cases[0] is {'name': 'nothing'}; allowed: keys with values",
    ),
    ({"variants": {"cases": [{"name": "Bad 1", "period": 2.0}]}}, "variants.cases[0].name is 'Bad 1'; allowed: text"),
    ({"discs": {"hurst": [0.4, 0.4]}}, "discs.hurst 0.4 stands twice; allowed: each once"),
    ({"sizes": {"elements": [17, 257]}}, "roll_off_wavelength 0.0625 of sizes.control is too short"),
    ({"discs": {"hurst": [0.4, 0.33]}}, "discs.hurst has 0.33, lines.hurst has not"),
    ({"lines": {"hurst": [0.12345]}}, "lines.hurst has 0.12345; allowed: at most four decimals"),
    ({"ensemble": {"x_low": 40.0}}, "ensemble.x_low and x_high: 40.0 and 30.0 are no range"),
    ({"scaling": {"stiffness_range": [0.3, 0.03]}}, "scaling.stiffness_range: 0.3 and 0.03 are no range"),
    ({"surface": {"roll_off_wavelength": 0.001}}, "roll_off_wavelength 0.001 of surface is too short"),
]


@pytest.mark.parametrize(("wrong", "message"), WRONG, ids=[message[:30] for _, message in WRONG])
def test_wrong_settings_end_with_one_line(common, settings, wrong, message):
    with pytest.raises(SystemExit) as stopped:
        common.check_settings(merged(settings, wrong))
    text = str(stopped.value)
    assert text.startswith("Error in the settings: ")
    assert message in text
    assert "\n" not in text
    assert len(text) < 250


def test_twice_the_same_combination(common, settings):
    settings["discs"]["combinations"][1]["number"] = 1
    with pytest.raises(SystemExit, match=r"number in discs.combinations 1 stands twice"):
        common.check_settings(settings)


def test_too_rough_a_combination(common, settings):
    settings["discs"]["combinations"][0]["rms"] = 1e-3
    with pytest.raises(SystemExit, match=r"rms 0.001 in combination 1 .* allowed: below diameter/100"):
        common.check_settings(settings)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("discs: {elemnts: 33}\n", "unknown key elemnts in discs; did you mean elements?"),
        ("indentation: {tolerance: 1e-3}\n", "indentation.tolerance is '1e-3'; allowed: a number"),
        ("discs: {hurst: [0.4, 1.5]}\n", "discs.hurst[1] is 1.5; allowed: a number from 0 up to 1"),
        ("# nothing\n", "Config file must be given as JSON or YAML with keys at top level."),
    ],
    ids=["misspelt", "type", "range", "empty"],
)
def test_snakemake_shows_one_line_and_no_traceback(fresh, text, message):
    (fresh / "wrong.yaml").write_text(text)
    shown = snakemake(fresh, "--dry-run", "--configfile", "wrong.yaml", fails=True)
    about = [line for line in shown.splitlines() if message in line]
    assert len(about) == 1
    assert "Traceback" not in shown
    assert "File " not in shown
    # besides it: which profile is in use, that the file extends the default one, or the kind of error
    assert len(shown.splitlines()) <= 3


@pytest.mark.parametrize("name", ["config", "paper", "large", "test"])
def test_settings_of_every_scale_are_right(common, name):
    common.check_settings(merged(read_settings("config"), read_settings(name)))


@pytest.mark.parametrize("name", ["paper", "large", "test"])
def test_other_scales_hold_only_what_differs(settings, name):
    def same(base, extra, path=""):
        for key, value in extra.items():
            if isinstance(value, dict):
                yield from same(base[key], value, f"{path}{key}.")
            elif value == base[key]:
                yield path + key

    assert list(same(settings, read_settings(name))) == []


def test_paper_is_the_scale_of_the_paper():
    paper = merged(read_settings("config"), read_settings("paper"))
    assert paper["discs"]["hurst"] == [0.1, 0.4, 0.6, 0.9]
    assert paper["discs"]["elements"] == 257
    assert len(paper["discs"]["hurst"]) * len(paper["discs"]["combinations"]) == 36
    assert paper["discs"]["realizations"] == 80
    np.testing.assert_allclose(paper["lines"]["hurst"], np.linspace(0, 1, 101), atol=1e-12)
    assert (paper["lines"]["realizations"], paper["lines"]["points"]) == (500, 4_000_000)


def test_combinations_span_decades(settings):
    combinations = pd.DataFrame(settings["discs"]["combinations"])
    assert len(combinations) == 9
    quantities = np.log10(combinations[["force", "viscosity", "diameter", "rms"]])
    assert (quantities.max() - quantities.min() >= 2).all()
    assert np.linalg.matrix_rank(quantities - quantities.mean()) == 4  # none is a power of the others
    assert (combinations["rms"] / combinations["diameter"] <= 1e-4).all()


def leaves(rule, definitions, path=""):
    """(key, schema) of every setting, lists of mappings as key[]."""
    if "$ref" in rule:
        rule = definitions[rule["$ref"].split("/")[-1]]
    if path:
        yield path, rule
    for name, inner in rule.get("properties", {}).items():
        yield from leaves(inner, definitions, f"{path}.{name}".lstrip("."))
    if rule.get("items", {}).get("type") == "object":
        yield from leaves(rule["items"], definitions, f"{path}[]")


@pytest.fixture(scope="session")
def schema():
    content = yaml.safe_load((ROOT / "workflow/schemas/config.schema.yaml").read_text())
    return dict(leaves(content, content["$defs"]))


def test_schema_describes_every_key(schema):
    assert len(schema) > 50
    for key, rule in schema.items():
        assert rule["description"], key
        if "properties" in rule:
            assert rule["additionalProperties"] is False, key
        elif rule.get("type") == "array":
            assert "maxItems" in rule, key
        else:
            assert rule["unit"], key
            limited = {"enum", "pattern"} & set(rule) or rule["type"] == "boolean"
            assert limited or ({"maximum"} < {*rule} and {"minimum", "exclusiveMinimum"} & set(rule)), key


def test_readme_explains_every_key(schema):
    text = (ROOT / "config/README.md").read_text().split("## Keys")[1]
    explained = re.findall(r"^\| `(.+?)` \|", text, re.MULTILINE)
    wanted = {key for key, rule in schema.items() if "properties" not in rule}
    assert set(explained) == wanted
    assert len(explained) == len(wanted)


# ---- cases, batches, digests


def test_batches(common):
    assert common.batches({"realizations": 10, "batch": 4}) == ["0000-0003", "0004-0007", "0008-0009"]
    assert common.batches({"realizations": 2, "batch": 8}) == ["0000-0001"]
    assert common.realizations(SimpleNamespace(batch="0008-0009")) == [8, 10]


def test_spawn_keys_do_not_depend_on_order(common, settings):
    discs, lines = common.disc_cases(settings), common.line_cases(settings)
    keys = [tuple(case["spawn_key"]) for case in (discs | lines).values()]
    assert len(set(keys)) == len(keys) == 4 * 13 + 21 + 5 * (5 + 9) + 5
    assert discs["h01000_c3"]["spawn_key"] == [1, 100000, 3]
    assert lines["h01000"]["spawn_key"] == [3, 100000]
    assert discs["h01000_n257"]["spawn_key"] == [8, 100000, 257]
    assert lines["h01000_n4096"]["spawn_key"] == [9, 100000, 4096]
    settings["discs"]["hurst"].reverse()
    settings["discs"]["combinations"].reverse()
    settings["variants"]["cases"] = settings["variants"]["cases"][::-1]
    settings["sizes"]["elements"] = settings["sizes"]["elements"][::-1]
    assert common.disc_cases(settings) == discs


def test_a_realization_is_the_same_in_every_batch(tmp_path, common, settings):
    """Surfaces, loading curves of discs and of lines."""
    discs = common.disc_cases(settings)["h04000_c3"]
    about = {"seed": 7, "spawn_key": discs["spawn_key"], "elements": 17, "surface": discs["surface"]}
    lines = common.line_cases(settings)["h04000"]
    line = {"seed": 7, "spawn_key": lines["spawn_key"], "points": 512, "surface": lines["surface"], "until_x": 30.0}
    for name, realizations in (("all", [0, 3]), ("last", [2, 3])):
        load_script("generate_discs").main(tmp_path / f"s_{name}.nc", realizations=realizations, **about)
        limits = {"tolerance": 1e-3, "until_fraction": 0.5, "until_x": 30.0}
        load_script("indent_discs").main(tmp_path / f"s_{name}.nc", tmp_path / f"d_{name}.nc", **limits)
        load_script("indent_lines").main(tmp_path / f"l_{name}.nc", realizations=realizations, **line)
    for kind, variable in (("s", "heights"), ("d", "force"), ("l", "force")):
        with (
            xr.open_dataset(tmp_path / f"{kind}_all.nc") as every,
            xr.open_dataset(tmp_path / f"{kind}_last.nc") as last,
        ):
            one, other = every[variable].sel(realization=2).values, last[variable].sel(realization=2).values
            np.testing.assert_array_equal(one[np.isfinite(one)], other[np.isfinite(other)])
            assert not np.array_equal(
                one[np.isfinite(one)], every[variable].isel(realization=0).values[np.isfinite(one)]
            )


@pytest.mark.parametrize("rms_over", ["disc", "square"])
def test_both_rms_heights_are_those_of_the_surface(tmp_path, rms_over):
    surface = {"hurst": 0.4, "rms": 2e-6, "diameter": 1e-2, "period": 2.0, "rms_over": rms_over}
    load_script("generate_discs").main(
        tmp_path / "s.nc", seed=1, spawn_key=[1], realizations=[0, 3], elements=33, surface=surface
    )
    with xr.open_dataset(tmp_path / "s.nc") as ds:
        np.testing.assert_allclose(ds["rms_disc"], ds["heights"].std(("y", "x")), rtol=1e-12)
        np.testing.assert_allclose(ds[f"rms_{rms_over}"], 2e-6, rtol=1e-12)
        for number, one in ds.groupby("realization"):
            square = self_affine_square(0.4, 66, seed=realization_seed(1, 1, number))
            ratio = np.nanstd(cut_disc(square, 33)) / square.std()
            np.testing.assert_allclose(one["rms_disc"] / one["rms_square"], ratio, rtol=1e-12)


def test_digest_follows_imports(common, tmp_path, monkeypatch):
    package, scripts = tmp_path / "package", tmp_path / "scripts"
    package.mkdir()
    scripts.mkdir()
    for name, text in {
        "__init__": "from viscorough.far import value\n",
        "near": "from viscorough import far\n",
        "far": "value = 1\n",
        "other": "",
    }.items():
        (package / f"{name}.py").write_text(text)
    (scripts / "direct.py").write_text("from viscorough.near import value\n")
    (scripts / "inside.py").write_text("def main():\n    import viscorough.other\n")
    (scripts / "package.py").write_text("from viscorough import value\n")
    names = common.source_digest.__wrapped__.__globals__
    monkeypatch.setitem(names, "PACKAGE", package)
    monkeypatch.setitem(names, "WORKFLOW", tmp_path)

    def digests():
        common.imported.cache_clear()
        return {name: common.source_digest.__wrapped__(name) for name in ("direct", "inside", "package")}

    before = digests()
    assert digests() == before
    (package / "far.py").write_text("value = 2\n")
    after = digests()
    assert {name for name in before if before[name] != after[name]} == {"direct", "package"}
    (package / "other.py").write_text("value = 2\n")
    assert {name for name in after if after[name] != digests()[name]} == {"inside"}
    (package / "__init__.py").write_text("")
    assert {name for name in after if after[name] != digests()[name]} == {"inside", "package"}
    common.imported.cache_clear()
