"""Figure 4 of the paper: lines, discs and Eq. 10."""

import numpy as np
import pytest

from support.figures import dashed, legend_texts, markers, whole_on_page, without_region
from support.study import SHOWN
from viscorough_study.conventions import fits
from viscorough_study.figures.conventions import plot_conventions
from viscorough_study.figures.exponent import plot_exponent

pytestmark = pytest.mark.filterwarnings("error")


def test_exponent_draws_lines_discs_and_law(scaling):
    figure = plot_exponent(scaling, SHOWN, (0.4, 1.0))
    (axes,) = figure.axes
    solid = next(line for line in axes.lines if line.get_color() == "black")
    rows = fits(scaling, SHOWN, source="lines", case_group="base", rms_convention="line")
    np.testing.assert_array_equal(solid.get_xydata(), rows[["hurst", "beta"]])
    band = axes.collections[0].get_paths()[0].vertices
    assert {*rows["beta_low"], *rows["beta_high"]} <= set(band[:, 1])
    marks = [line.get_xydata()[0] for line in markers(axes)]
    discs = fits(scaling, SHOWN, source="discs", case_group="base")
    np.testing.assert_array_equal(marks, discs[["hurst", "beta"]])
    ends = [container.lines[2][0].get_segments()[0][:, 1] for container in axes.containers]
    np.testing.assert_allclose(ends, discs[["beta_low", "beta_high"]], rtol=1e-12)
    (law,) = dashed(axes)
    np.testing.assert_allclose(law.get_ydata(), law.get_xdata() / (1 + law.get_xdata()))
    assert legend_texts(figure.legends[0])[1:] == [
        "MDR, 2 lines for each $H$",
        "boundary elements, 4 discs for each $H$",
    ]
    assert whole_on_page(figure)


def test_exponent_leaves_out_what_has_no_region(scaling):
    partial = plot_exponent(without_region(scaling, 0.4), SHOWN, (0.4, 1.0)).axes[0]
    whole = plot_exponent(scaling, SHOWN, (0.4, 1.0)).axes[0]
    (kept,) = markers(partial)
    assert kept.get_xdata().tolist() == [0.9]
    assert kept.get_marker() == markers(whole)[1].get_marker()  # as in the other figures
    assert not markers(plot_exponent(scaling[scaling["source"] == "lines"], SHOWN, (0.4, 1.0)).axes[0])


def test_an_interval_need_not_hold_its_value(scaling):
    """A bootstrap interval may not, and is drawn where it is."""
    scaling = scaling.assign(beta_low=scaling["beta"] + 0.1, beta_high=scaling["beta"] + 0.3)
    axes = plot_exponent(scaling, SHOWN, (0.4, 1.0)).axes[0]
    ends = axes.containers[0].lines[2][0].get_segments()[0][:, 1]
    np.testing.assert_allclose(ends - markers(axes)[0].get_ydata(), [0.1, 0.3])
    assert markers(plot_conventions(scaling, SHOWN).axes[0])


def test_fits_are_the_rows_under_the_conventions_shown(scaling):
    rows = fits(scaling.iloc[::-1], SHOWN, source="discs", case_group="base")
    assert rows["hurst"].tolist() == [0.4, 0.9]
    assert (rows[list(SHOWN)] == list(SHOWN.values())).all(axis=None)
    assert fits(scaling, SHOWN, window_rule="kappa", source="discs", case_group="base")["window_rule"].eq("kappa").all()
    assert fits(without_region(scaling, 0.4), SHOWN, source="discs", case_group="base")["hurst"].tolist() == [0.9]
