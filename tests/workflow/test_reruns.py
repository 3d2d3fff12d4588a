"""Which jobs rerun after a change of a setting or of a source."""

import os
import re
import shutil

import pytest
import xarray as xr

from support.workflow import (
    TARGETS,
    TEST,
    copy_sources,
    jobs,
    plan,
    read_settings,
    settings_file,
    snakemake,
)
from viscorough_study.ensembles.surface_files import read_surfaces

LAST = {"make_page"}  # it runs again after any change of a setting, since it names all that differ
BOUNDARY_ELEMENTS = {
    "indent_surfaces",
    "compare_direct",
    "tabulate_validation",
    "measure_methods",
}
BOUNDARY_ELEMENTS |= {"map_failures", "measure_one_surface"}


@pytest.fixture(scope="module")
def with_dependents(unmade):
    """Return a function that adds to a set of rules all rules that need their results, directly or not."""
    graph = snakemake(unmade, *TEST, "--rulegraph")
    names = dict(re.findall(r'(\d+)\[label = "(\w+)"', graph))
    edges = {(names[rule], names[then]) for rule, then in re.findall(r"(\d+) -> (\d+)", graph)}

    def closure(rules):
        while more := {then for rule, then in edges if rule in rules} - rules:
            rules = rules | more
        return rules - TARGETS

    return closure


@pytest.fixture
def editable(finished):
    """Make the finished project with a separate copy of the packages."""
    copy_sources(finished)
    return finished


def add_line(path, line):
    path.write_text(f"{path.read_text()}{line}\n")


FEW_STEPS = {"methods": {"levels": 3, "stress": {"across": 11}}}
FEW_STEPS |= {"validation": {"elements": [17, 31], "direct": {"elements": 31}}}
OF_FEW_STEPS = {"measure_methods", "tabulate_validation", "map_failures", "compare_direct"}
FITS = {"match_mdr", "compare_zeta_laws", "judge_claims"}


@pytest.mark.parametrize(
    ("changed", "directly"),
    [
        (FEW_STEPS, OF_FEW_STEPS),
        ({"scaling": {"stiffness_max": 0.25}}, FITS | {"fit_scaling", "fit_local_slope"}),
        ({"curves": {"per_decade": 25}}, {"aggregate_curves"}),
        ({"surface": {"period": 1.5}}, {"generate_discs", "generate_examples"}),
    ],
    ids=["few steps", "scaling", "curves", "surface"],
)
def test_changed_setting_reruns_only_the_rules_that_use_it(finished_once, tmp_path, with_dependents, changed, directly):
    planned = plan(finished_once, *TEST, settings_file(tmp_path, "changed", **changed))
    assert set(planned) == with_dependents(directly) | LAST
    if "surface" in changed:  # longer_period has its own period; coarse discs have two batches
        assert planned["generate_discs"] == planned["indent_surfaces"] == 2 + 2 + 2


def test_changed_lines_rerun_no_rule_that_uses_only_discs(finished_once, tmp_path, with_dependents):
    planned = set(plan(finished_once, *TEST, settings_file(tmp_path, "changed", lines={"points": 2048})))
    disc_rules = {"compare_zeta_laws", "fit_local_slope", "plot_regions"}
    assert planned == with_dependents({"reduce_lines"}) - disc_rules | LAST


def test_further_exponent_reruns_only_its_dependents(finished_once, tmp_path):
    more = settings_file(tmp_path, "more", hurst=[0.9, 0.4, 0.6])
    text = snakemake(finished_once, "--dry-run", *TEST, more)
    names = set(re.findall(r"^Job \d+: .*\b(h\d{5}\w*)", text, re.MULTILINE))
    assert names == {"h06000", "h06000_longer_period", "h06000_roll_off"}
    planned = jobs(text)
    assert (planned["indent_surfaces"], planned["reduce_lines"], planned["aggregate_curves"]) == (5, 2, 3)
    assert "tabulate_validation" not in planned


KNOWN = read_settings("test")["discs"]["combinations"]
TENTH = {"combinations": [*KNOWN, KNOWN[0] | {"number": 10}]}


@pytest.mark.parametrize("discs", [{"realizations": 4}, TENTH])  # a second batch of both Hurst exponents
def test_additions_keep_existing_curves(finished_once, tmp_path, discs):
    planned = plan(finished_once, *TEST, settings_file(tmp_path, "more", discs=discs))
    assert planned["generate_discs"] == planned["indent_surfaces"] == 2
    assert "reduce_lines" not in planned


def test_new_seed_reruns_the_curves_of_all_random_surfaces(finished_once, tmp_path):
    planned = plan(finished_once, *TEST, settings_file(tmp_path, "seed", seed=5), "--", "curves")
    assert planned == {"generate_discs": 6, "indent_surfaces": 6, "reduce_lines": 4}


def test_kept_surfaces_belong_to_the_curves(finished):
    """Surfaces are made again, and kept, on request. Curves are made again only if their input changes."""
    surfaces = "results/surfaces/discs/h04000/0000-0001.nc"
    assert not (finished / surfaces).exists()
    snakemake(finished, *TEST, "--", surfaces)
    kept = [realization.rms["disc"] for _, realization, _ in read_surfaces(finished / surfaces)]
    with xr.open_dataset(finished / "results/curves/discs/h04000/0000-0001.nc") as curves:
        assert curves["rms_disc"].values.tolist() == kept
    assert plan(finished, *TEST) == {}
    planned = plan(finished, *TEST, settings_file(finished, "accurate", curves={"tolerance": 5e-3}))
    assert (planned["generate_discs"], planned["indent_surfaces"]) == (7, 8)  # one file of discs exists


def test_lost_folder_of_snakemake_hides_no_changed_setting(finished_once, tmp_path):
    """As if the results had been copied without this folder. The files themselves state their settings."""
    folder = shutil.copytree(finished_once, tmp_path / "copy", ignore=shutil.ignore_patterns(".snakemake"))
    assert plan(folder, *TEST) == {}
    changed = settings_file(tmp_path, "changed", seed=5)
    assert plan(folder, *TEST, changed) == plan(finished_once, *TEST, changed) != {}


def test_file_of_another_run_is_made_again(finished):
    """Such as a table that a job of a killed run wrote after the run that followed."""
    table = finished / "results/tables/direct.csv"
    header, csv = table.read_text().split("\n", 1)
    time = table.stat()
    table.write_text(header.replace('"seed": 2013', '"seed": 1') + f"\n{csv}")
    os.utime(table, ns=(time.st_atime_ns, time.st_mtime_ns))
    assert "compare_direct" in plan(finished, *TEST)


def test_comments_rerun_nothing(editable):
    """Comments are added to every module of both packages, every script and the rules. Times of files do not count."""
    files = [path for folder in ("src", "workflow/scripts") for path in (editable / folder).rglob("*.py")]
    assert len(files) > 80
    for path in [*files, *(editable / "workflow/rules").glob("*.smk")]:
        add_line(path, "# a comment")
    assert plan(editable, *TEST) == {}


@pytest.mark.parametrize(
    ("files", "directly"),
    [
        (["src/viscorough/contact/halfspace/column_fft.py"], BOUNDARY_ELEMENTS | {"generate_discs"}),  # temporary files
        (["workflow/scripts/require_validation.py"], {"require_validation"}),
        (
            [f"src/viscorough_study/{module}.py" for module in ("comparisons/direct_integration", "figures/exponent")],
            {"compare_direct", "plot_exponent"},
        ),
    ],
    ids=["column convolution", "script", "table and figure"],
)
def test_changed_source_reruns_only_the_rules_that_use_it(editable, with_dependents, files, directly):
    for file in files:
        add_line(editable / file, "CHANGED = True")
    assert set(plan(editable, *TEST)) == with_dependents(directly)
