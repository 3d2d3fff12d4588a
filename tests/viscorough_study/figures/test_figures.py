"""Figures 3 and 4 of the paper show the numbers of their tables; figures say if their table has no rows."""

import numpy as np
import pandas as pd
import pytest

from support.figures import X, drawn_points
from support.study import FINE, SHOWN
from viscorough import reference
from viscorough_study.comparisons import direct_integration, mdr_comparison, media_kinetics, validation
from viscorough_study.figures.direct import plot_direct
from viscorough_study.figures.exponent import SHIFT, plot_exponent
from viscorough_study.figures.local_exponent import plot_local_exponent
from viscorough_study.figures.master_curve import plot_master_curve
from viscorough_study.figures.mdr_lambda import plot_mdr_lambda
from viscorough_study.figures.media import plot_media
from viscorough_study.figures.reduction import plot_reduction
from viscorough_study.figures.surfaces import plot_surfaces
from viscorough_study.figures.validation import plot_validation
from viscorough_study.fits import fine_grids
from viscorough_study.fits.conventions import READINGS, fits
from viscorough_study.run.names import WINDOWS

pytestmark = pytest.mark.filterwarnings("error")

OF_TABLES = {
    plot_direct: direct_integration.COLUMNS,
    plot_local_exponent: fine_grids.EXPONENTS,
    plot_media: media_kinetics.COLUMNS,
    plot_reduction: mdr_comparison.COLUMNS,
    plot_validation: validation.COLUMNS,
}


@pytest.mark.parametrize("plot", OF_TABLES)
def test_figure_of_no_rows_says_so(plot):
    (text,) = plot(pd.DataFrame(columns=list(OF_TABLES[plot]), dtype=float)).texts
    assert text.get_text() == "no data with these settings"


def combinations(**values):
    """Return the table of all combinations of the values of columns."""
    return pd.MultiIndex.from_product(values.values(), names=values).to_frame(index=False)


MEDIA = combinations(medium=["newtonian", "maxwell"], hurst=[0.4, 0.9], time=[0.1, 1.0, 10.0], realizations=[6])
GRIDS = combinations(quantity=["force", "area"], comparison=["sphere", "cone"], elements=[33, 65], passed=[True])


@pytest.mark.parametrize(
    ("plot", "table", "panel", "x", "y"),
    [
        (plot_media, MEDIA, "medium", "time", "velocity"),
        (plot_validation, GRIDS, "quantity", "elements", "error"),
    ],
)
def test_panels_show_the_numbers_of_their_rows(plot, table, panel, x, y):
    numbers = {"x": 0.01, "depth": 1.0, "expected_order": 1.0, "observed_order": 1.0, "limit": 0.1}
    table = table.assign(**numbers, **{y: np.random.default_rng(1).uniform(0.5, 2, len(table))})
    figure = plot(table)
    for axes, (_, rows) in zip(figure.axes, table.groupby(panel, sort=False), strict=False):
        shown = drawn_points(axes)
        for point in rows[[x, y]].to_numpy():
            assert np.isclose(shown, point, rtol=1e-9).all(axis=1).any(), point


def test_panel_of_the_equivalence_holds_every_difference_of_exponents():
    exponents = combinations(hurst=[0.1, 0.9], window=list(WINDOWS))
    exponents = exponents.assign(difference=[-0.2, 0.1, 0.0] * 2, difference_low=-0.3, difference_high=0.2)
    columns = [f"{name}{end}" for name in ("lambda", "velocity_ratio") for end in ("", "_low", "_high")]
    lambdas = combinations(hurst=[0.1, 0.9], x=[1e-3, 1e-2], in_region=[1]).assign(**dict.fromkeys(columns, 1.0))
    axes = plot_mdr_lambda(lambdas, exponents).axes[2]
    shown = drawn_points(axes)
    assert len(shown) > len(exponents)
    for points, (low, high) in zip(shown.T, (axes.get_xlim(), axes.get_ylim()), strict=True):
        assert low <= points.min() <= points.max() <= high


def test_exponents_and_their_intervals_are_those_of_the_fits(scaling):
    axes = plot_exponent(scaling, SHOWN, 0.4, FINE).axes[0]
    shown = drawn_points(axes)
    lines = fits(scaling, SHOWN, source="lines", rms_convention="line")
    expected = [lines, pd.DataFrame(FINE)]
    for reading, columns in READINGS.items():
        rows = fits(scaling, SHOWN | columns, source="discs")
        expected.append(rows.assign(hurst=rows["hurst"] + SHIFT[reading]))
    for rows in expected:
        assert len(rows) > 1
        for name in ("beta", "beta_low", "beta_high"):
            for point in rows[["hurst", name]].to_numpy():
                assert np.isclose(shown, point, rtol=1e-9).all(axis=1).any(), (name, point)


def test_master_curve_is_bold_in_region_b_of_each_reading(pooled, lines, scaling):
    """The second reading has the ensemble of its square and the windows of its own rows."""
    _, *ratios = plot_master_curve(pooled, pooled[:1], lines, scaling, SHOWN, fraction_min=0.95).axes
    readings = (("base", "disc"), ("longer_period", "square"))
    for axes, members, (group, rms) in zip(ratios, (pooled, pooled[:1]), readings, strict=True):
        windows = fits(scaling, SHOWN, source="discs", group=group, rms_convention=rms).set_index("hurst")
        curves = [line for line in axes.lines if len(line.get_xdata()) > 2]
        for ensemble, thin, bold in zip(members, curves[::2], curves[1::2], strict=True):
            hurst, discs = ensemble["hurst"].item(), ensemble.sel(rms_convention=rms)
            expected = discs["velocity_geometric"].values / reference.rate_law(X, hurst, gamma=True)
            kept = (discs["contact_count_median"].values > 1) & (discs["fraction_defined"].values >= 0.95)
            np.testing.assert_allclose(thin.get_xydata(), np.transpose([X, expected])[kept], rtol=1e-9)
            inside = kept & (windows.x_low[hurst] * 0.999 < X) & (windows.x_high[hurst] * 1.001 > X)
            np.testing.assert_allclose(bold.get_xydata(), np.transpose([X, expected])[inside], rtol=1e-9)
            assert bold.get_linewidth() > 2 * thin.get_linewidth()


def test_surfaces_are_brighter_where_higher_and_lit_from_the_upper_left():
    """Rows are drawn from bottom to top."""
    place = np.arange(33) - 16.0
    distance = np.hypot(place, place[:, None])
    hill = np.where(distance < 16, 2 - distance / 4, np.nan)
    (image,) = plot_surfaces([(0.5, hill, 1 / 33)]).axes[0].images
    grey = image.get_array()[..., :3] @ (0.3, 0.6, 0.1)
    left, right, lower, upper = grey[16, 6], grey[16, 26], grey[6, 16], grey[26, 16]
    assert min(left, upper) > max(right, lower)
    assert grey[16, 14] > left
    assert (image.get_array()[np.isnan(hill), 3] == 0).all()
