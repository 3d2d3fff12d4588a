"""Solve a stress test by every method, and compare the results with the reference solution.

The reference solution gives the forces F/G at given depths. It is computed on the same elements with dense matrices,
and is exact within rounding. By the correspondence principle, these values of F/G are also the impulses ∫F dt/η at
which the indenter reaches the depths in a viscous half-space. Each method returns ratios of its depths to the depths of
the reference, at these impulses or at the samples of the load of the test.
"""

from dataclasses import dataclass, field
from functools import cached_property, partial
from itertools import accumulate, pairwise

import numpy as np

from viscorough import reference
from viscorough.contact.loading_path import indent
from viscorough.contact.options import SolverOptions
from viscorough.contact.prescribed_depth import ContactSolver
from viscorough.contact.step_control import FINEST_ACCURACY
from viscorough.mdr import reduce
from viscorough.media.creep_response import creep_response
from viscorough.media.kinds import Newtonian
from viscorough.media.load import Load
from viscorough.surfaces.indenter import Indenter
from viscorough.surfaces.lines import self_affine_line
from viscorough.viscous.integration.events import newtonian_events
from viscorough.viscous.integration.march import march
from viscorough.viscous.kinetics import kinetics
from viscorough_study.performance.explicit_steps import explicit_steps

DENSE_ONLY = SolverOptions(dense_contacts=10**9, dense_interactions=10**12)
DEPTHS = 6  # number of depths of a reference solution
REFERENCE_TOLERANCE = 1e-11
BISECTIONS = 12  # number of bisections in the search for the depth of a contact fraction
BEYOND_FULL_CONTACT = 3.0  # in a test past full contact, all depths are multiplied by this factor
LINE_POINTS = 2**14  # number of points of a line of the MDR
# Number of time steps between two samples of the force, for direct integration and for the reference motion.
STEPS, REFERENCE_STEPS = 64, 1024
# Largest errors with which a method holds: integration by time steps, and models. A model may deviate by a factor of 2
# from a single realization.
LIMIT_STEPS, LIMIT_MODEL = 0.02, 1.0


@dataclass(frozen=True)
class Solution:
    """Reference solution of a stress test; all arrays have the shape (depths,).

    indenter : indenter of the test
    depth : prescribed depths [length]; force : F/G [length²]; count : number of elements in contact
    motions : reference motions of tests with a load, {(medium, load): depths}, computed when they are needed
    """

    indenter: Indenter
    depth: np.ndarray
    force: np.ndarray
    count: np.ndarray
    motions: dict = field(default_factory=dict)

    @cached_property
    def events(self):
        """Integration from contact event to contact event, slightly past the last depth."""
        fraction = min(1.0, (1.1 * self.count[-1] + 2) / self.indenter.elements)
        return newtonian_events(self.indenter, until_fraction=fraction)


def reference_solution(test):
    """Compute the reference Solution of a stress test at `DEPTHS` depths.

    The depths are logarithmically uniform. The first and the last depth reach the two contact fractions of the test. If
    the last fraction is above 1, the depths extend beyond full contact.
    """
    solver = ContactSolver(test.indenter, REFERENCE_TOLERANCE, DENSE_ONLY)
    first = _depth_of_fraction(solver, test.fractions[0], 0.0)
    last = _depth_of_fraction(solver, min(test.fractions[1], 1.0), first)
    depths = np.geomspace(first, last, DEPTHS) if last > first else first * np.arange(1.0, DEPTHS + 1)
    depths *= BEYOND_FULL_CONTACT if test.fractions[1] > 1 else 1.0
    contacts = accumulate(depths, solver.advance_reduced, initial=solver.unloaded_state())
    _, *levels = ((contact.force, contact.count) for contact in contacts)
    return Solution(test.indenter, depths * solver.units.length, *np.array(levels).T)


def _depth_of_fraction(solver, fraction, low):
    """Return the reduced depth above `low` that reaches a contact fraction, found by doubling and bisection."""
    contact, gap = solver.unloaded_state(), solver.elements.initial_gap
    high = max(2 * low, gap[gap > 0][0] if gap[-1] > 0 else 1.0)
    while (deeper := solver.advance_reduced(contact, high)).count < fraction * solver.elements.count:
        contact, low, high = deeper, high, 2 * high
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        deeper = solver.advance_reduced(contact, middle)
        if deeper.count < fraction * solver.elements.count:
            contact, low = deeper, middle
        else:
            high = middle
    return high


# ---- loads. Without a load, the force is constant in a Newtonian medium, and the times of the comparison are the
# reference impulses.


def _history(test, solution):
    """Return the Load of a test. Raises ValueError for a force that pulls.

    The times are from 0 to 1. The forces are scaled so that the equivalent elastic force stays below the last force of
    the reference solution.
    """
    times, shape = np.array(test.load).T
    largest = solution.force[-1] / test.medium.creep_compliance(times[-1]) / shape.max()
    return Load(times, force=0.999 * largest * shape)


def _reference(test, solution):
    """Return the reference depths of a test.

    A contact that grows has the same events in every medium: the creep response replaces the impulse ∫F dt/η. If the
    contact recedes, the reference is direct integration in many time steps.
    """
    if test.medium is None:
        return solution.depth
    asked = test.medium, test.load
    if asked not in solution.motions:
        load = _history(test, solution)
        response = creep_response(test.medium.spectrum(load), load)
        grows = isinstance(test.medium, Newtonian) or (np.diff(load.values) >= 0).all()
        depths = solution.events.depth_at(response) if grows else _stepped(test, load, REFERENCE_STEPS)
        solution.motions[asked] = depths
    return solution.motions[asked]


def _ratios(depth, test, solution):
    reference = _reference(test, solution)
    return depth[reference > 0] / reference[reference > 0]


def _stepped(test, load, number):
    """Compute the depths at the samples of a load by direct integration, with `number` steps between samples.

    The steps are shortest after a sample, and grow until the next sample.
    """
    history = np.array([load.time, load.values])
    parts, place = [history[:, :1]], [0]
    for start, end in pairwise(history.T):
        share = np.ones(1) if start[0] == end[0] else np.linspace(0, 1, number + 1)[1:] ** 2
        parts.append(start[:, None] + (end - start)[:, None] * share)
        place.append(place[-1] + share.size)
    times, force = np.concatenate(parts, axis=1)
    return march(test.indenter, Load(times, force=force), test.medium).depth[place]


# ---- methods


def _by_correspondence(curve, test, solution):
    """Return the depths on a loading curve by the correspondence principle, and beyond it by the row of springs."""
    if test.medium is None:
        return kinetics(curve, 1.0, Newtonian(1.0), solution.force).depth
    return kinetics(curve, _history(test, solution), test.medium).depth


def _boundary_elements(test, solution):
    """Compute depths from the loading curve of the indenter; return their ratios to the reference."""
    curve = indent(test.indenter, tolerance=test.tolerance, until_fraction=1.0, until_force=solution.force[-1])
    return _ratios(_by_correspondence(curve, test, solution), test, solution)


def _direct(test, solution):
    """Compute depths by direct integration in steps of second order (`march`); return their ratios to the reference."""
    if test.medium is None:
        times = np.append(0.0, solution.force)
        motion = march(test.indenter, Load(times, force=np.ones(times.size)), Newtonian(1.0))
        return motion.depth[1:] / solution.depth
    return _ratios(_stepped(test, _history(test, solution), STEPS), test, solution)


def _explicit(test, solution):
    """Compute depths by integration in explicit time steps; return their ratios to the reference.

    The test sets the number of steps. Under a constant force the steps are in equal ratios of time; otherwise they are
    uniform in time.
    """
    if test.medium is None:
        impulse = solution.force
        ends = np.geomspace(impulse[0] / test.steps, impulse[-1], test.steps)
    else:
        load = _history(test, solution)
        if not isinstance(test.medium, Newtonian):
            raise ValueError("explicit steps: allowed in a Newtonian medium only, where the impulse replaces the time")
        impulse = load.integral
        fine, _ = load.with_times(np.union1d(load.time, np.linspace(load.time[0], load.time[-1], test.steps)))
        ends = fine.integral
    steps = explicit_steps(test.indenter, np.unique(np.append(ends[ends > 0], impulse[impulse > 0])))
    depth = np.append(0.0, steps.depth)[np.searchsorted(np.append(0.0, steps.impulse), impulse)]
    return _ratios(depth, test, solution)


def _reduction(test, solution):
    """Compute depths by the MDR; return their ratios to the reference.

    The line of a body of revolution is exactly equivalent to the body. The line of any other indenter is random,
    with h and L of the indenter, and with the Hurst exponent of the test.
    """
    across = test.indenter.spacing * len(test.indenter.heights)
    random_line = partial(self_affine_line, rms=np.nanstd(test.indenter.heights), length=across, seed=1)
    line = test.body.mdr_line(LINE_POINTS, across) if test.body else random_line(test.hurst, LINE_POINTS)
    curve = reduce(line, until_force=1.01 * solution.force[-1])
    return _ratios(_by_correspondence(curve, test, solution), test, solution)


def _power_law(test, solution):
    """Compute depths by the paper's power law, Eq. 6; return their ratios to the reference.

    ζ and α are taken from Eqs. 4 and 5; for a body of revolution the exact values are used. The creep response replaces
    F/G. Raises ValueError for a flat indenter, and for a load under which the contact recedes.
    """
    force = solution.force
    if test.medium is not None:
        load = _history(test, solution)
        force = creep_response(test.medium.spectrum(load), load)
        if (np.diff(force) < 0).any():
            raise ValueError("power law: the contact recedes; allowed: contacts that grow")
    across, rms = test.indenter.spacing * len(test.indenter.heights), np.nanstd(test.indenter.heights)
    zeta, alpha = reference.zeta_elastic(test.hurst), reference.exponent_alpha(test.hurst)
    if test.body is not None:
        alpha = 1 / (1 + test.body.exponent)
        zeta = test.body.stiffness(1.0) / (4 * across) / (test.body.force(1.0) / (4 * rms * across)) ** alpha
    if rms == 0:
        raise ValueError("power law: the rms height is 0; allowed: above 0")
    depth = rms * reference.depth_law(force / (4 * rms * across), zeta, alpha, gamma=False)
    return _ratios(depth, test, solution)


# ---- list of all methods


# {name: (function, limit, parameters)}. The function takes a test and its reference Solution, and returns the ratios of
# its depths to the reference. The limit is a function, too: it takes a test, and returns the largest error for which
# the method holds. Tests with the same Solution and the same values of the parameters have the same ratios.
_LOAD = ("medium", "load")
METHODS = {
    "boundary elements": (
        _boundary_elements,
        lambda test: max(test.tolerance, FINEST_ACCURACY),
        ("tolerance", *_LOAD),
    ),
    "direct integration": (_direct, lambda test: LIMIT_STEPS, _LOAD),
    "explicit steps": (_explicit, lambda test: LIMIT_STEPS, ("steps", *_LOAD)),
    "MDR": (_reduction, lambda test: LIMIT_MODEL, ("hurst", "body", *_LOAD)),
    "power law": (_power_law, lambda test: LIMIT_MODEL, ("hurst", "body", *_LOAD)),
}
MODELS = ("MDR", "power law")  # methods that are approximate models
