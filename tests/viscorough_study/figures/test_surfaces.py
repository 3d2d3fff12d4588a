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
    assert len(figure.axes) == 2 * number  # each with its own scale
    for axes, (hurst, heights, _) in zip(shown, examples, strict=True):
        (image,) = axes.images
        np.testing.assert_array_equal(image.get_array().filled(np.nan), heights)
        assert image.get_extent() == pytest.approx([-0.5, 0.5, -0.5, 0.5])
        assert image.get_clim() == (np.nanmin(heights), np.nanmax(heights))
        assert sum(image.to_rgba(np.nanmax(heights))[:3]) < 0.1 < 2.9 < sum(image.to_rgba(np.nanmin(heights))[:3])
        assert axes.get_title() == f"$H={hurst:g}$"
    assert whole_on_page(figure)
