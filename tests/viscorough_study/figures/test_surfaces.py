"""Figure 1 of the paper."""

import numpy as np
import pytest

from support.figures import ELEMENTS, whole_on_page
from viscorough.surfaces import self_affine_disc
from viscorough_study.figures.surfaces import plot_surfaces

pytestmark = pytest.mark.filterwarnings("error")


@pytest.mark.parametrize("number", [1, 2, 5])
def test_surfaces_are_shown_darker_where_higher(number):
    exponents = np.linspace(0.1, 0.9, number)
    examples = [(h, self_affine_disc(h, ELEMENTS, seed=1).heights, 1 / ELEMENTS) for h in exponents]
    figure = plot_surfaces(examples)
    shown = [axes for axes in figure.axes if axes.images]
    assert len(shown) == number
    assert len(figure.axes) == number + 1  # one colour scale for all
    ends = min(np.nanmin(heights) for _, heights, _ in examples), max(np.nanmax(heights) for _, heights, _ in examples)
    for axes, (hurst, heights, _) in zip(shown, examples, strict=True):
        (image,) = axes.images
        np.testing.assert_array_equal(image.get_array().filled(np.nan), heights)
        assert image.get_extent() == pytest.approx([-0.5, 0.5, -0.5, 0.5])
        assert image.get_clim() == ends
        grey = image.to_rgba(np.linspace(*ends, 20))[:, :3] @ (0.3, 0.6, 0.1)
        assert (np.diff(grey) < 0).all()
        assert axes.get_title() == f"$H={hurst:g}$"
    assert whole_on_page(figure)
