"""Every caption describes its figure: the panels, the quantities on the axes, the kinds of lines and markers.

Panels that have a letter in their title are named by it in the caption, as "(a)"; others by their place, as "Left:" or
"Above:". Where a table decides how many panels there are, the caption says for what: "one panel for each quantity".
"""

import re
from dataclasses import dataclass

import jinja2
import pytest
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.text import Text

from support import figures as tables
from support.study import BASE_SURFACES, ROOT, SHOWN
from support.workflow import FIGURES, RESULTS, read_settings
from viscorough.surfaces import self_affine_disc
from viscorough_study.figures.collapse import plot_collapse
from viscorough_study.figures.conventions import plot_conventions
from viscorough_study.figures.direct_integration import plot_direct_integration
from viscorough_study.figures.exponent import plot_exponent
from viscorough_study.figures.failure_map import LETTERS, plot_failure_map
from viscorough_study.figures.growth import plot_growth
from viscorough_study.figures.interface import plot_interface
from viscorough_study.figures.kinetics import plot_kinetics
from viscorough_study.figures.large import plot_large
from viscorough_study.figures.level_placement import plot_level_placement
from viscorough_study.figures.master_curve import plot_master_curve
from viscorough_study.figures.mdr_comparison import plot_mdr_comparison
from viscorough_study.figures.mdr_lambda import plot_mdr_lambda
from viscorough_study.figures.media import plot_media
from viscorough_study.figures.media_exponents import plot_media_exponents
from viscorough_study.figures.other_solvers import plot_other_solvers
from viscorough_study.figures.prefactors import plot_prefactors
from viscorough_study.figures.sizes import plot_sizes
from viscorough_study.figures.speed import plot_speed
from viscorough_study.figures.style import SMALL
from viscorough_study.figures.surfaces import plot_surfaces
from viscorough_study.figures.validation import plot_validation
from viscorough_study.fits.prefactors import prefactors

REPORT = ROOT / "workflow" / "report"
SYMBOLS = {r"\alpha": "α", r"\beta": "β", r"\zeta": "ζ", r"\kappa": "κ", r"\eta": "η", r"\lambda": "λ", r"\ln": "ln "}
RIGHT_SIDE = r"right side of Eq. 12, $X^{H/(1+H)} /\, [(2-H)\,\Gamma(2-\alpha)]$"


@dataclass(frozen=True)
class Drawn:
    """A figure, and where the table decides on its panels, {name of what a panel or column is for: their number}."""

    figure: Figure
    repeated: dict | None = None


@pytest.fixture(scope="session")
def drawn(discs, pooled, lines, scaling, combinations):
    """{name of the caption: its figure}, from small tables."""
    heights = self_affine_disc(0.5, 9, seed=1).heights
    return {
        "fig1_surfaces": Drawn(plot_surfaces([(h, heights, 1 / 9) for h in (0.1, 0.5, 0.9)]), {"Hurst exponent": 3}),
        "fig2_kinetics": Drawn(plot_kinetics(discs, combinations, scaling, SHOWN, fraction_min=0.95)),
        "fig3_master_curve": Drawn(plot_master_curve(pooled, lines, scaling, SHOWN, fraction_min=0.95)),
        "fig4_exponent": Drawn(plot_exponent(scaling, SHOWN, (0.4, 1.0))),
        "conventions": Drawn(plot_conventions(scaling, SHOWN), {"Hurst exponent": 2}),
        "prefactors": Drawn(plot_prefactors(prefactors(scaling, BASE_SURFACES), SHOWN)),
        "interface": Drawn(plot_interface(*tables.interface_tables_drawn(), tables.literature_table(), SHOWN)),
        "validation": Drawn(plot_validation(tables.validation_table()), {"quantity": 2}),
        "direct": Drawn(plot_direct_integration(tables.direct_table()), {"indenter": 2}),
        "reduction": Drawn(plot_mdr_comparison(tables.mdr_table())),
        "mdr_lambda": Drawn(plot_mdr_lambda(*tables.mdr_lambda_tables())),
        "media": Drawn(plot_media(tables.media_table()), {"medium": 2}),
        "media_exponents": Drawn(plot_media_exponents(tables.media_table()), {"medium": 2}),
        "measured": Drawn(tables.measured_figure(pooled, scaling)),
        "sizes": Drawn(plot_sizes(tables.sizes_table(), SHOWN)),
        "collapse": Drawn(plot_collapse(tables.curves_of_sizes(), *tables.collapse_tables())),
        "large": Drawn(plot_large(tables.large_table())),
        "speed": Drawn(plot_speed(tables.methods_table())),
        "growth": Drawn(plot_growth(tables.methods_table())),
        "other_solvers": Drawn(plot_other_solvers(tables.other_solvers_table())),
        "level_placement": Drawn(plot_level_placement(tables.level_placement_table())),
        "failure_map": Drawn(plot_failure_map(tables.failure_table(LETTERS))),
    }


# ---- what a figure shows, and what a caption says


def panels(figure):
    return [axes for axes in figure.axes if axes.get_label() not in ("<colorbar>", "<table>")]


def names_of_panels(figure):
    """Letters of the panels, or their places if there are two in a row or two rows; empty where they repeat."""
    letters = [re.match(r"\([a-z]\)", axes.get_title()) for axes in panels(figure)]
    if any(letters):
        return {match.group() for match in letters}
    grids = {axes.get_gridspec().get_geometry() for axes in panels(figure)}
    places = {(1, 2): {"left", "right"}, (2, 1): {"above", "below"}, (2, 2): {"above", "below"}}
    return places.get(grids.pop(), set())


def names_in_caption(caption):
    """Letters of panels, which are not those of regions, and places, that a caption speaks of."""
    caption = re.sub(r"regions? \([abc]\)( and \([abc]\))?", "", caption)
    letters = re.findall(r"\([a-z]\)", caption)
    return {*letters, *(place.lower() for place in re.findall(r"\b(Left|Right|Above|Below):", caption))}


def repeated_in_caption(caption):
    """What there is a panel or a column for, each."""
    return re.findall(r"one (?:panel|column) for each (Hurst exponent|quantity|indenter|medium)", caption)


def quantities(figure):
    """What the axes are labelled with, without units and formatting."""
    labels = {text for axes in figure.axes for text in (axes.get_xlabel(), axes.get_ylabel()) if text}
    labels = {re.sub(r" \([^()]*\)$", "", label) for label in labels}
    return {plain(quantity) for label in labels for quantity in label.split(", or ")}


def plain(text):
    """Text in which mathematics and spaces are comparable."""
    for name, symbol in SYMBOLS.items():
        text = text.replace(f"{name} ", symbol).replace(name, symbol)
    return " ".join(re.sub(r"\\,|\$", "", text).replace("\\Gamma", "Γ").replace(" = ", "=").split())


def faults(caption, drawn):
    """What a caption says wrongly of a figure, or does not say."""
    figure, caption = drawn.figure, plain(caption)
    wrong = []
    shown, named = names_of_panels(figure), names_in_caption(caption)
    if repeated := drawn.repeated:
        wrong += [] if repeated_in_caption(caption) == list(repeated) else [f"panels are for each {repeated}"]
        shown = shown if named else set()
    wrong += [f"panel {name} is not described" for name in sorted(shown - named)]
    wrong += [f"there is no panel {name}" for name in sorted(named - shown)]
    said = caption.lower().replace("right side of the paper's eq. 12", plain(RIGHT_SIDE).lower())
    wrong += [f"axis {label} is not described" for label in quantities(figure) if label.lower() not in said]
    artists = [line for axes in figure.axes for line in axes.lines]
    artists += [handle for legend in figure.legends for handle in legend.get_lines()]
    for word, is_drawn in {
        "dotted": any(line.get_linestyle() == ":" for line in artists),
        "dashed": any(line.get_linestyle() == "--" for line in artists),
        "crosses": any(line.get_marker() == "x" for line in artists),
        "hollow": any(line.get_markerfacecolor() in ("none", "white") for line in artists),
        "hatched": any(patch.get_hatch() for axes in figure.axes for patch in axes.patches),
        "rings": any(line.get_markersize() > 8 and line.get_markerfacecolor() == "none" for line in artists),
    }.items():
        wrong += [f"nothing is {word}"] if word in said and not is_drawn else []
    return wrong


# ---- the captions of the report


def read(name):
    return (REPORT / f"figures/{name}.rst").read_text(encoding="utf-8")


def test_every_figure_of_the_report_is_drawn_here(drawn):
    assert sorted(FIGURES) == sorted(drawn)


@pytest.mark.parametrize("name", FIGURES)
def test_caption_describes_its_figure(drawn, name):
    assert faults(read(name), drawn[name]) == []


def test_panels_are_as_many_as_what_they_are_for(drawn):
    for name, rows in {"fig1_surfaces": 1, "conventions": 2, "validation": 1}.items():
        (number,) = drawn[name].repeated.values()
        assert len(panels(drawn[name].figure)) == rows * number
    assert len(panels(drawn["direct"].figure)) == drawn["direct"].repeated["indenter"]


@pytest.mark.parametrize(
    ("name", "change", "fault"),
    [
        ("speed", ("(b)", "(b) and (c)"), "there is no panel (c)"),
        ("speed", ("(b)", ""), "panel (b) is not described"),
        ("fig2_kinetics", ("Right:", "Below:"), "panel right is not described"),
        ("fig2_kinetics", ("time t", "t"), "axis time t is not described"),
        ("fig3_master_curve", ("right side", "left side"), "axis right side"),
        ("validation", ("one panel for each quantity", ""), "panels are for each"),
        ("growth", ("wall time", "dashed: time"), "nothing is dashed"),
        ("growth", ("wall time", "hatched: time"), "nothing is hatched"),
        ("sizes", ("(a)", "(a) region (b)"), None),
    ],
)
def test_faults_of_captions_are_seen(drawn, name, change, fault):
    seen = faults(plain(read(name)).replace(*change), drawn[name])
    assert any(each.startswith(fault) for each in seen) if fault else seen == []


def test_units_stand_in_parentheses_and_dimensionless_quantities_have_none(drawn):
    units = set()
    for each in drawn.values():
        labels = [text for axes in each.figure.axes for text in (axes.get_xlabel(), axes.get_ylabel())]
        assert not [label for label in labels if re.search(r" \[\w*\]$", label)]
        units |= {match.group(1) for label in labels if (match := re.search(r" \(([^()]*)\)$", label))}
    assert units - {"b"} == {"s", "m/s", "µm", "GB", "darker is higher"}  # region (b)


def test_no_text_is_smaller_than_the_smallest_size(drawn):
    for name, each in drawn.items():
        texts = [text for text in each.figure.findobj(Text) if text.get_text()]
        assert min(text.get_fontsize() for text in texts) >= SMALL, name


def test_a_hurst_exponent_looks_the_same_in_all_figures(drawn):
    """Colour and, where there are markers, marker in every figure that has the exponent in its legend or a title."""
    looks = []
    for figure in (each.figure for each in drawn.values()):
        legends = [*figure.legends, *(axes.get_legend() for axes in figure.axes if axes.get_legend())]
        pairs = [pair for one in legends for pair in zip(one.legend_handles, one.get_texts(), strict=True)]
        looks += [handle for handle, text in pairs if text.get_text() == "$H=0.4$"]
        titled = [axes for axes in figure.axes if axes.get_title().endswith("$H=0.4$")]
        looks += [line for axes in titled for line in axes.lines if line.get_marker() not in ("None", "", "|")]
    assert len(looks) > 8
    assert len({to_hex(look.get_color()) for look in looks}) == 1
    assert {look.get_marker() for look in looks} <= {"s", "", "None"}


def test_letters_of_verdicts_are_explained():
    explained = dict(re.findall(r"\b([A-Z]): ([\w ]+)", plain(read("failure_map"))))
    assert set(explained) == set(LETTERS.values())


def test_captions_take_no_counts_from_the_settings():
    """Settings may have changed since the figure was drawn; the params of its rule redraw it when they change."""
    for path in REPORT.rglob("*.rst"):
        assert "snakemake.config" not in path.read_text(encoding="utf-8"), path


def test_texts_of_the_report_can_be_filled_in():
    """From those params that the rule of the caption really has: that of a figure; all others have none."""
    settings = read_settings("config")
    for path in REPORT.rglob("*.rst"):
        params = FIGURES[path.stem].get("params", []) if path.parent.name == "figures" else []
        template = jinja2.Environment(undefined=jinja2.StrictUndefined).from_string(path.read_text(encoding="utf-8"))
        assert "{" not in template.render(snakemake={"params": dict.fromkeys(params, settings["figures"])}), path


def test_every_caption_is_that_of_a_result():
    assert {path.stem for path in REPORT.glob("tables/*.rst")} == set(RESULTS["tables"])
    assert {path.stem for path in REPORT.glob("figures/*.rst")} == set(FIGURES)
    assert {path.stem for path in REPORT.glob("*.rst")} == {"page", "workflow"}


def test_figures_of_the_page_are_described_for_those_who_cannot_see_them():
    assert all(len(figure["alternative"]) > 40 for figure in FIGURES.values() if "alternative" in figure)
    assert {name for name, figure in FIGURES.items() if "alternative" not in figure} == {
        "growth",
        "other_solvers",
        "large",
    }
