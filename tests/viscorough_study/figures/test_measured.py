"""Figure of measured surfaces."""

import numpy as np

from support.figures import legend_texts, measured_figure, measured_kinetics, whole_on_page
from support.study import SHOWN
from viscorough_study.figures.measured import plot_measured


def test_every_scan_is_drawn_beside_the_generated_discs(pooled, scaling):
    figure = measured_figure(pooled, scaling)
    law, motion = figure.axes
    scans = pooled[0].sizes["realization"]
    fitted = [line for line in law.lines if line.get_linewidth() == 3]
    assert len(law.lines) == len(pooled) + scans + len(fitted)
    for line in fitted:  # from end to end of region (b), at the slope of the fit
        (x0, y0), (x1, y1) = line.get_xydata()
        rows = scaling[np.isclose(scaling["x_low"], x0) & np.isclose(scaling["x_high"], x1)]
        assert np.isclose(np.log(y1 / y0) / np.log(x1 / x0), rows["beta"]).any()
    assert len(motion.lines) == 8
    np.testing.assert_allclose(motion.lines[0].get_ydata(), measured_kinetics()["depth"][:13] * 1e6)
    assert "polished" in legend_texts(figure.legends[0])
    assert motion.get_title() == "(b) depth under 0.1, 1 N"
    assert whole_on_page(figure)


def test_without_forces_there_is_no_motion(pooled, scaling):
    none = measured_kinetics()[:0]
    motion = plot_measured({"polished": pooled[0]}, pooled, scaling, none, SHOWN, fraction_min=0.95).axes[1]
    assert motion.get_title() == "(b) depth: no forces were given"
