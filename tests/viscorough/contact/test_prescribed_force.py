"""Levels at given forces, against more accurate levels at the depths that they found."""

import numpy as np
import pytest

from viscorough import ConvergenceError, Indenter, SolverOptions, contact_at, indent
from viscorough.contact import prescribed_force
from viscorough.contact.prescribed_depth import ContactSolver
from viscorough.contact.prescribed_force import ForceSearch
from viscorough.surfaces.self_affine import self_affine_disc, self_affine_square

# From one element in contact to nearly all.
FORCES = np.array([1e-8, 1e-3, 0.1, 0.5, 2.0, 3.0, 10.0, 100.0])
GRID = SolverOptions(dense_contacts=0, dense_interactions=0)


@pytest.mark.parametrize(("hurst", "tolerance"), [(0.2, 1e-2), (0.8, 1e-3), (0.8, 1e-6), (0.2, 1e-10)])
def test_curve_has_a_level_at_each_force(hurst, tolerance):
    disc = self_affine_disc(hurst, 65, seed=2)
    curve = indent(disc, forces=FORCES, tolerance=tolerance)
    np.testing.assert_array_equal(curve.force, FORCES)
    exact = indent(disc, depths=curve.depth, tolerance=max(1e-3 * tolerance, 1e-12))
    assert np.abs(exact.force / FORCES - 1).max() < 0.01 * tolerance
    # A few elements that just touch are in only one of the two contacts, as in levels at given depths.
    assert np.abs(curve.stiffness / exact.stiffness - 1).max() < 2 * tolerance
    assert np.abs(curve.contact_count / exact.contact_count - 1).max() < max(20 * tolerance, 0.01)
    assert curve.residual.max() <= tolerance
    assert curve.tolerance == tolerance


@pytest.mark.parametrize("tolerance", [1e-3, 1e-6])
def test_lower_terrace_outside_the_box_joins_the_contact(tolerance):
    """The lower terrace lies outside the box of the grid that holds the contact of the upper terrace."""
    row, column = np.mgrid[:65, :65] - 32
    steps = Indenter(np.where(column > 0, 1e-3, 0.0) - 1e-9 * (row**2 + column**2), 1.0)
    forces = [1e-3, 0.2, 3.0, 6.0]
    curve = indent(steps, forces=forces, tolerance=tolerance)
    exact = indent(steps, depths=curve.depth, tolerance=1e-3 * tolerance)
    assert np.abs(exact.force / forces - 1).max() < tolerance
    contacts = contact_at(steps, force=forces, tolerance=tolerance)
    for contact in contacts:
        assert np.nanmin(contact.gap) >= -tolerance * contact.depth
    np.testing.assert_allclose([contact.depth for contact in contacts], curve.depth, rtol=tolerance)


@pytest.mark.parametrize(("share", "is_near"), [(0.9, True), (-0.9, True), (1.1, False), (-1.1, False)])
def test_last_correction_changes_the_stiffness_within_the_tolerance(share, is_near):
    """The stiffness at a force comes from the last solved contact, although a correction of the depth changes it."""
    solver = ContactSolver(self_affine_disc(0.8, 33, seed=2), tolerance=0.01, options=GRID)
    before = solver.advance(solver.unloaded_state(), 0.5 * solver.units.length)
    contact = solver.advance(before, 0.6 * solver.units.length)
    change = (contact.tangent_sum - before.tangent_sum) / (contact.reduced_depth - before.reduced_depth)
    correction = share * 0.01 * contact.tangent_sum / change
    target = contact.pressure_sum + correction * contact.tangent_sum
    assert ForceSearch(solver)._is_near(contact, before, target) == is_near


@pytest.mark.parametrize(("hurst", "large"), [(0.2, 1 << 15), (0.8, 1 << 15), (0.8, 1 << 10)])
def test_coarse_map_bounds_the_depth_of_the_contact(hurst, large):
    """The contacts range from few elements to complete contact. Blocks at the edges have fewer elements."""
    options = SolverOptions(blocks_from=large)
    rough = Indenter(self_affine_square(hurst, 403, seed=5)[:, :390], 1.0, 1.3)
    for force in (200.0, 2e3, 2e4):
        contact = contact_at(rough, force=force, options=options)
        least = contact_at(prescribed_force._highest_in_blocks(rough), force=force, options=options).depth
        solver = ContactSolver(rough, 1e-3, options)
        guess = ForceSearch(solver)._estimate(force / solver.units.force)
        largest = guess.target.largest_depth * solver.units.length
        assert 0.7 * contact.depth < least < contact.depth < largest < 1.4 * contact.depth
        loads = guess.loads
        guessed = loads.pressure * solver.units.pressure
        assert guessed.sum() * rough.spacing * rough.row_spacing == pytest.approx(force)
        exact = contact.pressure[solver.elements.places_on_map(loads.members)]
        assert np.abs(guessed - exact).sum() < 0.6 * contact.pressure.sum()


def test_blocks_have_the_height_of_their_highest_element():
    heights = np.random.default_rng(1).normal(size=(9, 14)).astype("f4")
    heights[:4, 4:9] = heights[8, :3] = np.nan  # one block has no element
    whole = np.pad(heights, ((0, 3), (0, 2)), constant_values=np.nan).reshape(3, 4, 4, 4)
    expected = np.fmax.reduce(whole, axis=(1, 3))
    np.testing.assert_array_equal(prescribed_force._highest_in_blocks(Indenter(heights, 1.0)).heights, expected)


def test_force_that_the_first_guess_meets_exactly_is_accepted():
    """The second element does not touch: the residual is zero from the start, and no step is needed."""
    two = Indenter(np.array([[0.0], [-1.39]]), (1.0, 0.372))
    options = SolverOptions(dense_interactions=0)
    curve = indent(two, forces=[0.5, 4.0, 30.0], tolerance=1e-4, options=options)
    exact = indent(two, depths=curve.depth, tolerance=1e-12)
    np.testing.assert_allclose(exact.force, curve.force, rtol=1e-6)


def test_error_names_the_force_that_is_not_met():
    with pytest.raises(ConvergenceError, match=r"contact at F/G = 5: the force is not met within 1 depths"):
        contact_at(
            self_affine_disc(0.8, 65, seed=3), force=5.0, options=SolverOptions(dense_contacts=10**4, max_depths=1)
        )
