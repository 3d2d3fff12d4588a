"""What a changed setting or a changed source reruns, and what it leaves."""

import ast
import base64
import re

import pytest
import xarray as xr

from support.workflow import TEST, copy_project, copy_sources, jobs, plan, read_settings, settings_file, snakemake
from viscorough_study.ensembles.surface_files import Surfaces

FITS_AND_FIGURES = {"match_lines", "fit_scaling", "judge_claims", "compare_zeta_laws"}
FITS_AND_FIGURES |= {"tabulate_calibration", "tabulate_literature", "plot_mdr_lambda", "plot_kinetics", "plot_exponent"}
# With the values of others, which stand beside the exponents in one table, `plot_interface`.
FITS_AND_FIGURES |= {"plot_master_curve", "plot_conventions", "plot_interface"}
BOUNDARY_ELEMENTS = {"generate_discs", "indent_surfaces"}  # discs were temporary
BOUNDARY_ELEMENTS |= {
    "compare_direct",
    "compare_reduction",
    "validate",
    "measure_methods",
    "map_failures",
    "compare_level_placement",
}
MEDIA = {"compute_media", "plot_media"}
SIZES = {"fit_sizes", "plot_sizes", "fit_collapse", "plot_collapse"}
INTERFACE = {"fit_interface", "plot_interface"}
SPEED = {"measure_methods", "tabulate_methods", "plot_speed"}
LAST = {"tabulate_rule_costs", "make_page", "show_tables_of_all"}  # made again with whatever is


def edit(path, change):
    """Replace the text of a file by change(text)."""
    text = path.read_text()
    assert change(text) != text, path
    path.write_text(change(text))


@pytest.fixture
def editable(finished):
    """The finished project with its own copy of the packages."""
    copy_sources(finished)
    return finished


def reworded(text):
    """Every docstring with other words, every line of it moved, and a comment at the end."""
    tree = ast.parse(text)
    nodes = [node for node in ast.walk(tree) if isinstance(node, ast.Module | ast.FunctionDef | ast.ClassDef)]
    docstrings = [node.body[0].value for node in nodes if ast.get_docstring(node, clean=False) is not None]
    lines = text.splitlines(keepends=True)
    for place in docstrings:  # "..." 'of one piece' become strings that are joined
        row = place.lineno - 1
        start = len(lines[row].encode()[: place.col_offset].decode())
        lines[row] = f'{lines[row][:start]}"Other words. " {lines[row][start:]}'
    return "# a comment\n\n" + "".join(lines) + "# another\n"


def with_another_statement(text):
    """The same module with another statement at the end of every function."""
    tree = ast.parse(text)
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef):
            node.body.append(ast.Pass())
    return ast.unparse(tree)


FEW_STEPS = {"media": {"force": 2e-4}, "verdicts": {"draws": 3}, "interface": {"plateau": 0.1}}
FEW_STEPS |= {"methods": {"levels": 3, "scenes": {"elements": 31}}, "validation": {"elements": [17, 31]}}
FEW_STEPS |= {"stability": {"across": 11}, "direct": {"elements": 31}}
OF_FEW_STEPS = MEDIA | INTERFACE | SPEED | {"measure_plateaus", "judge_claims", "tabulate_literature"}
OF_FEW_STEPS |= {"validate", "check_validation", "plot_validation", "compare_direct", "plot_direct"}
OF_FEW_STEPS |= {"map_failures", "plot_failure_map", "compare_level_placement", "plot_level_placement"}
POOLED = {"aggregate_curves", "measure_plateaus", "compare_grids"}
OF_SURFACES = FITS_AND_FIGURES | INTERFACE | MEDIA | SIZES | POOLED
OF_SURFACES |= {"generate_discs", "indent_surfaces", "generate_examples", "plot_surfaces"}


@pytest.mark.parametrize(
    ("changed", "rerun"),
    [
        (FEW_STEPS, OF_FEW_STEPS),
        ({"scaling": {"stiffness_max": 0.25}}, FITS_AND_FIGURES | {"fit_sizes", "plot_sizes"}),
        ({"figures": {"average": "arithmetic"}}, (FITS_AND_FIGURES | SIZES) - {"fit_scaling"}),
        ({"ensemble": {"per_decade": 25}}, FITS_AND_FIGURES | SIZES | INTERFACE | POOLED),
        (
            {"lines": {"points": 2048}},
            (FITS_AND_FIGURES | INTERFACE | {"reduce_lines", "aggregate_curves"}) - {"compare_zeta_laws"},
        ),
        ({"surface": {"period": 1.5}}, OF_SURFACES),  # not of the variant that has its own period, nor of lines
    ],
    ids=["few steps", "scaling", "figures", "ensemble", "lines", "surface"],
)
def test_a_changed_setting_reruns_what_uses_it(finished_once, tmp_path, changed, rerun):
    planned = plan(finished_once, *TEST, settings_file(tmp_path, "changed", **changed))
    assert set(planned) == rerun | LAST
    if "surface" in changed:  # two Hurst exponents, two batches each of grids from coarse to fine and of their control
        assert planned["generate_discs"] == planned["indent_surfaces"] == 2 + 4


def test_a_further_exponent_reruns_only_what_depends_on_it(finished_once, tmp_path):
    more = settings_file(tmp_path, "more", discs={"hurst": [0.4, 0.6, 0.9]}, lines={"hurst": [0.4, 0.6, 0.9]})
    text = snakemake(finished_once, "--dry-run", *TEST, more)
    cases = set(re.findall(r"^Job \d+: .*\b(h\d{5}\w*)", text, re.MULTILINE))
    assert cases == {"h06000", "h06000_longer_period"}
    planned = jobs(text)
    assert (planned["indent_surfaces"], planned["reduce_lines"], planned["aggregate_curves"]) == (2, 2, 2)
    assert "validate" not in planned


@pytest.mark.parametrize("more", ["realizations", "a combination"])
def test_what_is_added_keeps_the_curves_that_are_there(finished_once, tmp_path, more):
    discs = {"realizations": 4}  # a second batch of both Hurst exponents
    if more == "a combination":
        known = read_settings("test")["discs"]["combinations"]
        discs = {"combinations": [*known, known[0] | {"number": 10}]}
    planned = plan(finished_once, *TEST, settings_file(tmp_path, "more", discs=discs))
    assert planned["generate_discs"] == planned["indent_surfaces"] == 2
    assert "reduce_lines" not in planned


def test_another_seed_reruns_the_curves_of_all_random_surfaces(finished_once, tmp_path):
    planned = plan(finished_once, *TEST, settings_file(tmp_path, "seed", seed=5), "--", "curves")
    assert planned == dict.fromkeys(("generate_discs", "indent_surfaces", "reduce_lines"), 4)


def test_surfaces_that_must_be_made_again_do_not_hide_what_depends_on_them(tmp_path):
    """Kept ones after a change of the seed, and ones that a killed run marked as incomplete when they were there."""
    project, surfaces = copy_project(tmp_path), "results/surfaces/discs/h09000/0000-0001.nc"
    planned = plan(project, *TEST)
    snakemake(project, *TEST, "--notemp", "--", surfaces)
    assert plan(project, *TEST, "--config", "seed=77") == planned
    marker = project / ".snakemake/incomplete" / base64.urlsafe_b64encode(surfaces.encode()).decode()
    marker.parent.mkdir(exist_ok=True)
    marker.touch()
    assert plan(project, *TEST) == planned


def test_kept_surfaces_are_those_that_curves_are_made_from(finished):
    """Surfaces that are asked for are made again, and kept; curves only where what they are made from changes."""
    surfaces = "results/surfaces/discs/h04000/0000-0001.nc"
    assert not (finished / surfaces).exists()
    snakemake(finished, *TEST, "--", surfaces)
    with Surfaces(finished / surfaces) as discs:
        number, kept = len(discs), [realization.rms["disc"] for realization, _ in discs]
    with xr.open_dataset(finished / "results/curves/discs/h04000/0000-0001.nc") as curves:
        assert curves["rms_disc"].values.tolist() == kept
        assert number == curves.sizes["realization"]
    assert plan(finished, *TEST) == {}
    planned = plan(finished, *TEST, settings_file(finished, "accurate", discs={"tolerance": 5e-3}))
    assert (planned["generate_discs"], planned["indent_surfaces"]) == (3, 4)  # one file of discs is there


def test_an_edit_of_the_generator_reruns_discs_and_their_curves(editable):
    edit(editable / "src/viscorough/surfaces.py", lambda text: text.replace("if period < 1:", "if not period >= 1:"))
    planned = plan(editable, *TEST, "--", "curves", "figure_1")
    disc_jobs = {"generate_discs": 4, "indent_surfaces": 4}
    assert planned == disc_jobs | {"generate_examples": 1, "plot_surfaces": 1}


def test_reworded_docstrings_and_comments_rerun_nothing(editable):
    """In every module of both packages, in every script and in the rules; nor do the times of the files count."""
    files = [path for folder in ("src", "workflow/scripts") for path in (editable / folder).rglob("*.py")]
    assert len(files) > 80
    rules = sorted((editable / "workflow/rules").glob("*.smk"))
    for path in files:
        edit(path, reworded)
    for path in rules:
        edit(path, lambda text: f"# a comment\n{text}")
    assert plan(editable, *TEST) == {}


def test_a_changed_line_of_the_column_convolution_reruns_what_uses_boundary_elements(editable):
    """And what depends on it, but neither lines nor the discs of Figure 1."""
    edit(editable / "src/viscorough/contact/halfspace/column_fft.py", with_another_statement)
    after = {
        "compare_grids",
        "aggregate_curves",
        "measure_plateaus",
        "plot_direct",
        "plot_reduction",
        "check_validation",
        "plot_validation",
    }
    after |= {"plot_failure_map", "plot_level_placement", *SPEED, *MEDIA, *INTERFACE, *LAST}
    assert set(plan(editable, *TEST)) == BOUNDARY_ELEMENTS | FITS_AND_FIGURES | SIZES | after


def test_a_changed_script_table_or_figure_reruns_its_rule_and_what_depends_on_it(editable):
    script = editable / "workflow/scripts/check_validation.py"
    edit(script, lambda text: text.replace("validation failed, see", "failed, see"))
    for module in ("comparisons/direct_integration", "figures/exponent"):
        edit(editable / f"src/viscorough_study/{module}.py", with_another_statement)
    dependents = {"compare_direct", "plot_direct", "judge_claims"}
    assert set(plan(editable, *TEST)) == {"check_validation", *dependents, "plot_exponent", *LAST}


def test_forcing_one_rule(finished_once):
    assert plan(finished_once, *TEST, "--forcerun", "plot_exponent") == dict.fromkeys(("plot_exponent", *LAST), 1)
