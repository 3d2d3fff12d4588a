"""Solve a stress-test case by every method, and compare the results with the reference solution.

The reference solution gives the forces F/G at given depths. It is computed on the same elements with dense matrices,
and is exact within rounding. By the correspondence principle, these values of F/G are also the impulses ∫F dt/η at
which the indenter reaches the depths in a viscous half-space. Each method returns ratios of its results to the
reference solution. Elastic methods return ratios of forces at the given depths; other methods return ratios of depths
at the given forces or impulses.
"""

import warnings
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from itertools import accumulate, pairwise

import numpy as np

from viscorough import reference
from viscorough.basics.errors import AccuracyWarning
from viscorough.contact.loading_path import indent
from viscorough.contact.options import SolverOptions
from viscorough.contact.prescribed_depth import ContactSolver
from viscorough.contact.step_control import FINEST_ACCURACY
from viscorough.mdr import reduce
from viscorough.media.creep_response import creep_response
from viscorough.media.kinds import Newtonian
from viscorough.media.load import Load
from viscorough.surfaces.indenter import Indenter
from viscorough.surfaces.self_affine import self_affine_line
from viscorough.viscous.integration.events import newtonian_events
from viscorough.viscous.integration.march import march
from viscorough.viscous.kinetics import kinetics
from viscorough_study.performance.explicit_steps import explicit_steps

DENSE_ONLY = SolverOptions(dense_contacts=10**9, dense_interactions=10**12)
GRID_ONLY = SolverOptions(dense_contacts=0, dense_interactions=0)
DOUBLE_ON_GRID = replace(GRID_ONLY, precision="double", exact_gap_below=0.0)
DEPTHS = 6  # number of depths of a reference solution
INTERPOLATED_FORCES = 20  # number of forces between two reference forces at which interpolated depths are compared
REFERENCE_TOLERANCE = 1e-11
BISECTIONS = 12  # number of bisections in the search for the depth of a contact fraction
BEYOND_FULL_CONTACT = 3.0  # in a case past full contact, all depths are multiplied by this factor
LINE_POINTS = 2**14  # number of points of a line of the MDR
CURVE_TOLERANCE = 1e-6  # tolerance of the loading curves in the method "media, correspondence"
# Number of time steps between two samples of the force in a viscoelastic medium, for the method "media, steps" and for
# the reference motion.
STEPS, REFERENCE_STEPS = 64, 1024
# Largest errors with which a method holds: integration by contact events, integration by time steps, and models. A
# model may deviate by a factor of 2 from a single realization.
LIMIT_EVENTS, LIMIT_STEPS, LIMIT_MODEL = 1e-9, 0.02, 1.0


@dataclass(frozen=True)
class Solution:
    """Reference solution of a stress-test case; all arrays have the shape (depths,).

    indenter : indenter of the case
    depth : prescribed depths [length]; force : F/G [length²]; count : number of elements in contact
    motions : reference motions of cases with a medium, {(medium, load): depths}, computed when they are needed
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


def reference_solution(case):
    """Compute the reference Solution of a stress-test case at `DEPTHS` depths.

    The depths are logarithmically uniform. The first and the last depth reach the two contact fractions of the case. If
    the last fraction is above 1, the depths extend beyond full contact.
    """
    solver = ContactSolver(case.indenter, REFERENCE_TOLERANCE, DENSE_ONLY)
    first = _depth_of_fraction(solver, case.fractions[0], 0.0)
    last = _depth_of_fraction(solver, min(case.fractions[1], 1.0), first)
    depths = np.geomspace(first, last, DEPTHS) if last > first else first * np.arange(1.0, DEPTHS + 1)
    depths *= BEYOND_FULL_CONTACT if case.fractions[1] > 1 else 1.0
    contacts = accumulate(depths, solver.advance_reduced, initial=solver.unloaded_state())
    _, *levels = ((contact.force, contact.count) for contact in contacts)
    return Solution(case.indenter, depths * solver.units.length, *np.array(levels).T)


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


# ---- methods for the elastic and the Newtonian half-space, and approximate models


def _path(options, case, solution):
    """Compute forces by `indent` with the given solver options; return their ratios to the reference forces."""
    curve = indent(case.indenter, tolerance=case.tolerance, depths=solution.depth, options=options)
    return curve.force / solution.force


def _interpolated(case, solution):
    """Interpolate depths on a loading curve whose points `indent` chooses; return their ratios to exact depths.

    The depths are compared at several forces from each force of the reference solution to the next force.
    """
    curve = indent(case.indenter, tolerance=case.tolerance, until_fraction=1.0, until_force=solution.force[-1])
    kinetics(curve, 1.0, 1.0, solution.force[:1])  # raises ValueError if the first force is beyond the curve
    ends = np.minimum(solution.force, curve.force[-1])
    starts = np.append(ends[0], ends[:-1])
    force = starts[:, None] * (ends / starts)[:, None] ** np.linspace(0, 1, INTERPOLATED_FORCES)
    return curve.at_force(force)[0] / solution.events.depth_at(force)


def _events(case, solution):
    """Compute depths by integration from contact event to contact event; return their ratios to the reference."""
    return solution.events.depth_at(solution.force) / solution.depth


def _steps(case, solution):
    """Compute depths by integration in explicit time steps; return their ratios to the reference depths.

    The case sets the number of steps. If the force is constant, the steps are in equal ratios of time; otherwise they
    are uniform in time.
    """
    if min(case.force) == max(case.force):
        ends = np.geomspace(solution.force[0] / case.steps, solution.force[-1], case.steps)
    else:
        samples = np.arange(len(case.force))
        times = np.linspace(0, samples[-1], case.steps)
        impulse = Load(times, force=np.interp(times, samples, case.force)).integral
        ends = solution.force[-1] * np.unique(impulse[impulse > 0]) / impulse[-1]
    steps = explicit_steps(case.indenter, np.union1d(ends, solution.force))
    return steps.depth[np.searchsorted(steps.impulse, solution.force)] / solution.depth


def _reduction(case, solution):
    """Compute depths by the MDR; return their ratios to the reference depths.

    The line of a body of revolution is exactly equivalent to the body. The line of any other indenter is random,
    with h and L of the indenter, and with the Hurst exponent of the case.
    """
    across = case.indenter.spacing * len(case.indenter.heights)
    random_line = partial(self_affine_line, rms=np.nanstd(case.indenter.heights), length=across, seed=1)
    line = case.body.mdr_line(LINE_POINTS, across) if case.body else random_line(case.hurst, LINE_POINTS)
    depth, _ = reduce(line, until_force=1.01 * solution.force[-1]).at_force(solution.force)
    return depth / solution.depth


def _power_law(gamma, case, solution):
    """Compute depths by the power law; return their ratios to the reference depths.

    The law is Eq. 8 if `gamma` is True, otherwise Eq. 6. ζ and α are taken from Eqs. 4 and 5; for a body of revolution
    the exact values are used.
    """
    across, rms = case.indenter.spacing * len(case.indenter.heights), np.nanstd(case.indenter.heights)
    zeta, alpha = reference.zeta_elastic(case.hurst), reference.exponent_alpha(case.hurst)
    if case.body is not None:
        alpha = 1 / (1 + case.body.exponent)
        zeta = case.body.stiffness(1.0) / (4 * across) / (case.body.force(1.0) / (4 * rms * across)) ** alpha
    if rms == 0:
        raise ValueError("power law: the rms height is 0; allowed: above 0")
    if gamma:
        text = "the factor 1/Γ(2−α) comes from the Laplace transform of a nonlinear relation"
        warnings.warn(text, AccuracyWarning, stacklevel=1)
    x = solution.force / (4 * rms * across)
    return rms * reference.depth_law(x, zeta, alpha, gamma=gamma) / solution.depth


# ---- methods for viscoelastic media. A case without a medium has a Newtonian medium and a constant force. In a
# viscoelastic medium, the reference is direct integration. If the contact only grows, the integration proceeds from
# contact event to contact event, which is exact. Otherwise it takes many time steps.


def _by_correspondence(case, solution):
    """Compute depths from a loading curve by the correspondence principle (`kinetics`).

    Returns the ratios of these depths to the reference depths.
    """
    curve = indent(case.indenter, tolerance=CURVE_TOLERANCE, until_fraction=1.0, until_force=solution.force[-1])
    if case.medium is None:
        return kinetics(curve, 1.0, Newtonian(1.0), solution.force).depth / solution.depth
    times, force = _history(case, solution)
    depth = kinetics(curve, Load(times, force=force), case.medium).depth
    return _ratios(depth, _motion_reference(case, solution))


def _by_steps(case, solution):
    """Compute depths by direct integration in steps of second order (`march`); return their ratios to the reference."""
    if case.medium is None:
        times = np.append(0.0, solution.force)
        motion = march(case.indenter, Load(times, force=np.ones(times.size)), Newtonian(1.0))
        return motion.depth[1:] / solution.depth
    return _ratios(_stepped(case, solution, STEPS), _motion_reference(case, solution))


def _history(case, solution):
    """Return the times and the forces of the load in a case with a viscoelastic medium.

    The times are from 0 to 1; a repeated time marks a step of the force. The forces are scaled so that the equivalent
    elastic force stays below the last force of the reference solution.
    """
    times, shape = np.array(case.medium_load).T
    largest = solution.force[-1] / case.medium.creep_compliance(times[-1]) / shape.max()
    return times, 0.999 * largest * shape


def _motion_reference(case, solution):
    asked = case.medium, case.medium_load
    if asked not in solution.motions:
        times, force = _history(case, solution)
        load = Load(times, force=force)
        if (np.diff(load.values) < 0).any():  # the contact recedes while the force falls
            solution.motions[asked] = _stepped(case, solution, REFERENCE_STEPS)
        else:  # a growing contact has the same events in every medium: the creep response replaces the impulse ∫F dt/η
            response = creep_response(case.medium.spectrum(load), load)
            solution.motions[asked] = solution.events.depth_at(response)
    return solution.motions[asked]


def _stepped(case, solution, number):
    """Compute the depths at the samples of the force by direct integration, with `number` steps between samples.

    The steps are shortest after a sample, and grow until the next sample.
    """
    history = np.array(_history(case, solution))  # first row: times; second row: forces
    parts, place = [history[:, :1]], [0]
    for start, end in pairwise(history.T):
        share = np.ones(1) if start[0] == end[0] else np.linspace(0, 1, number + 1)[1:] ** 2
        parts.append(start[:, None] + (end - start)[:, None] * share)
        place.append(place[-1] + share.size)
    times, force = np.concatenate(parts, axis=1)
    return march(case.indenter, Load(times, force=force), case.medium).depth[place]


def _ratios(depth, reference):
    loaded = reference > 0
    return depth[loaded] / reference[loaded]


# ---- list of all methods


# {name: (function, limit, parameters)}. The function takes a case and its reference Solution, and returns the ratios of
# its depths or forces to the reference. The limit is a function, too: it takes a case, and returns the largest error
# for which the method holds. Cases with the same Solution and the same values of the parameters have the same ratios.
METHODS = {
    "path, dense": (partial(_path, DENSE_ONLY), lambda case: 10 * case.tolerance, ("tolerance",)),
    "path, grid, double": (partial(_path, DOUBLE_ON_GRID), lambda case: 10 * case.tolerance, ("tolerance",)),
    "path, grid, single": (partial(_path, GRID_ONLY), lambda case: 10 * case.tolerance, ("tolerance",)),
    "path, interpolated": (_interpolated, lambda case: max(case.tolerance, FINEST_ACCURACY), ("tolerance",)),
    "events": (_events, lambda case: LIMIT_EVENTS, ()),
    "explicit steps": (_steps, lambda case: LIMIT_STEPS, ("steps", "force")),
    "media, correspondence": (
        _by_correspondence,
        lambda case: max(CURVE_TOLERANCE, FINEST_ACCURACY),
        ("medium", "medium_load"),
    ),
    "media, steps": (_by_steps, lambda case: LIMIT_STEPS, ("medium", "medium_load")),
    "MDR": (_reduction, lambda case: LIMIT_MODEL, ("hurst", "body")),
    "power law": (partial(_power_law, False), lambda case: LIMIT_MODEL, ("hurst", "body")),
    "power law with Γ": (partial(_power_law, True), lambda case: LIMIT_MODEL, ("hurst", "body")),
}
MODELS = ("MDR", "power law", "power law with Γ")  # methods that are approximate models
