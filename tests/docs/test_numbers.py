"""The numbers that README and docs/ quote are those of the published tables."""

import json
import os
import re
from pathlib import Path

import click
import numpy as np
import pandas as pd
import pytest
from PIL import Image

from support.benchmarks import load_benchmark
from support.documentation import README, ROOT, read
from support.study import CLAIMS
from support.workflow import FIGURES, merged, read_settings
from viscorough.reference import exponent_beta, zeta_elastic
from viscorough_study.cases import disc_cases
from viscorough_study.discs import punch_stiffness
from viscorough_study.performance.costs import fit_cost, median_costs
from viscorough_study.verdicts import markdown, overall

VERDICTS = ROOT / "docs/verdicts.md"
TABLE = pd.read_csv(ROOT / "docs/claims.csv")


def between_marks(page, name="verdicts"):
    return re.search(rf"<!-- {name}: .*? -->\n\n(.*?)\n<!-- end of {name} -->", read(page), re.DOTALL)[1]


def of_claim(name):
    return TABLE[TABLE["claim"] == name].set_index("case")


def percent(ratios):
    return [round(100 * abs(end - 1)) for end in (ratios.min(), ratios.max())]


def test_pages_have_the_published_verdicts():
    """benchmarks/publish.py writes both."""
    assert list(dict.fromkeys(TABLE["claim"])) == list(CLAIMS)
    publish = load_benchmark("publish")
    assert between_marks(VERDICTS) == publish.verdicts()
    assert between_marks(VERDICTS).startswith(markdown(TABLE, CLAIMS))
    assert between_marks(README) == publish.verdict_lines()
    physics = [claim["title"] for claim in CLAIMS.values() if claim["kind"] == "physics"]
    rows = [line for line in between_marks(README).splitlines()[2:] if line.startswith("|")]
    assert sorted(title.strip() for row in rows for title in row.split("|")[2].split(";")) == sorted(physics)


def test_readme_says_where_the_default_run_differs_from_the_full_scale(monkeypatch):
    publish, full = load_benchmark("publish"), overall(TABLE)
    changed = TABLE.copy()
    monkeypatch.setattr(publish, "published_claims", lambda name="": changed if "default" in name else TABLE)
    monkeypatch.setattr(publish, "DEFAULT_CLAIMS", "default")
    assert publish.verdict_lines().endswith("those of `make paper` are the same.\n")
    assert (full["gamma"], full["collapse"]) == ("not reproduced", "reproduced")
    changed.loc[TABLE["claim"] == "gamma", "verdict"] = "reproduced"
    changed.loc[TABLE["claim"] == "collapse", "verdict"] = "undecided"
    assert "the default run leaves 1 of them undecided and contradicts 1.\n" in publish.verdict_lines()


def test_readme_begins_with_the_time_of_the_published_default_run():
    publish = load_benchmark("publish")
    assert between_marks(README, "time") == publish.time_sentence()
    minutes = pd.read_csv(ROOT / publish.DEFAULT_COSTS)["share_s"].sum() / 60
    assert publish.time_sentence().startswith(f"**Several weeks in the paper, {minutes:.1f} minutes here**")
    assert read(README).index("**Several weeks") < read(README).index("## ")


def test_prefactors():
    first, second = (of_claim(f"zeta_{name}") for name in ("elastic", "viscous"))
    low, high = percent(first["value"] / first["expected"])
    most, least = percent(second["value"] / second["expected"])
    assert f"ζ is {low} to {high} % above" in read(README)
    assert f"{least} to {most} % below the second" in read(README)
    assert f"*ζ* as defined here is {low} to {high} % above Eq. 4" in read(VERDICTS)
    fits = published("scaling.csv").query("source == 'discs' and case_group == 'base' and window_rule == 'kappa'")
    fits = fits.query("rms_convention == 'disc' and average == 'geometric'")
    low, high = percent(fits["zeta"] / fits["hurst"].map(zeta_elastic))
    assert f"at equal contact stiffness {low} to {high} %" in words("docs/verdicts.md")


def test_verdicts_of_other_draws():
    """The claim that is named is the one whose verdict depends on the draw."""
    draws = json.loads(read(ROOT / "docs/resampled.json"))["verdicts"]
    table, published = pd.DataFrame(draws), overall(TABLE)
    moved = [claim for claim in published if (table.loc[claim] != published[claim]).any()]
    assert moved == ["zeta_elastic_shape"]
    case = of_claim("zeta_elastic_shape").loc["all H"]
    expected = f"its quantity is {case['value']:.3f}, with {case['low']:.3f} to {case['high']:.3f}, beside the end"
    assert f"{expected} of its tolerance, {case['tolerance']:g}" in words("docs/verdicts.md")
    sentence = load_benchmark("publish").other_surfaces({"a": "x", "b": "y"}, {1: {"a": "x", "b": "x"}})
    assert "Of 1 draws" in sentence
    assert sentence.strip().endswith("b (x in 1).")


def test_answers_of_readme():
    text = " ".join(read(README).split())
    fits = pd.read_csv(ROOT / "docs/results/scaling.csv").query(
        "source == 'discs' and case_group == 'base' and rms_convention == 'disc' and average == 'geometric'"
        " and window_rule == 'default'"
    )
    above = (fits.set_index("hurst")["beta"] - [exponent_beta(hurst) for hurst in fits["hurst"]]).to_dict()
    assert f"at H = 0.4 and 0.1 it is {above[0.4]:.2f} and {above[0.1]:.2f} larger" in text
    error = of_claim("exact_correspondence")["value"].abs()
    inside = error[error.index.str.endswith("region (b)")]
    assert f"in region (b) to {round(100 * inside.max())} %" in text
    law = pd.read_csv(ROOT / "src/viscorough/data/interface.csv").query("source == 'discs'")
    assert f"F/({law['u0'].mean():.2f} h)" in text
    of_readme = law.query("case_group == 'base' and average == 'geometric'")
    assert f"within 5 % from X = {of_readme['law_low'].max():.1g} until contact is complete" in text
    assert (of_readme["law_high"] > 25).all()


def test_lines_that_stand_for_discs():
    text = " ".join(read(ROOT / "docs/verification.md").split())
    drift, error = of_claim("lambda_constant")["value"], of_claim("exact_correspondence")["value"].abs()
    assert f"factors of {drift.iloc[0]:.2f}, {drift.iloc[1]:.2f}, {drift.iloc[2]:.2f} and {drift.iloc[3]:.2f}" in text
    percents = [round(100 * value) for value in error]
    inside, beyond = percents[::2], percents[1::2]
    assert "of {}, {}, {} and {} %, and".format(*inside) in text
    assert "up to {}, {}, {} and {} % |".format(*beyond) in text
    difference = of_claim("coincide_equal_windows")["value"].abs()
    assert f"within {difference.iloc[2:].max():.2f}" in text
    assert difference.iloc[:2].round(2).tolist() == [0.08, 0.08]
    area, gap = (of_claim(f"line_{name}")["value"] for name in ("area", "gap"))
    assert f"{area.min():.0f} to {area.max():.0f} times too large" in text
    assert f"{gap.min():.2f} to {gap.max():.2f} of that of the discs" in text


def test_stiffness_of_lines_beside_their_discs():
    text, table = words("docs/verification.md"), published("reduction.csv")
    fits = published("scaling.csv").query("source == 'discs' and case_group == 'base' and window_rule == 'default'")
    fits = fits.query("rms_convention == 'disc' and average == 'geometric'").set_index("hurst")
    low, high = (table["hurst"].map(fits[name]) for name in ("x_low", "x_high"))
    inside = table[table["x"].between(low, high)]
    assert "in region (b) to 20 %, beyond it to 25 %" in text
    for rows, most in ((inside, 0.2), (table, 0.25)):
        assert (rows["stiffness_ratio"] - 1).abs().max() < most
    factors = np.exp(inside["stiffness_scatter"])
    assert f"to a factor of {factors.min():.1f} to {factors.max():.1f} in region (b)" in text
    assert f"up to {np.exp(table['stiffness_scatter']).max():.0f} below it" in text


def test_power_law_and_complete_contact():
    decades, text = of_claim("power_law"), " ".join(read(VERDICTS).split())
    assert (decades["low"].drop("H = 0.1, decades") >= 2).all()
    value, low, high = (f"{decades[name]['H = 0.1, decades']:.3g}" for name in ("value", "low", "high"))
    assert f"over {value} decades, {low} to {high}" in text
    fractions = of_claim("complete_contact")["value"]
    assert f"only {100 * fractions.min():.0f} to {100 * fractions.max():.0f} % of the elements touch" in text
    assert "take some hundred times as long as the lines" in text
    assert 50 < of_claim("computing_time")["value"].iloc[0] < 1000
    assert f"with about {51432 * of_claim('contact_problems')['value'].iloc[0]:.0f} contact problems" in text
    assert set(of_claim("zeta_better")["verdict"]) == {"reproduced"}
    assert "not reproduced" in set(of_claim("master_curve_shape")["verdict"])


def test_exponents():
    law = pd.read_csv(ROOT / "src/viscorough/data/calibration.csv").query("source == 'discs'").set_index("hurst")
    above = [f"{law['beta'][hurst] - exponent_beta(hurst):.2f}" for hurst in (0.1, 0.4)]
    for page in ("verdicts", "verification"):
        text = " ".join(read(ROOT / f"docs/{page}.md").split())
        assert f"above *H*/(1 + *H*), by {above[0]} and {above[1]}" in text
    limit = of_claim("alpha_limit").loc["H = 1, discs"]
    assert "discs have {:.3f}, {:.3f} to {:.3f}".format(*limit[["value", "low", "high"]]) in words("docs/verdicts.md")
    assert limit["verdict"] == "undecided"
    apart = of_claim("coincide")["value"].abs()
    assert apart[["H = 0.6", "H = 0.9"]].max() < 0.02
    assert f"by {apart['H = 0.1']:.2f} and {apart['H = 0.4']:.2f}" in read(ROOT / "docs/verification.md")


def test_grids_from_coarse_to_fine():
    publish = load_benchmark("publish")
    assert between_marks(ROOT / "docs/scaling.md", "infinite grid") == publish.infinite_grid()
    limits = pd.read_csv(ROOT / "docs/results/infinite_grid.csv").query("law == 'corrected' and height == 'spectrum'")
    outside = limits[~limits["expected"].between(limits["ranges_low"], limits["ranges_high"])].set_index("source")
    assert set(outside["quantity"]) == {"interface"}
    assert set(outside["hurst"]) == {0.1}
    lowest = outside["ranges_low"]
    assert f"at {lowest['discs']:.3f} for discs and {lowest['lines']:.3f} for lines" in words("docs/scaling.md")
    assert (outside["omega_high"] == 1.5).all()
    assert set(limits.loc[limits["source"] == "discs", "finding"]) == {"undecided"}
    of_velocity = limits.query("source == 'lines' and quantity == 'whole'")
    assert (of_velocity["beta"] - of_velocity["expected"]).abs().max() < 0.01
    trends = pd.read_csv(ROOT / "docs/results/sizes_trends.csv").query("source != 'controls'")
    text = " ".join(read(ROOT / "docs/verification.md").split())
    fixed = trends[trends["window_rule"] == "X = 0.01 to 0.1"]["slope"].abs()
    assert f"as many elements change it by at most {fixed.max():.3f}, at any" in text
    early = trends.query("source == 'lines' and hurst == 0.1 and window_rule.str.match('X = 0.00')", engine="python")
    assert (early["slope_high"] < 0).all()
    assert f"by {early['slope'].abs().min():.3f} to {early['slope'].abs().max():.3f}" in text


def test_two_springs_in_series():
    """u₀/h to ± 0.02 at every H, and the law within 5 % from X = 0.001, at H = 0.1 from 0.002."""
    assert between_marks(ROOT / "docs/theory.md", "interface law") == load_benchmark("publish").interface_law()
    text = " ".join(read(ROOT / "docs/theory.md").split())
    table = pd.read_csv(ROOT / "src/viscorough/data/interface.csv").query("source == 'discs' and across == 257")
    table = table[table["average"] == "geometric"].drop_duplicates("hurst").set_index("hurst")
    assert set(table.index) == {0.1, 0.4, 0.6, 0.9, 1.0}
    assert "*u*₀/*h* is known to ±0.02 at every *H*" in text
    assert np.maximum(table["u0_high"] - table["u0"], table["u0"] - table["u0_low"]).max() <= 0.02
    assert "within 5 % of the mean curve of each of these ensembles from *X* = 0.001, at *H* = 0.1 from 0.002" in text
    assert table["deviation"].max() <= 0.05
    assert "softer by about 1.3/*n*" in text
    assert all(abs(number * (1 - punch_stiffness(number)) - 1.3) < 0.06 for number in (33, 257, 1025))
    assert (table["law_low"].round(6) == [0.001778, 0.001, 0.001, 0.001, 0.001]).all()


def test_control_has_no_power_law():
    """Of discs with a roll-off none has the decades that are required, while synthetic power laws pass."""
    plateaus = published("plateaus.csv")
    control = plateaus[plateaus["case_group"] == "roll_off"]
    assert set(control["hurst"]) == {0.1, 0.4, 0.6, 0.9}
    assert "The control falls short of two decades at every *H*" in words("docs/verdicts.md")
    assert control["decades_high"].max() < 2
    assert (plateaus["draws"] == 200).all()
    text, least = words("docs/verdicts.md"), plateaus.query("case_group == 'base'")["decades_low"].min()
    assert "with 1.5 decades *H* = 0.1 would pass, and the control would be undecided" in text
    assert control["decades_high"].max() >= 1.5 > control["decades_low"].max()
    assert least >= 1.5
    assert plateaus[plateaus["case_group"] == "base"]["power_law_passes"].min() >= 0.95
    assert plateaus["control_passes"].max() == 0


def test_gamma_factor():
    expected = of_claim("gamma")["expected"]
    text = " ".join(read(ROOT / "docs/verification.md").split())
    assert f"which would be {expected.min():.2f} to {expected.max():.2f}" in text
    low, high = percent(expected)
    assert f"changes *ζ* by {low} to {high} %" in " ".join(read(ROOT / "docs/theory.md").split())


def test_other_solvers():
    publish = load_benchmark("publish")
    assert between_marks(ROOT / "docs/performance.md", "other solvers") == publish.other_solver_times()
    times = pd.read_csv(ROOT / publish.OTHER_SOLVERS)["ratio"]
    in_words = f"take {times.min():.0f} to {10 * round(times.max() / 10)} times as long"
    assert in_words in " ".join(read(README).split())


def published(name):
    """A table of docs/results."""
    path = ROOT / "docs/results" / name
    if not path.exists():
        pytest.skip(f"{name} is not published yet")
    return pd.read_csv(path)


def words(page):
    return " ".join(read(ROOT / page).split())


def test_large_discs():
    table = published("large.csv").set_index("across")
    largest, half = table.loc[4097], table.loc[2049]
    time, memory = f"{largest['wall']:.0f} s", f"{largest['memory'] / 1e9:.1f} GB"
    assert f"4097 elements across takes {time} up to 50 % contact and {memory}, on one" in words("docs/performance.md")
    assert f"4097 elements across takes {time} and {memory}" in words("docs/questions.md")
    scaling = words("docs/scaling.md")
    applications, levels = (f"{largest[name]:.0f}" for name in ("operator_applications", "levels"))
    assert f"| {time}, {applications} operator applications, {levels} levels |" in scaling
    assert f"from {table.loc[257, 'operator_applications']:.0f} at 257 elements across to {applications} at" in scaling
    growth = fit_cost(np.array([half["elements"], largest["elements"]]), [half["memory"], largest["memory"]])[0]
    assert f"| {memory}; between 2049 and 4097 it grows as the number of elements to the power {growth:.2f}" in scaling
    sizes = table.loc[[257, 4097]]
    assert f"elements to the power {fit_cost(sizes['elements'], sizes['wall'])[0]:.1f}, to which" in scaling
    large = table.loc[[4097, 8193]]
    assert (large["memory"] / large["elements"]).max() < 200
    steeper = fit_cost(large["elements"], large["memory"])[0]
    assert f"between 4097 and 8193 to the power {steeper:.2f}; at most 200 bytes" in scaling


def test_records_and_threads():
    """8193 elements across, what 16 385 would take, and two threads beside one."""
    table, text = published("large.csv").set_index("across"), words("docs/performance.md")
    record, before = table.loc[8193], table.loc[4097]
    assert f"on one thread, {before['wall_threads']:.0f} s on two" in text
    minutes, gigabytes = f"{record['wall'] / 60:.0f} minutes", record["memory"] / 1e9
    assert f"{minutes} and {gigabytes:.1f} GB, on two threads {record['wall_threads'] / 60:.1f} minutes" in text
    next_wall, next_memory = (record[name] * (record[name] / before[name]) for name in ("wall", "memory"))
    assert next_wall / 60 == pytest.approx(90, rel=0.05)
    assert f"would take about 90 minutes and {next_memory / 1e9:.0f} GB on one thread" in text
    ratio = table.loc[2049, "wall"] / table.loc[2049, "wall_threads"]
    assert f"On a disc of 2049 two threads are {ratio:.2f} times as fast as one" in text
    sizes = table.loc[129:4097]
    growth = fit_cost(sizes["elements"], sizes["wall"])[0]
    assert f"to the power {growth:.2f} from 129 to 4097 (`make large`)" in text


def test_growth_and_placement_of_levels():
    methods, text = published("methods.csv"), words("docs/performance.md")
    growth = {}
    for hurst in (0.4, 0.8):
        costs = median_costs(methods[methods["hurst"] == hurst], "path, automatic levels", 1e-3)
        growth[hurst] = f"{fit_cost(costs['number'], costs['wall_s'])[0]:.2f}"
    assert f"to the power {growth[0.4]} (H = 0.4) and {growth[0.8]} (H = 0.8)" in text
    placed = (
        published("level_placement.csv").query("reached == 1").pivot(index="scene", columns="choice", values="ratio")
    )
    worst, second = sorted(1 / placed["best by hand"], reverse=True)[:2]
    assert f"at most {worst:.3g} times the time of the best levels placed by hand" in text
    assert f"at most {second:.3g} times in the others" in text
    assert f"at least {placed['naive'].min():.2g} times the time of the automatic ones" in text


def test_times_of_the_whole_paper():
    """The README states what docs/ state, and shares and cost of lines are those of the published run."""
    costs = published("rule_costs.csv").set_index("rule")
    text, pages = (
        words("docs/performance.md"),
        {name: words(f"docs/{name}.md") for name in ("reproduce", "performance")},
    )
    shares = costs["seconds"] / costs["seconds"].sum()
    assert f"lines took {100 * shares['indent_lines']:.0f} % and discs {100 * shares['indent_discs']:.0f} %" in text
    assert f"the largest job took {costs['memory_mb'].max() / 1000:.0f} GB" in text
    minutes = re.search(r"`make paper` repeats .*?, in (\d+) minutes", words("README.md"))[1]
    assert f"50 500 lines: {minutes} minutes" in pages["reproduce"]
    assert f"Of {minutes} min" in pages["performance"]
    short = re.search(r"at the paper's scale; ([\d.]+) minutes", pages["reproduce"])[1]
    assert f"It takes {short} minutes" in words("docs/getting_started.md")
    assert f"{short} minutes here" in words("README.md")
    settings = merged(read_settings("config"), read_settings("paper"))
    ensembles = [
        (case["group"], one["realizations"]) for case in disc_cases(settings).values() for one in case["ensembles"]
    ]
    discs = pd.DataFrame(ensembles, columns=["group", "realizations"]).groupby("group")["realizations"].sum()
    further = discs.sum() - discs["base"]
    assert f"{discs['base']} discs for the figures, {further} for variants and grids" in pages["reproduce"]
    assert f"own scale: {discs['base']} discs and 50 500 lines" in words("docs/verdicts.md")
    line, disc = costs["seconds"]["indent_lines"] / 50500, costs["seconds"]["indent_discs"] / discs.sum()
    assert 0.17 < line / disc < 0.23
    for page in ("README.md", "docs/questions.md"):
        assert "at about a fifth of the cost" in words(page)


def test_other_solvers_on_two_threads():
    two = published("other_solvers.csv").query("solver != 'viscorough' and threads == 2")
    fastest = two.groupby(["task", "hurst"])["ratio"].min()
    in_words = f"takes {fastest.min():.2g} to {fastest.max():.2g} times as long for the single levels"
    assert in_words in words("docs/performance.md")


def test_times_of_other_solvers_are_kept_with_their_origin(tmp_path):
    publish = load_benchmark("publish")
    published = pd.read_csv(ROOT / publish.OTHER_SOLVERS)
    measured = published.drop(columns=["measured", "machine"]).assign(wall_s=1.0)
    others = measured.iloc[:2].assign(solver=["viscorough", "Tamaas"], threads=[1, 2])
    pd.concat([others, measured]).to_csv(tmp_path / "other_solvers.csv", index=False)
    publish.copy_other_solvers(tmp_path / "other_solvers.csv", tmp_path / "kept.csv", "a machine", "2030-01-01")
    kept = pd.read_csv(tmp_path / "kept.csv")
    pd.testing.assert_frame_equal(kept, published.assign(measured="2030-01-01", machine="a machine"))


def test_published_files_say_where_they_come_from():
    folder = ROOT / "docs/results"
    if not folder.exists():
        pytest.skip("nothing is published yet")
    records = json.loads(read(folder / "published.json"))
    assert between_marks(ROOT / "docs/published.md", "results") == load_benchmark("publish").published_results(records)
    assert set(records) == {path.name for path in folder.iterdir()} - {"published.json"}
    assert sum(path.stat().st_size for path in folder.iterdir()) <= 3e6
    for name in load_benchmark("publish").PICTURES:
        if name in records:
            assert (folder / name).read_bytes() == (ROOT / "docs" / name).read_bytes()


def test_publishing(tmp_path):
    publish = load_benchmark("publish")
    results, project = tmp_path / "results", tmp_path / "project"
    for folder in (results / "tables", results / "figures", project / "docs", project / "src/viscorough/data"):
        folder.mkdir(parents=True)
    gradient = np.arange(2 * 3 * 3).reshape(2, 3, 3).astype(np.uint8)
    for name in (*publish.PUBLISHED["paper"], *publish.PUBLISHED["large"], *publish.KEPT["paper"]):
        if name.endswith(".png"):
            Image.fromarray(gradient).save(results / name)
        else:
            (results / name).write_text(name)
    os.utime(results / "tables/rule_costs.csv", (86400 * 365.25 * 30,) * 2)
    publish.copy_results(results, project, ["paper"], "abc")
    publish.copy_results(results, project, ["large"], "def")
    records = json.loads((project / "docs/results/published.json").read_text())
    assert {path.name for path in (project / "docs/results").iterdir()} == {*records, "published.json"}
    assert set(records) == {name.split("/")[-1] for name in publish.PUBLISHED["paper"] + publish.PUBLISHED["large"]}
    assert records["rule_costs.csv"]["date"] == "2000-01-01"
    for name, command, commit in (("large.csv", "make large", "def"), ("rule_costs.csv", "make paper", "abc")):
        assert records[name]["command"] == command
        assert records[name]["commit"] == commit
    assert (project / "docs/claims.csv").read_text() == "tables/claims.csv"
    for name in ("calibration", "interface"):
        assert (project / f"src/viscorough/data/{name}.csv").read_text() == f"tables/{name}.csv"


def test_publishing_the_default_run(tmp_path):
    publish = load_benchmark("publish")
    results, project = tmp_path / "results", tmp_path / "project"
    for name in (*publish.KEPT["reproduce"], *publish.KEPT["reproduce"].values()):
        for folder in (results, project):
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
    for name in publish.KEPT["reproduce"]:
        (results / name).write_text("rule,share_s\nplot,60.0\n")
    os.utime(results / "tables/rule_costs.csv", (86400 * 365.25 * 30,) * 2)
    publish.copy_results(results, project, ["reproduce"], "abc")
    costs = pd.read_csv(project / publish.DEFAULT_COSTS)
    assert costs[["rule", "share_s", "measured"]].to_numpy().tolist() == [["plot", 60.0, "2000-01-01"]]
    assert costs["machine"].str.endswith("cores").all()
    for name in (publish.DEFAULT_CLAIMS, "docs/fig2_kinetics.png"):
        assert (project / name).read_text() == "rule,share_s\nplot,60.0\n"


def test_readme_shows_the_published_chart_of_speed(tmp_path):
    publish = load_benchmark("publish")
    assert between_marks(README, "speed chart") == publish.speed_chart()
    (tmp_path / "docs").mkdir()
    assert publish.speed_chart(tmp_path) == ""
    (tmp_path / "docs/speed.png").touch()
    chart = publish.speed_chart(tmp_path)
    assert chart.startswith("![Speed against accuracy of the main methods](docs/speed.png)\n\n*")
    assert max(map(len, chart.splitlines())) <= 120
    others = read(README).replace(between_marks(README, "speed chart"), "")
    assert len((others + chart).split()) <= 1000


def test_nothing_is_published_of_an_incomplete_run(tmp_path):
    """As the charts of a small scale would be, of a folder in which `make speed` was not run."""
    publish = load_benchmark("publish")
    (tmp_path / "figures").mkdir()
    (tmp_path / "docs").mkdir()
    (tmp_path / "figures/speed.png").touch()
    with pytest.raises(click.ClickException, match="make speed"):
        publish.copy_results(tmp_path, tmp_path, ["speed"], "abc")
    assert not list((tmp_path / "docs").iterdir())


def test_every_published_file_is_made_by_a_rule_or_a_benchmark():
    publish = load_benchmark("publish")
    made = "\n".join(read(path) for path in [*(ROOT / "workflow/rules").glob("*.smk"), ROOT / "Makefile"])
    for command, names in publish.PUBLISHED.items():
        assert re.search(rf"^{command}:", read(ROOT / "Makefile"), re.MULTILINE)
        for name in names:
            assert Path(name).stem in FIGURES or f"results/{name}" in made, name


def test_verdicts_under_several_root_seeds():
    """The file of verdicts belongs to the tables beside it, and no verdict changes with the seed."""
    seeds = json.loads(read(ROOT / "docs/seeds.json"))
    tables = pd.read_csv(ROOT / "docs/seeds.csv", keep_default_na=False, na_values=[""]).groupby("seed")
    assert {str(seed): overall(table) for seed, table in tables} == seeds["verdicts"]
    assert len(seeds["verdicts"]) == 3
    assert seeds["moved"] == {}
    assert all(list(verdicts) == list(CLAIMS) for verdicts in seeds["verdicts"].values())
