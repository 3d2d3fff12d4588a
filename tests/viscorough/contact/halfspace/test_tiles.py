"""The operator on tiles of a grid, against that on the whole grid."""

import numpy as np
import pytest

from viscorough.contact.halfspace.operator import Halfspace
from viscorough.contact.halfspace.tiles import ACCURACY, SIDE, TiledHalfspace, tiles_beyond, tiles_with
from viscorough.contact.options import SolverOptions


def whole(load, aspect):
    halfspace = Halfspace(*load.shape, aspect=aspect)
    halfspace.load[:, : load.shape[1]] = load
    return halfspace.apply()[:, : load.shape[1]].copy()


def everywhere(shape):
    return tiles_beyond((0, 0, 0, 0), shape)


@pytest.mark.parametrize("precision", [np.float64, np.float32])
@pytest.mark.parametrize(("shape", "aspect"), [((401, 402), 1.0), ((613, 230), 1.9), ((90, 1500), 0.55), ((5, 7), 1.0)])
def test_deflections_are_those_of_the_whole_grid(shape, aspect, precision):
    """Loads in a corner, in a dense patch, and of both signs; every place between the points of the coarse grid."""
    generator, load = np.random.default_rng(1), np.zeros(shape)
    load[:3, :2] = 1.0
    load[shape[0] // 2 : shape[0] // 2 + 30, 50:90] = generator.random(load[shape[0] // 2 :, 50:90][:30].shape)
    load[tuple(generator.integers(0, n, 40) for n in shape)] = 5.0
    load[:, shape[1] // 2 :] += generator.standard_normal(load[:, shape[1] // 2 :].shape)
    exact, rounding = whole(load, aspect), SolverOptions().operator_rounding * np.finfo(precision).eps
    for threads in (1, 3):
        tiled = TiledHalfspace(*shape, everywhere(shape), precision, aspect=aspect, threads=threads)
        tiled.load[:] = load
        for _ in range(2):  # nothing is left of the first application
            deflection = tiled.apply()
        assert np.abs(deflection - exact).max() < (ACCURACY + rounding) * exact.max()
        assert tiled.count == 2


@pytest.mark.parametrize("wavelength", [2, 5, 9, 30, 200, np.inf])
def test_the_error_is_within_the_bound_for_loads_of_any_wavelength(wavelength):
    """Also where loads of both signs cancel, as those of search directions do."""
    row, column = np.indices((380, 500))
    load = np.cos(2 * np.pi * row / wavelength) * np.cos(2 * np.pi * column / wavelength)
    exact, tiled = whole(load, 1.0), TiledHalfspace(*load.shape, everywhere(load.shape))
    tiled.load[:] = load
    assert np.abs(tiled.apply() - exact).max() < ACCURACY * abs(exact).max()


def test_tiles_without_loads_or_interest_are_left_alone():
    """Loads in distant tiles of a large grid; deflections in these, and then in some others."""
    shape, load = (900, 1300), np.zeros((900, 1300))
    load[130:150, 245:470], load[899, 1299], load[350:355, 1:9] = 1.0, 7.0, 2.0
    occupied = tiles_with(*np.nonzero(load), shape)
    exact, tiled = whole(load, 1.0), TiledHalfspace(*shape, occupied)
    tiled.load[:] = load
    inside = np.kron(occupied, np.ones((SIDE, SIDE), bool))[: shape[0], : shape[1]]
    deflection = tiled.apply()
    assert not deflection[~inside].any()
    np.testing.assert_allclose(deflection[inside], exact[inside], rtol=0, atol=ACCURACY * exact.max())
    field, others = np.full(shape, -2.0), ~occupied
    tiled.add_to(field, others)
    assert (field[inside] == -2).all()
    np.testing.assert_allclose(field[~inside] + 2, exact[~inside], rtol=0, atol=ACCURACY * exact.max())


@pytest.mark.parametrize(
    "box", [(0, 0, 0, 0), (100, 120, 250, 200), (0, 90, 401, 250), (150, 0, 251, 402), (0, 0, 401, 402), (50, 60, 9, 9)]
)
def test_tiles_beyond_a_box_hold_all_that_is_outside(box):
    shape, inside = (401, 402), np.zeros((401, 402), bool)
    inside[box[0] : box[0] + box[2], box[1] : box[1] + box[3]] = True
    np.testing.assert_array_equal(tiles_beyond(box, shape), tiles_with(*np.nonzero(~inside), shape))
