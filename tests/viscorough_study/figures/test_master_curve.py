"""Figure 3 of the paper: both sides of Eq. 12."""

import numpy as np
import pytest
from matplotlib.colors import to_rgb

from support.figures import X, dashed, whole_on_page, without_region
from support.study import SHOWN
from viscorough import reference
from viscorough_study.conventions import fits
from viscorough_study.figures.master_curve import plot_master_curve

pytestmark = pytest.mark.filterwarnings("error")


@pytest.mark.parametrize("average", ["geometric", "arithmetic"])
def test_master_curve_draws_both_sides_of_the_law(pooled, lines, scaling, average):
    shown = SHOWN | {"average": average}
    figure = plot_master_curve(pooled, lines, scaling, shown, fraction_min=0.95)
    law, ratio = figure.axes
    (identity,) = dashed(law)
    np.testing.assert_array_equal(identity.get_xdata(), identity.get_ydata())
    np.testing.assert_array_equal(dashed(ratio)[0].get_ydata(), 1)
    windows = fits(scaling, shown, source="discs", case_group="base").set_index("hurst")
    for ensemble, (inside, outside) in zip(
        pooled, zip(law.containers[::2], law.containers[1::2], strict=True), strict=True
    ):
        hurst = ensemble["hurst"].item()
        right = reference.rate_law(X, hurst, gamma=True)
        left = ensemble[f"velocity_{average}"].sel(rms_convention="disc").values
        window = (windows.x_low[hurst] * 0.999 < X) & (windows.x_high[hurst] * 1.001 > X)
        for (marks, _, bars), drawn_inside in ((inside, True), (outside, False)):
            x, y = marks.get_data()
            at = np.searchsorted(right, x * (1 - 1e-9))
            np.testing.assert_allclose(x, right[at], rtol=1e-12)
            np.testing.assert_allclose(y, left[at], rtol=1e-12)
            assert (window[at] == drawn_inside).all()
            assert x.size >= 3
            assert (to_rgb(marks.get_markerfacecolor()) == (1, 1, 1)) != drawn_inside
            spread = ensemble["velocity_spread"].sel(rms_convention="disc").values[at]
            error = 2 * spread / np.sqrt(ensemble["realizations_defined"].sel(rms_convention="disc").values[at])
            ends = np.array([segment[:, 1] for segment in bars[0].get_segments()])
            np.testing.assert_allclose(np.log(ends / y[:, None]), np.transpose([-error, error]), atol=1e-9)
    for ensemble, line in zip(lines, [each for each in law.lines if each.get_zorder() == 3], strict=True):
        kept = (ensemble["contact_count_median"].values[0] > 1) & (ensemble["fraction_defined"].values[0] == 1)
        np.testing.assert_allclose(line.get_ydata(), ensemble[f"velocity_{average}"].values[0][kept], rtol=1e-12)
    assert whole_on_page(figure)


def test_master_curve_of_one_realization_without_region(discs, lines, scaling):
    single = [ds.isel(realization=[0]) for ds in discs[::2]]
    for ds in single:  # as the ensemble of one realization has it
        ds["velocity_spread"] = ds["velocity_spread"] * np.nan
        ds["realizations_defined"] = ds["realizations_defined"] * 0 + 1
    figure = plot_master_curve(single, lines[:1], without_region(scaling, 0.4), SHOWN, fraction_min=0.95)
    inside, outside = figure.axes[0].containers[:2]
    assert inside[0].get_xdata().size == 0
    assert outside[0].get_xdata().size > 3
    assert whole_on_page(figure)
