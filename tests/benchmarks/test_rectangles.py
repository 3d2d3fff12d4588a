"""The comparison of rectangular with square elements: what is compared is the same map, on elements of equal area."""

import numpy as np
import pytest

from support.benchmarks import load_benchmark

rectangles = load_benchmark("rectangles")


def test_every_aspect_is_measured_and_compared_with_squares():
    heights = np.random.default_rng(1).random((24, 24))
    costs = rectangles.measure(heights, 2)
    assert list(costs) == ["1", "2", "0.5", "5", "0.2"]
    assert costs["1"]["over_squares"] == 1
    for cost in costs.values():
        assert cost["processor_s"] > 0
        assert cost["levels"] > 100
        assert cost["over_squares"] == pytest.approx(cost["processor_s"] / costs["1"]["processor_s"], rel=1)


def test_maps_are_those_of_the_name():
    maps = rectangles.maps()
    assert {heights.shape for heights in maps.values()} == {(rectangles.ELEMENTS, rectangles.ELEMENTS)}
    assert [bool(np.isnan(heights).any()) for heights in maps.values()] == [name[0] == "d" for name in maps]
