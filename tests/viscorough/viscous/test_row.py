"""Rows of springs have the force of their loading curve: exactly at levels, within the tolerance in between."""

import dataclasses

import numpy as np
import pytest

from support.curves import curve_of_body, curve_of_levels, random_curve
from viscorough import AccuracyWarning, Load, Maxwell, indent, kinetics, reference, self_affine_disc
from viscorough.viscous.integration.events import newtonian_events
from viscorough.viscous.row import row_of_springs

DISC = self_affine_disc(0.7, 65, rms=0.01, seed=1)


def force_of_row(row, depth):
    """Return Σ dk (u − g)₊ at depths."""
    return (np.maximum(np.subtract.outer(depth, row.gap), 0.0) * row.stiffness).sum(axis=-1)


@pytest.mark.parametrize("tolerance", [1e-2, 1e-3, 1e-5])
def test_row_has_the_force_of_the_curve(tolerance):
    curve = indent(DISC, tolerance=tolerance, until_fraction=0.8)
    row = row_of_springs(curve)
    np.testing.assert_allclose(force_of_row(row, curve.depth), curve.force, rtol=1e-12)
    force = np.geomspace(curve.force[0], curve.force[-1], 1001)[1:-1]
    depth, stiffness = curve.at_force(force)
    # A force error ΔF corresponds to a relative depth error of ΔF/(k u).
    deviation = np.abs(force_of_row(row, depth) - force) / (stiffness * depth)
    assert deviation.max() < 0.1 * tolerance
    assert (row.stiffness > 0).all()
    assert (np.diff(row.gap) > 0).all()
    assert (np.diff(row.contact_fraction) >= 0).all()


def test_row_of_a_curve_of_all_contact_events_is_exact():
    """The reference is direct integration, at and between its events; some events are two springs within rounding."""
    disc = self_affine_disc(0.7, 9, rms=0.01, seed=1)
    events = newtonian_events(disc)
    row = row_of_springs(indent(disc, tolerance=1e-11, until_fraction=1.0))
    np.testing.assert_allclose(force_of_row(row, events.depth), events.impulse, rtol=1e-9, atol=1e-15)
    between = 0.5 * (events.depth[1:] + events.depth[:-1])
    last = np.searchsorted(row.gap, between) - 1
    np.testing.assert_allclose(np.cumsum(row.stiffness)[last], events.resistance[:-1], rtol=1e-7)
    np.testing.assert_allclose(row.contact_fraction[last] * disc.elements, events.contact_count[:-1], rtol=1e-12)
    assert row.limit == np.inf, "complete contact goes on as a flat punch"


@pytest.mark.parametrize("size", [5, 11])
def test_row_and_motion_go_on_with_the_last_stiffness_after_complete_contact(size):
    """The tangents of the last two levels may meet at the last level within rounding. In a viscous medium Φ = F t/η."""
    for seed in range(15):
        curve = indent(self_affine_disc(0.25 * (seed % 5), size, seed=seed), tolerance=1e-6, until_fraction=1.0)
        last_depth, last_force, last_stiffness = curve.depth[-1], curve.force[-1], curve.stiffness[-1]
        assert row_of_springs(curve).stiffness.sum() == pytest.approx(last_stiffness, rel=1e-12), seed
        creep = last_force * np.array([1.5, 10.0])
        motion = kinetics(curve, 3.0, 2.0, 2.0 / 3.0 * creep)
        np.testing.assert_allclose(motion.depth, last_depth + (creep - last_force) / last_stiffness, rtol=1e-12)
        np.testing.assert_allclose(motion.velocity, 1.5 / last_stiffness, rtol=1e-12)


def test_stiffness_is_made_monotone():
    """If rounding or the tolerance make levels slightly non-convex, these levels lie above the row."""
    curve = random_curve(levels=30)
    force = curve.force * (1 + 1e-3 * np.random.default_rng(1).standard_normal(30))
    row = row_of_springs(dataclasses.replace(curve, force=np.sort(force)))
    assert (row.stiffness > 0).all()
    assert (force_of_row(row, curve.depth) <= np.sort(force) * (1 + 1e-12)).all()


def test_row_follows_a_power_law_before_the_first_level():
    """The curve of a sphere is a power law, so a late first level changes little."""
    sphere = reference.sphere(1.7)
    row = row_of_springs(curve_of_body(sphere, np.geomspace(0.1, 1, 50)))
    assert row.first_depth == 0.1
    depth = np.linspace(0.02, 0.1, 9)
    np.testing.assert_allclose(force_of_row(row, depth), sphere.force(depth), rtol=5e-3)


@pytest.mark.parametrize("power", [20.0, 90.0, 1e4])
def test_row_follows_a_steep_power_law(power):
    """The curve begins deep, but few elements touch there. Springs that hardly carry a load would overflow."""
    curve = curve_of_levels([1.0, 1.0 + 0.1 / power], [1.0, 1.11], [power, 1.2 * power], [1, 2])
    row = row_of_springs(curve)
    assert row.gap[0] == 0
    assert row.stiffness.min() > 1e-15
    force = np.array([0.01, 0.1, 0.5, 0.9])
    np.testing.assert_allclose(force_of_row(row, force ** (1 / power)), force, rtol=0.01)
    # With J(t) = 1 + t, this ramp has the creep response 0.7 (1 + 1/2) at time 1, on the tangent of the first level.
    with pytest.warns(AccuracyWarning, match="before its first level"):
        motion = kinetics(curve, Load([0.0, 1.0, 2.0], force=[0.0, 0.7, 0.0]), Maxwell(1.0, 1.0), [1.0])
    assert motion.depth == pytest.approx(1 + 0.05 / power, rel=1e-9)
