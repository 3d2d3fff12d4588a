"""The comparison of strips with squares: what is compared is at equal contact."""

import pytest

from support.benchmarks import load_benchmark

strips = load_benchmark("strips")


@pytest.mark.parametrize("kind", strips.KINDS)
def test_shapes_are_compared_at_equal_contact(kind):
    for shape in ((40, 40), (1, 1600), (800, 2)):
        assert strips.KINDS[kind](shape).shape == shape
        cost = strips.measure(kind, shape)
        assert cost["last_contact_fraction"] == pytest.approx(strips.FRACTIONS[-1], abs=0.03)
        assert cost["peak_mb"] >= cost["before_mb"] > 0


def test_strips_have_as_many_elements_as_the_square():
    rows, columns = strips.SQUARE
    for strip in strips.STRIPS:
        assert strip[0] * strip[1] == pytest.approx(rows * columns, rel=0.01)
