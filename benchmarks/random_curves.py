"""Random small indenters that detect silent failures: solutions reported as converged that are wrong.

Levels are checked one by one. Loading curves are checked at levels, between them, in kinetics, and in integrals.
"""

import warnings
from dataclasses import dataclass

import numpy as np
from random_heights import random_heights, with_random_aspect

from viscorough.basics.errors import AccuracyWarning, ConvergenceError
from viscorough.contact.complete_contact import complete_contact
from viscorough.contact.loading_path import indent
from viscorough.contact.options import DEFAULT, SolverOptions
from viscorough.contact.prescribed_depth import ContactSolver
from viscorough.contact.step_control import FINEST_ACCURACY
from viscorough.surfaces.indenter import Indenter
from viscorough.surfaces.self_affine import self_affine_disc
from viscorough.viscous.integration.events import newtonian_events
from viscorough.viscous.kinetics import kinetics

_LARGEST = 32  # largest number of elements across
# Share of the height differences below which the rounding of the heights dominates depths.
_HEIGHT_ROUNDING = 1e-13
GRID_ONLY = SolverOptions(dense_contacts=0, dense_interactions=0)
# Solver options to draw from: the dense solver up to different sizes, and the grid from the first level on.
_OPTIONS = (DEFAULT, SolverOptions(dense_contacts=30, dense_interactions=300), SolverOptions(dense_interactions=0))


@dataclass(frozen=True)
class RandomCurve:
    """An indenter and the arguments of `indent` for it."""

    indenter: Indenter
    arguments: dict


def random_levels(generator):
    """Draw a RandomCurve of a smaller indenter with three depths, from a numpy Generator."""
    heights = random_heights(generator)
    height, length = 10.0 ** generator.uniform(-12, 12, 2) if generator.random() < 0.3 else (1.0, 1.0)
    indenter = Indenter(height * heights, length)
    span = np.nanmax(indenter.initial_gap) or length
    depths = np.sort(span * 10.0 ** generator.uniform(-3, 1.5, 3))
    arguments = {"depths": depths, "tolerance": 10.0 ** -generator.uniform(1, 11)}
    arguments["options"] = GRID_ONLY if generator.random() < 0.6 else DEFAULT
    return RandomCurve(with_random_aspect(indenter, generator), arguments)


def random_curve(generator, with_start=None, at_forces=False):
    """Draw a RandomCurve from a numpy Generator.

    with_start : give `start_fraction` or not; random by default
    at_forces : give levels by forces only
    """
    heights = random_heights(generator, int(generator.integers(2, _LARGEST + 1)))
    height, length = 10.0 ** generator.uniform(-9, 9, 2) if generator.random() < 0.2 else (1.0, 1.0)
    indenter = Indenter(height * heights, length)
    arguments = {"tolerance": 10.0 ** -generator.uniform(1, 6), "options": _OPTIONS[generator.integers(len(_OPTIONS))]}
    arguments["until_fraction"] = generator.uniform(0.01, 1.0) if generator.random() < 0.7 else 1.0
    if generator.random() < 0.3 if with_start is None else with_start:
        arguments["start_fraction"] = arguments["until_fraction"] * generator.uniform(0.01, 0.99)
    span = np.nanmax(indenter.initial_gap) or length
    if generator.random() < 0.2:
        arguments["until_force"] = span * length * indenter.elements**0.5 * 10.0 ** generator.uniform(-3, 1)
    if generator.random() < 0.2:
        arguments["depths"] = np.sort(span * 10.0 ** generator.uniform(-3, 1, generator.integers(1, 5)))
    if at_forces:
        forces = span * length * indenter.elements**0.5 * 10.0 ** generator.uniform(-5, 1.5, generator.integers(1, 5))
        arguments = {name: arguments[name] for name in ("tolerance", "options")} | {"forces": np.sort(forces)}
    return RandomCurve(with_random_aspect(indenter, generator), arguments)


def random_whole_curve(generator, across, largest_tolerance=1e-2, smallest_tolerance=1e-2):
    """Draw a RandomCurve of an ordinary disc until complete contact, from a numpy Generator.

    across : numbers of elements across to draw from; the Hurst exponent is drawn from 0 to 1
    largest_tolerance, smallest_tolerance : limits of the tolerance, whose logarithm is drawn
    """
    disc = self_affine_disc(generator.random(), int(generator.choice(across)), seed=int(generator.integers(2**32)))
    tolerance = largest_tolerance * (smallest_tolerance / largest_tolerance) ** generator.random()
    return RandomCurve(disc, {"tolerance": tolerance, "until_fraction": 1.0})


def whole_curve_failure(case, compute=indent):
    """Return an error message on the end of the whole loading curve of a RandomCurve; "" if it is right.

    Within the tolerance, the last level must lie at the depth of complete contact that linear solutions give.
    """
    curve, end = compute(case.indenter, **case.arguments), complete_contact(case.indenter)
    tolerance, ratio = case.arguments["tolerance"], curve.depth[-1] / end.depth
    if curve.contact_count[-1] < curve.elements:
        return f"stops at a contact fraction of {curve.contact_fraction[-1]:.6g}"
    if abs(ratio - 1) > tolerance:
        return f"ends at {ratio:.6g} times the depth of complete contact, tolerance {tolerance:.2g}"
    expected = end.stiffness * (curve.depth[-1] - end.mean_gap)
    if abs(curve.force[-1] / expected - 1) > tolerance:
        return f"force at the end off by {curve.force[-1] / expected - 1:.2g}, tolerance {tolerance:.2g}"
    return ""


def levels_failure(case, solver_type=ContactSolver):
    """Return an error message on the converged levels of a RandomCurve at given depths; "" if they are right.

    The solution is checked, by the dense influence matrix, for tension, and for a gap in contact or an overlap outside
    it of more than ten times the tolerance. The force is compared with direct integration in time, which
    shares only the influence coefficients with the path. The rounding of the heights at small depths is allowed for.
    A ConvergenceError is not a silent failure, but a level solved before it can be wrong.
    """
    tolerance, options = case.arguments["tolerance"], case.arguments["options"]
    solver, events = solver_type(case.indenter, tolerance, options), newtonian_events(case.indenter)
    row, column = solver.elements.row, solver.elements.column
    influence = solver.elements.influence[abs(row[:, None] - row), abs(column[:, None] - column)]
    contact, wrong = solver.unloaded_state(), ""
    for depth in case.arguments["depths"]:
        try:
            contact = solver.advance(contact, depth)
        except ConvergenceError:
            return wrong
        reduced = contact.reduced_depth
        allowed = 10 * tolerance + 1e-13 / min(reduced, 1.0)
        members, pressure, _ = contact.member_loads()
        gap = influence[:, members] @ pressure - reduced + solver.elements.initial_gap
        exact = np.interp(depth, events.depth, events.impulse)
        exact += max(depth - events.depth[-1], 0.0) * events.resistance[-1]
        if pressure.min() < 0:
            wrong = f"tension {pressure.min():.2g}"
        elif max(-gap.min(), np.abs(gap[members]).max()) > allowed * reduced:
            wrong = f"overlap {-gap.min():.2g}, gap {gap[members].max():.2g} at depth {reduced:.2g}"
        elif abs(contact.force / exact - 1) > allowed:
            wrong = f"force off by {contact.force / exact - 1:.2g}, tolerance {tolerance:.2g}, depth {reduced:.2g}"
    return wrong


def curve_failure(case, compute=indent):
    """Return an error message on the loading curve of a RandomCurve; "" if it is right.

    The reference is the direct integration in time, exact from event to event, which shares only the influence
    coefficients with the loading path. The error of the depth at the force of every level must be below the tolerance.
    So must the error of depths interpolated between levels (not below FINEST_ACCURACY), from the start fraction on,
    unless a warning was given. The kinetics under a force history must have the depths of the reference.
    """
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", AccuracyWarning)
        curve = compute(case.indenter, **case.arguments)
    events = newtonian_events(case.indenter)
    tolerance, rounding = case.arguments["tolerance"], _HEIGHT_ROUNDING * max(np.nanmax(case.indenter.initial_gap), 0)
    exact = events.depth_at(curve.force)
    if wrong := _error("depth {:.3g} of a level", curve.depth, curve.depth, exact, tolerance, rounding):
        return wrong
    if "depths" in case.arguments or "forces" in case.arguments:
        return _error_before(curve, events, max(tolerance, FINEST_ACCURACY), rounding)
    return "" if caught else _error_between(curve, events, case, max(tolerance, FINEST_ACCURACY), rounding)


def _error(name, places, depth, exact, tolerance, rounding):
    """Return a message on the largest error of depths if it exceeds the tolerance, or ""; name : template of a place"""
    error = np.nan_to_num(np.abs(depth / exact - 1) - rounding / exact, nan=np.inf)
    worst = error.argmax()
    if error[worst] <= tolerance:
        return ""
    return f"{name.format(places[worst])} off by {error[worst]:.2g}, tolerance {tolerance:.2g}"


def _error_between(curve, events, case, tolerance, rounding):
    """Return an error message on depths between the levels, or ""."""
    arguments, last = case.arguments, curve.force[-1]
    if curve.contact_fraction[-1] < arguments["until_fraction"] and last < arguments.get("until_force", np.inf):
        return f"stops at a contact fraction of {curve.contact_fraction[-1]:.3g}"
    before_start = curve.contact_fraction < arguments.get("start_fraction", 0.0)
    first = max(curve.force[before_start], default=0.0)
    force = events.impulse[(events.impulse > first) & (events.impulse < last)]
    force = np.unique(np.concatenate([force, (force[1:] + force[:-1]) / 2, [first + 0.5 * (last - first), last]]))
    exact = events.depth_at(force)
    if wrong := _error("depth at force {:.3g}", force, curve.at_force(force)[0], exact, tolerance, rounding):
        return wrong
    times = np.unique(np.append(0.0, force) / last)
    moved = kinetics(curve, np.full(times.shape, last), 1.0, times).depth[1:]
    return _error("depth at time {:.3g}", times[1:], moved, events.depth_at(last * times[1:]), tolerance, rounding)


def _error_before(curve, events, tolerance, rounding):
    """Return an error message on depths before the first given depth, which are returned only if exact; or ""."""
    force = curve.force[0] * np.array([1e-3, 0.3, 0.9])
    exact, depth = events.depth_at(force), curve.at_force(force)[0]
    depth = np.where(np.isnan(depth), exact, depth)
    return _error("depth before the first level", force, depth, exact, tolerance, rounding)
