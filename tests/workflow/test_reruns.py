"""What a changed setting or a changed source reruns, and what it leaves."""

import ast
import re

import pytest

from support.workflow import TEST, copy_sources, jobs, plan, settings_file, snakemake

FITS_AND_FIGURES = {"match_lines", "fit_scaling", "judge_claims", "compare_prefactors", "compare_zeta_laws"}
FITS_AND_FIGURES |= {"tabulate_calibration", "tabulate_literature", "plot_mdr_lambda", "plot_kinetics", "plot_exponent"}
# With the values of others, which stand beside the exponents in one table, `plot_interface`.
FITS_AND_FIGURES |= {"plot_master_curve", "plot_conventions", "plot_prefactors", "plot_interface"}
BOUNDARY_ELEMENTS = {"indent_discs", "compare_direct", "compare_reduction", "validate"}
BOUNDARY_ELEMENTS |= {"measure_methods", "map_failures", "compare_level_placement"}
MEDIA = {"compute_media", "plot_media", "plot_media_exponents"}
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
POOLED = {"pool_curves", "measure_plateaus"}
OF_SURFACES = FITS_AND_FIGURES | INTERFACE | MEDIA | SIZES | POOLED
OF_SURFACES |= {"indent_discs", "generate_example_discs", "plot_surfaces"}


@pytest.mark.parametrize(
    ("changed", "rerun"),
    [
        (FEW_STEPS, OF_FEW_STEPS),
        # Errors in region (b) are tabulated, too.
        ({"scaling": {"stiffness_max": 0.25}}, FITS_AND_FIGURES | {"fit_sizes", "plot_sizes"} | SPEED),
        ({"figures": {"average": "arithmetic"}}, (FITS_AND_FIGURES | SIZES) - {"fit_scaling", "compare_prefactors"}),
        ({"ensemble": {"per_decade": 25}}, FITS_AND_FIGURES | SIZES | INTERFACE | POOLED),
        (
            {"lines": {"points": 2048}},
            (FITS_AND_FIGURES | INTERFACE | {"indent_lines", "pool_curves"}) - {"compare_zeta_laws"},
        ),
        ({"surface": {"period": 1.5}}, OF_SURFACES),  # not of the variant that has its own period, nor of lines
    ],
    ids=["few steps", "scaling", "figures", "ensemble", "lines", "surface"],
)
def test_a_changed_setting_reruns_what_uses_it(finished_once, tmp_path, changed, rerun):
    planned = plan(finished_once, *TEST, settings_file(tmp_path, "changed", **changed))
    assert set(planned) == rerun | LAST
    if "surface" in changed:  # two Hurst exponents, two batches each of grids from coarse to fine and of their control
        assert planned["indent_discs"] == 2 + 4


def test_a_further_exponent_reruns_only_what_depends_on_it(finished_once, tmp_path):
    more = settings_file(tmp_path, "more", discs={"hurst": [0.4, 0.6, 0.9]}, lines={"hurst": [0.4, 0.6, 0.9]})
    text = snakemake(finished_once, "--dry-run", *TEST, more)
    cases = set(re.findall(r"^Job \d+: .*\b(h\d{5}\w*)", text, re.MULTILINE))
    assert cases == {"h06000", "h06000_longer_period"}
    planned = jobs(text)
    assert (planned["indent_discs"], planned["indent_lines"], planned["pool_curves"]) == (2, 2, 2)
    assert "validate" not in planned


def test_more_realizations_keep_those_that_are_there(finished_once, tmp_path):
    planned = plan(finished_once, *TEST, settings_file(tmp_path, "more", discs={"realizations": 4}))
    assert planned["indent_discs"] == 2  # the second batch of both Hurst exponents
    assert "indent_lines" not in planned


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
    """And what depends on it, but neither lines nor example discs."""
    edit(editable / "src/viscorough/contact/halfspace/column_fft.py", with_another_statement)
    after = {"pool_curves", "measure_plateaus", "plot_direct", "plot_reduction", "check_validation", "plot_validation"}
    after |= {"plot_failure_map", "plot_level_placement", *SPEED, *MEDIA, *INTERFACE, *LAST}
    assert set(plan(editable, *TEST)) == BOUNDARY_ELEMENTS | FITS_AND_FIGURES | SIZES | after


def test_a_changed_script_or_figure_reruns_its_rule_and_what_depends_on_it(editable):
    script = editable / "workflow/scripts/compare_direct.py"
    edit(script, lambda text: text.replace("Direct integration and", "Integration and"))
    edit(editable / "src/viscorough_study/figures/exponent.py", with_another_statement)
    assert set(plan(editable, *TEST)) == {"compare_direct", "plot_direct", "judge_claims", "plot_exponent", *LAST}


def test_forcing_one_rule(finished_once):
    assert plan(finished_once, *TEST, "--forcerun", "plot_exponent") == dict.fromkeys(("plot_exponent", *LAST), 1)
