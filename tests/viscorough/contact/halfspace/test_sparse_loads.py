"""The deflection by few loads, against the whole convolution."""

import numpy as np
import pytest

from viscorough.contact.halfspace.operator import Halfspace
from viscorough.contact.halfspace.sparse_loads import ACCURACY, add_deflection, is_suitable


@pytest.mark.parametrize(("shape", "aspect"), [((401, 402), 1.0), ((613, 230), 1.9), ((90, 1500), 0.55), ((5, 7), 1.0)])
def test_deflections_are_those_of_the_convolution(shape, aspect):
    """Loads in a corner, in a dense patch, and scattered; every place between the points of the coarse grid."""
    generator, load = np.random.default_rng(1), np.zeros(shape)
    load[:3, :2] = 1.0
    load[shape[0] // 2 : shape[0] // 2 + 30, 50:90] = generator.random(load[shape[0] // 2 :, 50:90][:30].shape)
    load[tuple(generator.integers(0, n, 40) for n in shape)] = 5.0
    halfspace = Halfspace(*shape, aspect=aspect)
    halfspace.load[:, : shape[1]] = load
    exact = halfspace.apply()[:, : shape[1]]
    row, column = np.nonzero(load)
    for threads in (1, 3):
        field = np.full(shape, -2.0)
        add_deflection(field, row, column, load[row, column], aspect=aspect, threads=threads)
        assert np.abs(field + 2.0 - exact).max() < 0.5 * ACCURACY * exact.max()


@pytest.mark.parametrize("box", [(100, 120, 250, 200), (0, 90, 401, 250), (150, 0, 251, 402)])
def test_outside_a_box_deflections_are_the_same(box):
    """Boxes within the map, across it, and to its edge: loads far inside need no near field beyond them."""
    generator, shape = np.random.default_rng(2), (401, 402)
    row, column = (first + generator.integers(0, size, 3000) for first, size in zip(box[:2], box[2:], strict=True))
    load, outside = generator.random(3000), np.ones(shape, bool)
    outside[box[0] : box[0] + box[2], box[1] : box[1] + box[3]] = False
    field, everywhere = np.zeros((2, *shape))
    add_deflection(everywhere, row, column, load)
    add_deflection(field, row, column, load, outside=box)
    np.testing.assert_allclose(field[outside], everywhere[outside], rtol=1e-12)
    assert not np.allclose(field, everywhere)


def test_it_is_for_few_loads_on_large_maps():
    assert is_suitable((1000, 1000), 10_000, 1.0)
    assert not is_suitable((1000, 1000), 100_000, 1.0)
    assert not is_suitable((100, 100), 10, 1.0)
    assert not is_suitable((1000, 1000), 10_000, 0.2)
