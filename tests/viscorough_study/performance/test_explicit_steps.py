"""Explicit steps of the viscous problem against its exact solution, event by event."""

import numpy as np
import pytest

from viscorough import AccuracyWarning, Indenter, self_affine_disc
from viscorough.viscous.integration.events import newtonian_events
from viscorough_study.performance.explicit_steps import explicit_steps

DISC = Indenter(self_affine_disc(0.6, 33, seed=3).heights, (1.0, 2.0))
EVENTS = newtonian_events(DISC)


@pytest.mark.filterwarnings("ignore:explicit steps")
def test_errors_of_the_depth_are_of_first_order_in_the_steps():
    """The contact set of a step is too small, so every depth is too large."""
    impulses, errors = np.geomspace(EVENTS.impulse[100], EVENTS.impulse[700], 30), []
    for number in (50, 800):
        ends = np.union1d(np.geomspace(impulses[0] / 100, impulses[-1], number), impulses)
        depth = explicit_steps(DISC, ends).depth[np.searchsorted(ends, impulses)]
        errors.append(np.mean(depth / EVENTS.depth_at(impulses) - 1))
    assert 0 < errors[1] < 1e-3
    assert np.log(errors[0] / errors[1]) / np.log(16) == pytest.approx(1, abs=0.3)


def test_long_steps_overlap_the_surface_deeply():
    """The scheme fails as known, warns, and reports the overlap."""
    with pytest.warns(AccuracyWarning, match=r"overlaps the surface by up to \d"):
        steps = explicit_steps(DISC, np.linspace(0, EVENTS.impulse[700], 11)[1:])
    assert steps.overlap[0] > 0.5
    assert steps.depth[0] > 2 * EVENTS.depth_at(steps.impulse[0])


@pytest.mark.filterwarnings("ignore:explicit steps")
def test_ends_that_differ_by_rounding_have_a_row_each():
    ends = np.linspace(0, EVENTS.impulse[700], 31)[1:]
    twice = np.union1d(ends, np.nextafter(ends, np.inf))
    assert explicit_steps(DISC, twice).depth.shape == twice.shape
