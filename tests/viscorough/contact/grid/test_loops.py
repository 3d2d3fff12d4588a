"""Loops over fields and contact sets of more than one block, against numpy."""

from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest

from viscorough.contact.grid import kernels
from viscorough.contact.grid.loops import GridLoops
from viscorough.contact.parallel import BLOCK
from viscorough.contact.preconditioner.multilevel import REACH, load_redistribution_stencil

ROWS, COLUMNS, STRIDE = 400, 700, 716
WIDTH = COLUMNS + 2 * REACH
SIZE = (ROWS + 2 * REACH) * WIDTH
INNER = np.s_[REACH:-REACH, REACH:-REACH]


# A set of more places than those of a block, its flat field, and its slots in a load array of ROWS x STRIDE.
INSIDE = np.pad(np.random.default_rng(1).random((ROWS, COLUMNS)) < 0.7, REACH).ravel()
PLACES = np.flatnonzero(INSIDE).astype(np.uint32)
SLOTS = ((PLACES // WIDTH - REACH) * STRIDE + PLACES % WIDTH - REACH).astype(np.uint32)
assert PLACES.size > BLOCK + 1000
LOOPS = GridLoops(3)


@pytest.fixture
def random():
    return np.random.default_rng(2)


@pytest.fixture
def field(random):
    """Function that returns a new flat field of normal numbers."""
    return lambda size=SIZE: random.standard_normal(size)


@pytest.mark.parametrize("share", [0.02, 0.6])
@pytest.mark.parametrize("columns", [1, 60])
def test_places_of_a_set_wherever_rows_and_blocks_end(columns, share, random):
    """Flags are read eight at a time, and neither rows nor blocks end at multiples of eight."""
    width, stride = columns + 2 * REACH, columns + 3
    inside = np.pad(random.random((41, columns)) < share, REACH).ravel()
    expected = np.flatnonzero(inside)
    places, slots = np.zeros((2, expected.size), dtype=np.uint32)
    for start, stop in pairwise([0, 3, 50, 51, 133, inside.size]):
        kernels.contact_places(inside, start, stop, width, stride, np.count_nonzero(inside[:stop]), places, slots)
    np.testing.assert_array_equal(places, expected)
    np.testing.assert_array_equal(slots, (expected // width - REACH) * stride + expected % width - REACH)


def test_indices_beyond_32_bits_are_64_bits_wide():
    inside = np.zeros(20 * 5, dtype=bool)
    inside[[42, 77]] = True
    places, slots = LOOPS.contact_places(inside, 5, 2**32 // 20 + 1)
    np.testing.assert_array_equal(places, [42, 77])
    np.testing.assert_array_equal(slots, [6 * (2**32 // 20 + 1), 13 * (2**32 // 20 + 1)])


def test_sums_over_a_set(field):
    pressure, gap, preconditioned = field(), field(), field()
    direction, deflection = field(ROWS * STRIDE), field(ROWS * STRIDE)
    assert LOOPS.total(pressure, PLACES) == pytest.approx(pressure[PLACES].sum(), rel=1e-9)
    d, by_d = direction[SLOTS], deflection[SLOTS]
    assert LOOPS.inner_product(direction, deflection, SLOTS) == pytest.approx(d @ by_d, rel=1e-9)
    sums = sum(LOOPS.each(kernels.direction_sums, (direction, deflection, preconditioned, gap), PLACES, SLOTS))
    np.testing.assert_allclose(sums, [preconditioned[PLACES] @ by_d, d @ gap[PLACES], d @ by_d], rtol=1e-9)


def test_sums_over_elements_that_join(field):
    change, initial_gap, tangent_gap = field(), field(), field()
    pressure, tangent, share = abs(field(PLACES.size)), abs(field(PLACES.size)), np.array([0.2, 0.7])
    slope, gap = np.minimum(tangent_gap, -1e-30)[PLACES], np.maximum(change + initial_gap, 0)[PLACES]
    touch = np.clip(np.maximum(-gap / slope / 0.4, 1 - pressure / tangent / 0.4), 0, 1)
    assert np.mean((touch > 0) & (touch < 1)) > 0.05
    expected = [slope @ slope, slope**2 @ (1 - touch), *(slope**2 @ np.maximum(s - touch, 0) for s in share)]
    fixed = change, initial_gap, tangent_gap, 0.4, share
    sums = sum(LOOPS.each(kernels.touch_sums, fixed, PLACES, pressure, tangent))
    np.testing.assert_allclose(sums, expected, rtol=1e-9)


@pytest.mark.parametrize("which", [0, -1])
def test_extremes_are_found_in_every_block(field, which):
    change, initial_gap, gap = field(), field(), np.zeros(SIZE)
    change[PLACES[which]] = -100.0
    assert LOOPS.largest_gap(change, initial_gap, gap, PLACES) == abs(-100.0 + initial_gap[PLACES[which]])
    np.testing.assert_array_equal(gap[PLACES], (change + initial_gap)[PLACES])
    assert max(LOOPS.each(kernels.gather_on_set, (change, gap), PLACES)) == 100.0
    np.testing.assert_array_equal(gap[PLACES], change[PLACES])
    assert max(LOOPS.each(kernels.largest_overlap, (), change, initial_gap)) == 100.0 - initial_gap[PLACES[which]]

    pressure, direction = abs(field()), np.zeros(ROWS * STRIDE)
    assert LOOPS.lowest(pressure) >= 0
    for lowest in (0.0, -100.0):
        direction[SLOTS[which]] = lowest
        for kernel in (kernels.step_causes_tension, kernels.update_pressure):
            assert any(LOOPS.each(kernel, (0.5, direction, pressure), PLACES, SLOTS)) == (lowest < 0)
    assert LOOPS.lowest(pressure) == pressure[PLACES[which]] < 0


@pytest.mark.parametrize("which", [0, -1])
def test_elements_that_left_are_found_in_every_block(which):
    after = INSIDE.copy()
    assert LOOPS.difference(INSIDE, after).size == 0
    after[PLACES[which]] = False
    assert LOOPS.difference(INSIDE, after) == PLACES[which]
    assert LOOPS.difference(after, INSIDE).size == 0


def test_a_field_is_filled_another_one_shifted_into_it_and_deflections_added(field):
    grid, shifted = field(ROWS * STRIDE).reshape(ROWS, STRIDE)[:, :COLUMNS], field()
    LOOPS.fill(shifted, 3.0)
    LOOPS.shifted(grid, 0.3, shifted.reshape(-1, WIDTH)[INNER])
    np.testing.assert_array_equal(shifted, np.pad(grid - 0.3, REACH, constant_values=3.0).ravel())
    LOOPS.update_gap(0.7, grid, shifted)
    np.testing.assert_allclose(shifted, np.pad(1.7 * grid - 0.3, REACH, constant_values=3.0).ravel(), atol=1e-14)


@pytest.fixture
def elements(random):
    """Rows and columns of all places of the grid, in any order, and their initial gaps."""
    row, column = np.divmod(random.permutation(ROWS * COLUMNS).astype(np.int32), COLUMNS)
    return row, column, random.random(row.size)


def grid_of(box, elements):
    """Indices of the elements on the grid of a box, and the flat field of their initial gaps."""
    field = np.full((box[2] + 2 * REACH) * (box[3] + 2 * REACH), 9.0)
    return LOOPS.place_elements(box, *elements, field), field


def test_elements_are_placed_in_a_box(elements):
    row, column, initial_gap = elements
    box = top, left, rows, columns = 30, 50, 350, 500
    place, field = grid_of(box, elements)
    gap_map = np.empty((ROWS, COLUMNS))
    gap_map[row, column] = initial_gap
    in_box = gap_map[top : top + rows, left : left + columns]
    np.testing.assert_array_equal(field, np.pad(in_box, REACH, constant_values=9.0).ravel())
    placed = place > 0
    np.testing.assert_array_equal(np.sort(initial_gap[placed]), np.sort(in_box, axis=None))
    np.testing.assert_array_equal(field[place[placed]], initial_gap[placed])


def test_a_contact_is_transferred_to_a_larger_grid(elements, random):
    small, large = (grid_of(box, elements)[0] for box in ((30, 50, 350, 500), (0, 0, ROWS, COLUMNS)))
    sizes = small.max() + 1, large.max() + 1
    source, target = ([np.zeros(size, bool), np.zeros(size), np.zeros(size)] for size in sizes)
    members = np.flatnonzero((small > 0) & (random.random(small.size) < 0.5))
    source[0][small[members]] = True
    for values in source[1:]:
        values[small[members]] = random.random(members.size)
    before = SimpleNamespace(place=small, inside=source[0], pressure=source[1], tangent=source[2])
    LOOPS.transfer(before, large, *target)
    for stored, values in zip(target, source, strict=True):
        np.testing.assert_array_equal(stored[large[members]], values[small[members]])
        assert np.count_nonzero(stored) == members.size

    after = SimpleNamespace(place=large, inside=target[0].copy())
    joined = np.sort(random.choice(np.setdiff1d(np.arange(large.size), members), 100, replace=False))
    after.inside[large[joined]] = True
    np.testing.assert_array_equal(LOOPS.new_members(after, before), joined)
    assert LOOPS.new_members(before, after).size == 0


def test_neighbours_of_an_element_that_leaves_share_its_load_also_across_bands(field):
    """Bands of rows are processed on several threads: elements around their edges must not be forgotten or doubled."""
    last_pressure, step = np.where(INSIDE, 2.0, 0.0), np.zeros(ROWS * STRIDE)
    step[SLOTS] = np.clip(field(SLOTS.size), -1, 1)
    step[SLOTS[::5]] = -4.2
    stepped = last_pressure.copy()
    stepped[PLACES] += 0.5 * step[SLOTS]
    stencil, leaving = load_redistribution_stencil(1.0), stepped < 0
    assert leaving[PLACES[:BLOCK]].any()
    assert leaving[PLACES[BLOCK:]].any()
    shares = np.where(leaving, stepped, 0.0).reshape(-1, WIDTH)
    change = sum(
        stencil[row + 1, column + 1] * np.roll(shares, (row, column), axis=(0, 1))
        for row in (-1, 0, 1)
        for column in (-1, 0, 1)
    ).ravel()
    results = []
    for threads in (1, 3):
        members, pressure, direction = INSIDE.copy(), last_pressure.copy(), step.copy()
        GridLoops(threads).step_and_release(
            0.5, direction, pressure, members, PLACES, SLOTS, stencil=stencil, width=WIDTH, stride=STRIDE
        )
        np.testing.assert_array_equal(members, INSIDE & ~leaving)
        np.testing.assert_allclose(pressure, np.where(members, stepped + change, 0.0), atol=1e-13)
        np.testing.assert_allclose(direction[SLOTS], (pressure - last_pressure)[PLACES], atol=1e-13)
        results.append(pressure)
    np.testing.assert_array_equal(*results)

    step[SLOTS[::5]] = -400.0  # neighbours lose half of their pressure at most
    members, pressure = INSIDE.copy(), last_pressure.copy()
    GridLoops(3).step_and_release(
        0.5, step, pressure, members, PLACES, SLOTS, stencil=stencil, width=WIDTH, stride=STRIDE
    )
    assert (pressure[members] > 0).all()
