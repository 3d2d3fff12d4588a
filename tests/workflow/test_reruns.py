"""What a changed setting or a changed source reruns, and what it leaves."""

import ast
import os
import re

import pytest

from support.workflow import TEST, copy_sources, jobs, plan, settings_file, snakemake

FITS = {"fit_scaling", "judge_claims", "compare_prefactors", "tabulate_calibration"}
AFTER_FITS = {"plot_kinetics", "plot_master_curve", "plot_exponent", "plot_conventions", "plot_prefactors"}
FITS_AND_FIGURES = FITS | AFTER_FITS
BOUNDARY_ELEMENTS = {"indent_discs", "compare_direct", "compare_reduction", "validate"}


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


@pytest.mark.parametrize(
    ("changed", "rerun"),
    [
        ({"scaling": {"stiffness_max": 0.25}}, FITS_AND_FIGURES),
        ({"figures": {"average": "arithmetic"}}, FITS_AND_FIGURES - {"fit_scaling", "compare_prefactors"}),
        ({"ensemble": {"per_decade": 25}}, FITS_AND_FIGURES | {"pool_curves"}),
        ({"validation": {"elements": [17, 31]}}, {"validate", "check_validation", "plot_validation", "judge_claims"}),
        ({"lines": {"points": 2048}}, FITS_AND_FIGURES | {"indent_lines", "pool_curves"}),
        (
            {"indentation": {"tolerance": 2e-3}},
            FITS_AND_FIGURES | {"indent_discs", "pool_curves", "compare_reduction", "plot_reduction"},
        ),
        (
            {"surface": {"period": 1.5}},  # not of the variant that has its own period, nor of lines
            FITS_AND_FIGURES | {"indent_discs", "pool_curves", "generate_example_discs", "plot_surfaces"},
        ),
        ({"direct": {"elements": 31}}, {"compare_direct", "plot_direct", "judge_claims"}),
        ({"reduction": {"per_decade": 5}}, {"compare_reduction", "plot_reduction"}),
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
    assert (planned["indent_discs"], planned["indent_lines"], planned["pool_curves"]) == (3, 2, 2)
    assert "validate" not in planned


def test_more_realizations_keep_those_that_are_there(finished):
    planned = plan(finished, *TEST, settings_file(finished, "more", discs={"realizations": 4}))
    assert planned["indent_discs"] == 4  # the second batch of each of the four cases
    assert "indent_lines" not in planned


def test_reworded_docstrings_and_comments_rerun_nothing(editable):
    """In every module of both packages, in every script and in the rules."""
    files = [path for folder in ("src", "workflow/scripts") for path in (editable / folder).rglob("*.py")]
    assert len(files) > 80
    rules = sorted((editable / "workflow/rules").glob("*.smk"))
    for path in files:
        edit(path, reworded)
    for path in rules:
        edit(path, lambda text: f"# a comment\n{text}")
    assert plan(editable, *TEST) == {}


@pytest.mark.parametrize(
    ("module", "line", "rerun"),
    [
        ("viscorough_study/power_law.py", "def find_region", FITS_AND_FIGURES),
        (
            "viscorough_study/validate_solvers.py",
            "COLUMNS = {",
            {"validate", "check_validation", "plot_validation", "judge_claims"},
        ),
        (
            "viscorough/mdr.py",
            "def reduce",
            FITS_AND_FIGURES
            | {"indent_lines", "pool_curves", "compare_reduction", "plot_reduction"}
            | {"validate", "check_validation", "plot_validation"},
        ),
        (
            "viscorough/contact/column_fft.py",
            "class Columns",
            FITS_AND_FIGURES
            | BOUNDARY_ELEMENTS
            | {"pool_curves", "plot_direct", "plot_reduction", "check_validation", "plot_validation"},
        ),
        ("viscorough_study/performance/timing.py", "def interleaved", set()),
        ("viscorough_study/figures/exponent.py", "def plot_exponent", {"plot_exponent"}),
    ],
    ids=lambda value: value if isinstance(value, str) and value.endswith(".py") else "",
)
def test_a_changed_line_reruns_exactly_what_uses_it(editable, module, line, rerun):
    """The line is changed inside the definition that begins so."""
    path = editable / "src" / module
    assert path.read_text().count(f"\n{line}") == 1

    def change(text):
        if line.startswith("COLUMNS"):
            return text.replace(f"\n{line}", f'\n{line}"another": ("column", "1"),')
        start = next(node for node in ast.parse(text).body if getattr(node, "name", "") == line.split()[1])
        lines = text.splitlines(keepends=True)
        first = start.body[1]
        lines.insert(first.lineno - 1, " " * first.col_offset + "another_line = 1\n")
        return "".join(lines)

    edit(path, change)
    assert set(plan(editable, *TEST)) == rerun


def test_a_changed_script_reruns_its_rule_and_what_depends_on_it(editable):
    script = editable / "workflow/scripts/compare_direct.py"
    edit(script, lambda text: text.replace("Direct integration and", "Integration and"))
    assert set(plan(editable, *TEST)) == {"compare_direct", "plot_direct", "judge_claims"}


def test_forcing_one_rule(finished):
    assert plan(finished, *TEST, "--forcerun", "plot_exponent") == {"plot_exponent": 1}


def test_an_older_checkout_of_the_same_sources_reruns_nothing(finished):
    """The times of the sources do not count, such as those that git sets."""
    for path in (finished / "workflow/scripts").glob("*.py"):
        os.utime(path)
    assert plan(finished, *TEST) == {}
