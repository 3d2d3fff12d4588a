"""Figures show the numbers of their tables, lie whole on their page, and say if their table has no rows."""

import numpy as np
import pandas as pd
import pytest
from matplotlib.text import Text

from support import figures as tables
from support.figures import drawn_points, plot, published, whole_on_page
from support.study import SHOWN
from viscorough_study.comparisons.histories import FORCE_CURVE, RECOVERY
from viscorough_study.figures.exponent import SHIFT
from viscorough_study.figures.style import SMALL
from viscorough_study.fits.conventions import READINGS, fits

pytestmark = pytest.mark.filterwarnings("error")


def close(line, expected):
    np.testing.assert_allclose(line, expected, rtol=1e-9)


@pytest.mark.long
def test_figures_are_whole_and_no_text_is_too_small(drawn):
    assert [name for name, figure in drawn.items() if not whole_on_page(figure)] == []
    for name, figure in drawn.items():
        texts = [text for text in figure.findobj(Text) if text.get_text()]
        assert min(text.get_fontsize() for text in texts) >= SMALL, name


@pytest.mark.parametrize("name", tables.FROM_TABLES)
def test_figure_of_no_rows_says_so(name):
    first, *others = tables.FROM_TABLES[name]
    (text,) = plot(tables.MODULES[name], first[:0], *others).texts
    assert text.get_text() == "no data with these settings"


# ---- numbers of tables


def points(rows, x, *columns):
    """Points (x, column) of the rows; nan for an x or column that is None, because its values are shifted."""
    rows = rows.assign(none=np.nan)
    return np.concatenate([rows[[x or "none", column or "none"]].to_numpy() for column in columns])


def expected_points(scaling):
    """(figure, panel, points that its axes have)"""
    reduction, lambdas = published("reduction"), published("mdr_lambda")
    media, curves, interface = tables.media_table(), tables.interface_curves(), published("interface")
    lines = fits(scaling, SHOWN, source="lines", rms_convention="line")
    interval = ("beta", "beta_low", "beta_high")
    yield "fig4_exponent", 0, points(lines, "hurst", *interval)
    for reading, columns in READINGS.items():
        rows = fits(scaling, SHOWN | columns, source="discs")
        yield "fig4_exponent", 0, points(rows.assign(place=rows["hurst"] + SHIFT[reading]), "place", *interval)
    for panel, name in ((0, "stiffness"), (2, "area"), (3, "gap")):
        columns = [f"{name}_ratio{end}" for end in ("", "_low", "_high")]
        yield "reduction", panel, points(reduction.dropna(subset=columns), "x", *columns)
    yield "reduction", 4, points(reduction, "x", "correlation")
    yield "reduction", 5, points(reduction, "x", "force_ratio")
    yield "mdr_lambda", 0, points(lambdas, "x", "lambda", "lambda_low", "lambda_high")
    yield "mdr_lambda", 1, points(lambdas, "x", "velocity_ratio")
    yield "mdr_lambda", 2, points(published("mdr_exponents"), None, "difference")
    for figure, table, key, x, y in (
        ("media", media, "medium", "time", "velocity"),
        ("validation", published("validation"), "quantity", "elements", "error"),
        ("direct", published("direct"), "case", "contact_count", "depth_ratio"),
    ):
        for panel, (_, rows) in enumerate(table.groupby(key, sort=False)):
            yield figure, panel, points(rows, x, y)
    yield "media", 2, points(media, "x", "depth")
    motions = dict(tuple(tables.histories_table().query("hurst == 0.9").groupby("motion")))
    yield "histories", 0, points(motions[FORCE_CURVE], "depth", "force", "direct")
    yield "histories", 1, points(motions[RECOVERY].query("time >= 0"), "time", "depth", "direct")
    yield (
        "interface",
        0,
        points(curves[curves["source"] == "discs"], "x", "interface", "interface_low", "interface_high"),
    )
    yield "interface", 0, points(published("periodic"), "x", "g")
    yield "interface", 3, points(interface.query("source == 'discs'"), None, "u0", "u0_low")
    fine = tables.FROM_TABLES["local_exponent"][0].query("finest == 1")
    fine = fine.assign(middle=fine["x_low"] * np.sqrt(10))
    for panel, quantity in enumerate(("whole", "interface")):
        yield "local_exponent", panel, points(fine[fine["quantity"] == quantity], "middle", "beta")
    yield "fig4_exponent", 0, points(pd.DataFrame(tables.FINE_GRIDS), "hurst", *interval)


def test_figures_show_the_numbers_of_their_tables(drawn, scaling):
    for figure, panel, expected in expected_points(scaling):
        shown = drawn_points(drawn[figure].axes[panel])
        expected = expected[~np.isnan(expected).all(axis=1)][:, None]
        assert len(expected) > 1
        near = (np.isclose(shown, expected, rtol=1e-9, atol=1e-12) | np.isnan(expected)).all(axis=2).any(axis=1)
        assert near.all(), (figure, panel, expected[~near])
