"""The grid solver: its solution, tangent, rounding bounds and box, against dense matrices."""

import numpy as np
import pytest

from support.influence import influence_matrix
from viscorough import Indenter, self_affine_disc
from viscorough.contact.grid.solver import GridSolver
from viscorough.contact.options import DEFAULT, SolverOptions
from viscorough.contact.prescribed_depth import ContactSolver
from viscorough.contact.ranking import all_elements

DOUBLE = SolverOptions(precision="double", exact_gap_below=0.0)


def whole_grid(indenter, tolerance, options=DEFAULT):
    elements = all_elements(indenter)
    box = 0, 0, *elements.shape
    return elements, GridSolver(box, elements, tolerance, options)


def contact_on(grid, indenter, depth):
    """Solve the contact at a reduced depth, starting without load."""
    start = ContactSolver(indenter, 1e-6).unloaded_state()
    return grid.solve(grid.transferred(start), depth)


@pytest.mark.parametrize("tolerance", [1e-2, 1e-6])
@pytest.mark.parametrize("hurst", [0.1, 0.9])
def test_energy_error_of_the_tangent_is_within_the_limit(hurst, tolerance):
    """The energy norm of q − q* over q* is at most √tolerance and 0.01; its square is the relative error of k."""
    disc = self_affine_disc(hurst, 33, seed=5)
    elements, grid = whole_grid(disc, tolerance)
    allowed = min(1e-2, tolerance**0.5)
    for share in (0.02, 0.1, 0.4, 0.9):
        ranks = np.arange(round(share * elements.count))
        inside, tangent = np.zeros(grid.initial_gap.size, dtype=bool), np.zeros(grid.initial_gap.size)
        inside[grid.place[ranks]] = True
        total = grid.solve_flat_punch(inside, tangent, np.full_like(tangent, -1.0))
        matrix = influence_matrix(elements.row[ranks], elements.column[ranks])
        exact = np.linalg.solve(matrix, np.ones(ranks.size))
        error = tangent[grid.place[ranks]] - exact
        assert np.sqrt(error @ matrix @ error / exact.sum()) <= allowed
        assert total == pytest.approx(exact.sum(), rel=allowed**2)


# In single precision without recomputation the error of the gap grows, and its bound grows with it. If initial gaps
# differ by orders of magnitude, small changes of large gaps must not be lost in single precision.
ROUNDED = {
    "never recomputed": (
        self_affine_disc(0.6, 25, seed=2),
        np.linspace(0.2, 0.7, 6),
        SolverOptions(exact_gap_below=0.0, max_iterations=500),
    ),
    "elements far below the others": (
        Indenter(-(10.0 ** np.random.default_rng(1).uniform(-6, 0, (14, 14))), 1.0),
        np.append(1e-5, np.geomspace(3e-5, 3, 11)),
        DEFAULT,
    ),
}


@pytest.mark.parametrize("name", ROUNDED)
def test_rounding_bounds_hold_from_level_to_level(name):
    indenter, depths, options = ROUNDED[name]
    elements, grid = whole_grid(indenter, 1e-3, options)
    matrix = influence_matrix(elements.row, elements.column)
    contact, bounds = contact_on(grid, indenter, depths[0]), []
    for depth in depths[1:]:
        contact = grid.solve(contact, depth)
        fields, loads = contact.fields, contact.member_loads()
        pressure, tangent = np.zeros((2, elements.count))
        pressure[loads.members], tangent[loads.members] = loads.pressure, loads.tangent
        for stored, exact in (
            (fields.gap_change, matrix @ pressure - depth),
            (fields.tangent_gap, matrix @ tangent - 1),
        ):
            assert np.abs(stored.values[fields.place] - exact).max() <= stored.rounding
        bounds.append(fields.gap_change.rounding)
    gap = contact.fields.gap_change.values[contact.fields.place] + elements.initial_gap
    np.testing.assert_allclose(contact.fields.gap(contact.fields.place), gap, atol=1e-6 * depth)
    assert contact.count > 0.2 * elements.count
    assert 0 < bounds[0] < bounds[-1] < 1e-3 * depths[-1]


def test_double_precision_does_not_change_the_solution():
    disc = self_affine_disc(0.5, 33, seed=1)
    grids = [whole_grid(disc, 1e-6, options)[1] for options in (DEFAULT, DOUBLE)]
    levels = [grid.solve(contact_on(grid, disc, 0.5), 0.6) for grid in grids]
    assert levels[0].pressure_sum == pytest.approx(levels[1].pressure_sum, rel=1e-7)
    assert levels[0].tangent_sum == pytest.approx(levels[1].tangent_sum, rel=1e-4)
