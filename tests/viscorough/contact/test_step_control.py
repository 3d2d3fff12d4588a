"""Placement of levels: bounds on the error between them, and where an interval is divided."""

import numpy as np
import pytest

from viscorough import Indenter, indent, self_affine_disc
from viscorough.contact.prescribed_depth import ContactSolver
from viscorough.contact.step_control import Level, StepControl, division, interpolate, interpolation_bound
from viscorough.viscous.integration.events import newtonian_events


def springs(gaps, depth):
    """Return the level of independent springs of stiffness 1 with these gaps."""
    overlap = np.maximum(depth - gaps, 0)
    return Level(depth, overlap.sum(), np.count_nonzero(overlap), np.count_nonzero(overlap))


@pytest.mark.parametrize(("least", "width"), [(0.0, 1.0), (0.31, 0.01), (0.5, 0.01), (0.5, 0.2), (0.78, 0.01)])
def test_error_bound_holds_for_elements_that_join_anywhere(least, width):
    gaps = np.append(0, least + width * np.random.default_rng(0).random(200))
    before, after = (springs(gaps, depth) for depth in (0.3, 0.8))
    depth = np.linspace(0.3, 0.8, 100)[1:-1]
    force = np.maximum(depth[:, None] - gaps, 0).sum(axis=1)
    error = np.abs(interpolate(before, after, force) / depth - 1).max()
    assert error <= interpolation_bound(before, after)


def test_single_joining_element_leaves_no_error():
    gaps = np.array([0.0, 0.5])
    assert interpolation_bound(springs(gaps, 0.3), springs(gaps, 0.8)) == 0.0
    assert interpolation_bound(springs(np.append(gaps, 0.4), 0.3), springs(np.append(gaps, 0.4), 0.8)) > 0.01


def test_interval_is_divided_at_a_jump_of_the_stiffness():
    gaps = np.append(0, np.full(50, 0.45))
    assert division(springs(gaps, 0.3), springs(gaps, 0.8)) == pytest.approx(0.45, rel=1e-12)
    close_to_the_end = np.append(0, np.full(50, 0.79999))
    assert division(springs(close_to_the_end, 0.3), springs(close_to_the_end, 0.8)) < 0.8 - 0.07


def boss_on_a_plate(across=24, radius=7):
    """Return a boss of height 1 on a plate whose heights vary by 1e-3: the stiffness jumps when the plate touches."""
    position = np.arange(across) - (across - 1) / 2
    boss = np.add.outer(position**2, position**2) <= radius**2
    return Indenter(boss + 1e-3 * np.random.default_rng(0).random(boss.shape), 1.0)


@pytest.mark.parametrize("tolerance", [1e-2, 1e-4])
@pytest.mark.parametrize("start_fraction", [0.0, 0.2])
def test_a_kink_is_resolved(tolerance, start_fraction):
    boss = boss_on_a_plate()
    events, curve = newtonian_events(boss), indent(boss, tolerance=tolerance, start_fraction=start_fraction)
    first = max(curve.force[curve.contact_fraction < start_fraction], default=0.0)
    impulse = events.impulse[(events.impulse > first) & (events.impulse <= curve.force[-1])]
    impulse = np.union1d(impulse, (impulse[1:] + impulse[:-1]) / 2)
    assert impulse.size > 500
    depth, _ = curve.at_force(impulse)
    assert np.abs(depth / events.depth_at(impulse) - 1).max() <= tolerance


@pytest.mark.parametrize(
    ("indenter", "depths", "tolerance", "relaxed"),
    [
        (self_affine_disc(0.5, 129, seed=1), (0.6, 0.7), 1e-3, True),
        (boss_on_a_plate(56, 16), (1.3, 1.5), 3e-3, False),
    ],
    ids=["rough disc", "a plate begins to touch"],
)
def test_bound_is_relaxed_only_for_a_small_predicted_error(indenter, depths, tolerance, relaxed):
    solver, control = ContactSolver(indenter, 1e-6), StepControl(tolerance)
    contact = solver.advance_reduced(solver.unloaded_state(), depths[0] / 2)
    before = solver.advance_reduced(contact, depths[0])
    after = solver.advance_reduced(before, depths[1])
    bound = interpolation_bound(Level.of(before), Level.of(after)) / tolerance
    assert 0.5 < bound < 3
    assert control.excess(before, after) == pytest.approx(bound / 3.3 if relaxed else bound)
