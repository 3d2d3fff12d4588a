"""Captions name the panels of their figures, and figures share units and the looks of Hurst exponents."""

import re

import jinja2
import pytest
from matplotlib.colors import to_hex

from support.study import ROOT, SHOWN
from support.workflow import FIGURES, RULES

REPORT = ROOT / "workflow" / "report"

# ---- contents of figures and captions


def labels_of(figure):
    """Return the labels of the axes."""
    return [text for axes in figure.axes for text in (axes.get_xlabel(), axes.get_ylabel()) if text]


# ---- the captions of the report


def read(name):
    return (REPORT / f"figures/{name}.rst").read_text(encoding="utf-8")


def test_every_figure_of_the_report_is_drawn_here(drawn):
    assert sorted(FIGURES) == sorted(drawn)


@pytest.mark.parametrize("name", FIGURES)
def test_caption_names_the_panels_of_its_figure(drawn, name):
    panels = {match[0] for axes in drawn[name].axes if (match := re.match(r"\([a-z]\)", axes.get_title()))}
    text = re.sub(r"regions? \([abc]\)( and \([abc]\))?", "", read(name))
    assert set(re.findall(r"\([a-z]\)", text)) == panels


def test_units_are_in_parentheses_and_dimensionless_quantities_have_none(drawn):
    units = set()
    for figure in drawn.values():
        labels = labels_of(figure)
        assert not [label for label in labels if re.search(r" \[\w*\]$", label)]
        units |= {match.group(1) for label in labels if (match := re.search(r" \(([^()]*)\)$", label))}
    assert units - {"b"} == {"s", "m/s", "µm", "darker is higher"}  # region (b)


def test_hurst_exponent_looks_the_same_in_all_figures(drawn):
    """Colour and marker are the same in every figure that has the exponent in its legend."""
    looks = []
    for figure in drawn.values():
        legends = [*figure.legends, *(axes.get_legend() for axes in figure.axes if axes.get_legend())]
        pairs = [pair for legend in legends for pair in zip(legend.legend_handles, legend.get_texts(), strict=True)]
        looks += [handle for handle, text in pairs if text.get_text() == "$H=0.4$"]
    assert len(looks) > 5
    assert len({to_hex(look.get_color()) for look in looks}) == 1
    assert {look.get_marker() for look in looks} <= {"s", "", "None"}


def test_texts_of_the_report_can_be_filled_in():
    """The caption of a figure may use the params of the figure's rule; other captions have no params.

    The settings may have changed since the figure was drawn, so captions do not use them; changed params redraw it.
    """
    conventions = {"conventions": SHOWN}
    for path in REPORT.rglob("*.rst"):
        has_conventions = path.stem in FIGURES and '"conventions": SHOWN' in RULES[FIGURES[path.stem]]
        template = jinja2.Environment(undefined=jinja2.StrictUndefined).from_string(path.read_text(encoding="utf-8"))
        assert "{" not in template.render(snakemake={"params": {"options": conventions if has_conventions else {}}}), (
            path
        )


def test_every_caption_belongs_to_a_result():
    assert {path.stem for path in REPORT.glob("figures/*.rst")} == set(FIGURES)
    assert {path.stem for path in REPORT.glob("*.rst")} == {"page", "workflow"}
