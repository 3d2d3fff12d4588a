"""Figure 2 of the paper: its units and its regions."""

import numpy as np
import pytest

from support.figures import COMBINATIONS, ELEMENTS, ENSEMBLES, HURST, ensemble_name
from support.study import SHOWN
from viscorough import reference
from viscorough.viscous.kinetics import kinetics
from viscorough_study.figures.kinetics import plot_kinetics
from viscorough_study.fits.conventions import fits

pytestmark = pytest.mark.filterwarnings("error")


@pytest.fixture(scope="module")
def figure(discs, scaling):
    return plot_kinetics(discs, ENSEMBLES, scaling, SHOWN, fraction_min=0.95)


def test_kinetics_agree_with_the_curves_in_real_units(curves, figure):
    """viscorough.viscous.kinetics does not use X. The geometric mean of v at the drawn times must agree."""
    scaled, moving = ({line.get_label(): line.get_data() for line in axes.lines} for axes in figure.axes[:2])
    for hurst, name in curves:
        at, label = COMBINATIONS[name], ensemble_name(hurst, name)
        beyond_region_a = np.isfinite(moving[label][1]).nonzero()[0][-len(scaled[label][0]) :]
        time, velocity = np.array(moving[label])[:, beyond_region_a]
        velocities = [kinetics(curve, at["force"], at["viscosity"], time).velocity for curve in curves[hurst, name]]
        np.testing.assert_allclose(velocity, np.sqrt(velocities[0] * velocities[1]), rtol=1e-9)
        unit = 4 * at["rms"] * at["viscosity"] * at["diameter"]
        np.testing.assert_allclose(scaled[label], [at["force"] * time / unit, velocity * time / at["rms"]], rtol=1e-12)


def test_kinetics_mark_the_regions(figure, scaling):
    axes = figure.axes[0]
    bars = [line.get_xdata() for line in axes.lines if line.get_transform() == axes.get_xaxis_transform()]
    fitted = fits(scaling[scaling["hurst"].isin(HURST)], SHOWN, source="discs", group="base")
    np.testing.assert_allclose(sorted(map(tuple, bars)), sorted(zip(fitted.x_low, fitted.x_high, strict=True)))
    first, last = (line.get_xydata() for line in axes.lines if line.get_linestyle() == ":")
    kappa = reference.one_element_stiffness(ELEMENTS)
    np.testing.assert_allclose(first[:, 1], first[:, 0] / kappa)
    np.testing.assert_allclose(last[:, 1], last[:, 0])


@pytest.mark.parametrize(("fraction_min", "shown"), [(0.5, True), (0.6, False)])
def test_means_over_few_realizations_are_left_out(discs, scaling, fraction_min, shown):
    beyond = discs[0]["x"] > 1.0
    few = discs[0].assign(fraction_defined=discs[0]["fraction_defined"].where(~beyond, 0.5))
    figure = plot_kinetics([few], ENSEMBLES, scaling, SHOWN, fraction_min=fraction_min)
    (line,) = [line for line in figure.axes[0].lines if line.get_label() in ENSEMBLES]
    assert (line.get_xdata().max() > 1.1) == shown


def test_kinetics_name_combinations_with_their_values(figure):
    raw = figure.axes[1]
    assert {text.get_text() for text in raw.texts} == set(COMBINATIONS)
    assert "c1: 1 N, 1×10⁶ Pa s, 10 mm, 1 µm" in raw.get_title().split("\n")
