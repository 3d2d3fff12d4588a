"""The contact solver: units, contact events, and its checks of solutions."""

from dataclasses import replace

import numpy as np
import pytest

from viscorough import ConvergenceError, Indenter, SolverOptions, self_affine_disc
from viscorough.contact.prescribed_depth import ContactSolver
from viscorough.contact.state import MemberLoads

ROUTES = {"dense": SolverOptions(dense_contacts=10**9, dense_interactions=10**9),
          "grid": SolverOptions(dense_contacts=0, dense_interactions=0)}  # fmt: skip


def test_element_that_loses_contact_on_the_grid_is_an_error():
    """Contact only grows with depth. A step to a smaller depth imitates a wrong solution with a smaller contact."""
    disc = self_affine_disc(0.6, 33, seed=1)
    solver = ContactSolver(disc, 1e-4, ROUTES["grid"])
    deeper = solver.advance_reduced(solver.unloaded_state(), 0.8)
    with pytest.raises(ConvergenceError, match=r"elements lost contact by up to .* although contact can only grow"):
        solver.advance_reduced(deeper, 0.5)


def test_element_that_loses_contact_in_a_dense_solution_is_an_error():
    """The test adds an element outside the contact to its members."""
    solver = ContactSolver(self_affine_disc(0.6, 33, seed=1), 1e-4, ROUTES["dense"])
    contact = solver.advance_reduced(solver.unloaded_state(), 0.5)
    candidates = np.searchsorted(solver.elements.initial_gap, 0.51)
    outside = np.setdiff1d(np.arange(candidates), contact.members)[-1:]
    loads, members = contact.member_loads(), np.append(contact.members, outside)
    loads = MemberLoads(members, np.append(loads.pressure, 0.0), np.append(loads.tangent, -1.0))
    wrong = replace(contact, count=members.size, loads=loads)
    with pytest.raises(ConvergenceError, match="1 elements lost contact"):
        solver.advance_reduced(wrong, 0.51)
    assert solver.advance_reduced(contact, 0.51).count >= contact.count


def test_events_end_at_the_force_and_ties_are_one_event():
    disc = self_affine_disc(0.7, 17, seed=2)
    solver = ContactSolver(disc, 1e-10)
    start = solver.advance_reduced(solver.unloaded_state(), solver.elements.initial_gap[1])
    whole, _, ends_at_force = solver.follow_events(start, 40, np.inf)
    assert not ends_at_force
    until = 0.5 * (whole.pressure_sum[9] + whole.pressure_sum[10])
    part, _, ends_at_force = solver.follow_events(start, 40, until)
    assert ends_at_force
    np.testing.assert_array_equal(part.depth, whole.depth[: part.depth.size])
    assert part.pressure_sum[-1] <= until
    corners = Indenter(np.array([[1.0, 0.5, 1.0], [0.5, 0.0, 0.5], [1.0, 0.5, 1.0]]), 1.0)
    solver = ContactSolver(corners, 1e-10)
    four = solver.advance_reduced(solver.unloaded_state(), 1e-6)
    events, last, _ = solver.follow_events(four, 9, np.inf)
    assert events.count.tolist() == [8, 9]  # the four sides touch at once
    assert last.count == 9


def test_invalid_options_are_refused():
    for wrong, message in (
        ({"precision": "half"}, "precision: must be one of single, double, not 'half'"),
        ({"operator_rounding": -1.0}, "operator_rounding: must not be negative"),
        ({"operator_rounding": np.nan}, "operator_rounding: nan; one finite number is needed"),
        ({"max_iterations": 0}, "max_iterations: must be a whole number of at least 1"),
    ):
        with pytest.raises(ValueError, match=message):
            SolverOptions(**wrong)
