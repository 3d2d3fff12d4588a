"""Follow the elastic loading path of a rigid indenter by boundary elements, from level to level.

One path determines the solution of the viscous problem for every force history (viscorough.viscous.kinetics).
While few elements are in contact, every contact event (the next element touches) is a level: between events the curve
is straight, so interpolation is exact. Later, levels are placed as interpolation requires (step_control). A curve that
reaches complete contact ends at this depth, which two linear problems give (complete_contact): elements whose overlap
stays within the tolerance need not join the contact, so a search for the last elements could continue without end.
"""

from __future__ import annotations

import functools
from collections.abc import Iterable
from dataclasses import dataclass, replace
from itertools import accumulate, islice
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from viscorough.basics import units
from viscorough.basics.argument_names import argument
from viscorough.basics.arrays import fraction, increasing, real_number
from viscorough.basics.elasticity import shear_modulus_of
from viscorough.basics.types import Array, Progress, Scalar
from viscorough.contact.argument_checks import check_solvable, warn_beyond_theory
from viscorough.contact.dense import ROUNDING
from viscorough.contact.grid_error import every_nth_point, highest_missed, with_grid_errors
from viscorough.contact.options import DEFAULT, SolverOptions
from viscorough.contact.prescribed_depth import ContactSolver
from viscorough.contact.prescribed_force import ForceSearch
from viscorough.contact.sampling import curve_within, part_of
from viscorough.contact.state import ContactState, DenseContact
from viscorough.contact.step_control import ContactsAhead, Level, StepControl, division
from viscorough.results.loading_curve import LoadingCurve
from viscorough.surfaces.indenter import Indenter

# Ratio of depths of the steps that approach the start fraction.
_APPROACH_DEPTH_RATIO = 4.0
# Approach the start fraction up to this share of it.
_APPROACH_SHARE = 0.7
# End the approach when its steps, which become shorter close to the start, reach this ratio of depths.
_APPROACH_MIN_RATIO = 1.02
# A curve up to this contact fraction does not need the depth of complete contact for its end.
_FAR_FROM_COMPLETE = 0.95
# Tolerance of a curve unless one is given.
_DEFAULT_TOLERANCE = 1e-3
# Smallest and largest error of the velocity that can be requested.
_ERRORS = 1e-3, 0.5
# Share of a curve in the computation of a curve and its estimated grid error.
_SHARE_OF_CURVE = 0.75
# Exponent of the share of the contact, or of the force, in the estimated share of the computation.
_PROGRESS_EXPONENT = 0.5


def indent(
    indenter: Indenter,
    *,
    forces: ArrayLike | None = None,
    depths: ArrayLike | None = None,
    start_fraction: float = 0.0,
    until_fraction: float = 0.9,
    until_force: float | str = np.inf,
    shear_modulus: Scalar | str | None = None,
    young_modulus: Scalar | str | None = None,
    poisson: float | None = None,
    tolerance: float | None = None,
    error: float | None = None,
    estimate_grid_error: bool = False,
    progress: Progress | None = None,
    threads: int = 1,
    options: SolverOptions = DEFAULT,
) -> LoadingCurve:
    """Compute the loading curve of a rigid indenter in an incompressible elastic half-space, without friction.

    Solves w = (1/4πG) ∫ p/r dA with p ≥ 0, w ≥ u − g and p (w − u + g) = 0 for the initial gaps g of the indenter's
    elements (uniform pressure on square elements; Love 1929), at increasing depths u.

    Parameters
    ----------
    indenter : Indenter
        Indenter with two-dimensional heights.
    forces : array_like, optional
        Levels at exactly these F/G, increasing [length²]; not together with depths.
    depths : array_like, optional
        Levels at exactly these depths, increasing [length]; default: levels are placed as the tolerance requires.
    start_fraction : float, optional
        Smallest contact fraction that is of interest, below `until_fraction`. At smaller fractions the curve has only a
        few levels, and interpolation between these may exceed the tolerance. Ignored if depths or forces are given.
    until_fraction : float, optional
        Largest contact fraction of the curve, in (0, 1]; ignored if depths or forces are given.
    until_force : float or str, optional
        Largest F/G of the curve [length²]; ignored if depths or forces are given.
    shear_modulus : float or str, optional
        G of an incompressible half-space [Pa], or a text like "2 MPa"; forces are then F [N], or texts like "5 mN".
        Depths may be texts, too.
    young_modulus : float or str, optional
        Young's modulus E instead of G: G = E/(1 − ν²)/4.
    poisson : float, optional
        Poisson ratio ν, above −1 and at most 0.5, with `young_modulus`; by default 0.5.
    tolerance : float, optional
        Largest gap in contact, or overlap outside it, over the depth, at every level, rounding included. The relative
        error of the force is far below it; the stiffness is less accurate (docs/solver.md). Also the largest relative
        error of the depth interpolated between levels by LoadingCurve.at_force, down to 1e-5, if neither depths nor
        forces are given. Between 1e-12 and 0.1; by default 1e-3. It does not include the error of the grid, which is
        often larger (`estimate_grid_error`).
    error : float, optional
        Relative error of the velocity that is allowed, from 1e-3 to 0.5, instead of a tolerance. The curve is computed
        on as few points of the map, and to as loose a tolerance, as the estimated error allows: on every n-th point in
        both directions, with n a power of two, from coarse to fine. It is the root mean square over all forces F/G from
        hL/25 on, with the rms height h and the diameter L of a disc of the same area, and is relative to the curve
        of all points. The result states `sampling` and the reason for it, `choice`.
    estimate_grid_error : bool, optional
        Estimate the error due to the spacing of the map, `grid_error` of the result, from a second curve on every
        second point. This takes 0.2 to 0.6 times as long as the curve. With `error` it is always estimated.
    progress : Progress, optional
        Function called after a level with the estimated finished share of the computation, up to 1.
    threads : int, optional
        Number of threads; the result does not depend on it. Use several for large maps.
    options : SolverOptions, optional
        Details of the iterations, such as their precision; change them only to measure their effect.

    Returns
    -------
    LoadingCurve
        Its last level is the first level at or beyond `until_fraction` or `until_force`, or the depth of
        `complete_contact`: beyond it the curve is straight. An indenter of one height has a
        single level, at a depth of one spacing (√(dx dy) for two): its curve is the straight line from the origin
        through it.

    Raises
    ------
    ValueError
        For arguments out of range, for an error together with a tolerance, depths or forces, and for maps of fewer than
        3 x 3 points if the error of the grid is needed.
    ConvergenceError
        If a level cannot be solved to the tolerance.

    Warns
    -----
    AccuracyWarning
        If the estimated error of the grid of the whole map exceeds the requested error.

    Examples
    --------
    >>> import viscorough
    >>> disc = viscorough.self_affine_disc(0.7, 17, rms=0.01, seed=1)
    >>> curve = viscorough.indent(disc, depths=[0.005, 0.01])
    >>> curve.depth.tolist(), bool(curve.force[0] < curve.force[1])
    ([0.005, 0.01], True)

    Request the velocity within 20 %, which takes every second point:

    >>> disc = viscorough.self_affine_disc(0.8, 129, rms=0.01, seed=1)
    >>> viscorough.indent(disc, error=0.2).sampling
    2
    """
    error = _check_error(error, tolerance=tolerance, depths=depths, forces=forces)
    tolerance = check_solvable(
        "indent", indenter, _DEFAULT_TOLERANCE if tolerance is None else tolerance, threads, options
    )
    if depths is not None and forces is not None:
        raise ValueError("indent: depths and forces exclude each other; one of them is allowed")
    start_fraction, until_fraction = _check_fractions(start_fraction, until_fraction)
    unit = indenter.length_unit
    modulus = shear_modulus_of(unit, shear_modulus, young_modulus, poisson)
    request = _CurveRequest(
        start_fraction=start_fraction,
        until_fraction=until_fraction,
        until_force=_check_until_force(until_force, modulus, unit),
        depths=_check_depths(depths, unit),
        forces=_check_forces(forces, modulus, unit),
        threads=threads,
        options=options,
    )
    progress = progress or (lambda done: None)
    if error is not None:
        curve = curve_within(error, indenter, functools.partial(_curve, request), progress)
    elif estimate_grid_error:
        curve = _curve_with_grid_errors(request, indenter, tolerance, progress)
    else:
        curve = _curve(request, indenter, tolerance, progress)
    warn_beyond_theory("indent", indenter, curve.depth[-1])
    return curve


@dataclass(frozen=True)
class _CurveRequest:
    """Range or levels of a curve, and details of its computation: the checked arguments of `indent`, as numbers.

    depths, forces : levels [length] or F/G [length²]; at most one of them is given, and then the range is ignored
    start_fraction, until_fraction : range of contact fractions
    until_force : largest F/G of the curve [length²]
    threads : number of threads
    options : SolverOptions
    """

    start_fraction: float
    until_fraction: float
    until_force: float
    depths: Array | None
    forces: Array | None
    threads: int
    options: SolverOptions


def _check_fractions(start_fraction: float, until_fraction: float) -> tuple[float, float]:
    """Return both contact fractions as floats. Raises ValueError for fractions out of range."""
    until_fraction = fraction("indent: until_fraction", until_fraction)
    start_fraction = real_number("indent: start_fraction", start_fraction)
    if not 0 <= start_fraction < until_fraction:
        raise ValueError(f"indent: start_fraction must be from 0 to below until_fraction, not {start_fraction!r}")
    return start_fraction, until_fraction


def _check_until_force(until_force: float | str, modulus: float | None, unit: str) -> float:
    """Return the largest force of a curve as F/G [length²]. Raises ValueError unless it is positive."""
    if not (isinstance(until_force, float | np.floating) and until_force == np.inf):
        until_force = units.forces_over_modulus(until_force, modulus, unit, argument("until_force"))
        until_force = real_number(argument("until_force"), until_force)
    if not until_force > 0:
        raise ValueError(f"{argument('until_force', of='indent')} must be positive, not {until_force!r}")
    return until_force


def _check_depths(depths: ArrayLike | None, unit: str) -> Array | None:
    """Return the depths of levels [length]. Raises ValueError unless they are positive and increase."""
    if depths is None:
        return None
    numbers = np.atleast_1d(units.numbers(depths, unit, unit, argument("depths")))
    return increasing(argument("depths", of="indent"), numbers, above_zero=True)


def _check_forces(forces: ArrayLike | None, modulus: float | None, unit: str) -> Array | None:
    """Return the forces of levels as F/G [length²]. Raises ValueError unless they are positive and increase."""
    if forces is None:
        return None
    numbers = np.atleast_1d(units.forces_over_modulus(forces, modulus, unit, argument("forces")))
    return increasing(argument("forces", of="indent"), numbers, above_zero=True)


def _check_error(error: float | None, **others: Any) -> float | None:
    """Return the error as a float. Raises ValueError unless it is in range, and for other arguments along with it."""
    if error is None:
        return None
    error = real_number(argument("error", of="indent"), error)
    least, largest = _ERRORS
    if not least <= error <= largest:
        raise ValueError(
            f"{argument('error', of='indent')} must be between {least:g} and {largest:g} (5 % is 0.05), not {error!r}"
        )
    for name, value in others.items():
        if value is not None:
            why = "it chooses the tolerance" if name == "tolerance" else "it holds for a whole curve, which has levels"
            text = f"{argument('error', of='indent')} and {argument(name)} exclude each other"
            raise ValueError(f"{text}: {why}")
    return error


def _curve_with_grid_errors(
    request: _CurveRequest, indenter: Indenter, tolerance: float, progress: Progress
) -> LoadingCurve:
    """Compute the LoadingCurve of a map, and estimate the errors of its grid from a curve on every second point."""
    curve = _curve(request, indenter, tolerance, part_of(progress, 0.0, _SHARE_OF_CURVE))
    coarse, rest = every_nth_point(indenter, 2), part_of(progress, _SHARE_OF_CURVE, 1.0)
    whole = replace(request, depths=None, forces=None, until_fraction=1.0, until_force=curve.force[-1])
    second = _curve(whole, coarse, tolerance, rest)
    return with_grid_errors(curve, second, indenter, highest_missed(indenter, coarse))


def _curve(request: _CurveRequest, indenter: Indenter, tolerance: float, progress: Progress) -> LoadingCurve:
    """Compute the LoadingCurve of a map."""
    depths, forces, options, threads = request.depths, request.forces, request.options, request.threads
    if depths is not None:
        solver = ContactSolver(indenter, tolerance, options, threads, largest_depth=depths[-1], whole=False)
        contacts = accumulate(depths, solver.advance, initial=solver.unloaded_state())
        levels = _levels(islice(contacts, 1, None), len(depths), progress)
    elif forces is not None:
        # The correction to the force takes the other half of the tolerance.
        solver = ContactSolver(indenter, tolerance / 2, options, threads, whole=False)
        levels = _levels(map(ForceSearch(solver).contact_at, forces), len(forces), progress)
    else:
        solver = ContactSolver(indenter, tolerance, options, threads)
        path = _LoadingPath(solver, request.until_fraction, request.until_force, progress)
        levels = path.levels_from(request.start_fraction)
    depth = solver.units.length * np.array([level.depth for level in levels])
    force = solver.units.force * np.array([level.pressure_sum for level in levels])
    if not np.isfinite(force).all():
        raise ValueError("indent: forces are too large to represent; a larger unit of length is needed")
    _check_distance(depths, force, "depths", "forces")
    _check_distance(forces, depth, "forces", "depths")
    return LoadingCurve(
        depth=depth if depths is None else np.asarray(depths),
        force=force if forces is None else np.asarray(forces),
        stiffness=solver.units.stiffness * np.array([level.tangent_sum for level in levels]),
        contact_count=np.array([level.count for level in levels]),
        elements=solver.elements.count,
        method="boundary elements",
        tolerance=tolerance,
        operator_applications=solver.operator_applications,
        residual=np.array([level.residual for level in levels]),
        length_unit=indenter.length_unit,
    )


def _check_distance(given: ArrayLike | None, found: Array, name: str, other: str) -> None:
    """Raise ValueError if given depths or forces are so close that the results at them do not increase."""
    if given is not None and (closer := np.diff(found) <= 0).any():
        level, values = int(np.argmax(closer)), np.asarray(given)
        pair = f"{values[level]:.17g} and {values[level + 1]:.17g} are closer than the accuracy"
        text = f"{argument(name, of='indent')}: {pair}, so that {other} do not increase"
        raise ValueError(f"{text}; fewer levels or a smaller tolerance are needed")


def _levels(contacts: Iterable[ContactState], number: int, progress: Progress) -> list[Level]:
    """Return the levels of so many contacts, which are solved one after the other."""
    levels = []
    for contact in contacts:
        levels.append(Level.of(contact))
        progress(len(levels) / number)
    return levels


class _LoadingPath:
    """Path from first contact to the largest contact fraction or force of a curve; works in reduced units."""

    def __init__(self, solver: ContactSolver, until_fraction: float, until_force: float, progress: Progress) -> None:
        self._solver, self._progress = solver, progress
        self._control = StepControl(solver.tolerance, solver.threads)
        self._until_count = until_fraction * solver.elements.count
        self._complete: ContactState | None = None  # computed when the path may have reached it
        # Slightly more, so that rounding does not leave the last level below the force.
        self._until_pressure_sum = (1 + ROUNDING / 2) * until_force / solver.units.force
        self._contact = solver.first_contact()
        self._levels = [Level.of(self._contact)]
        self._ahead = ContactsAhead()

    def levels_from(self, start_fraction: float) -> list[Level]:
        """Return all levels; there are only a few below the start fraction."""
        self._approach(start_fraction * self._solver.elements.count)
        self._follow_events()
        self._step_to_the_end()
        return self._levels

    def _is_unfinished(self) -> bool:
        contact, every = self._contact, self._solver.elements.count
        if contact.pressure_sum >= self._until_pressure_sum or contact is self._complete:
            return False
        if contact.count < every or isinstance(contact, DenseContact):
            return contact.count < self._until_count  # a dense solution is exact
        # On the grid the last elements may join too early, within the tolerance.
        return self._until_count > every - 1 and not self._solver.is_flat

    def _advance_to(self, depth: float) -> ContactState:
        """Return the contact at a larger depth, or the first complete contact if that is reached before.

        The depth of complete contact is computed as soon as a contact may lie beyond it, unless the curve ends there.
        """
        if self._complete is None:
            contact = self._solver.advance_reduced(self._contact, depth)
            every = self._solver.elements.count
            far = self._until_count <= _FAR_FROM_COMPLETE * every
            is_last = far and contact.count >= self._until_count
            is_last = is_last or (contact.count < every and contact.pressure_sum >= self._until_pressure_sum)
            if is_last or not self._solver.may_be_complete(contact):
                return contact
            self._complete = self._solver.complete_contact()
            # Rounding and residuals must not decide the order of two levels at almost the same depth.
            is_before = depth * self._control.min_ratio < self._complete.reduced_depth
            return contact if is_before else self._complete
        if depth >= self._complete.reduced_depth:
            return self._complete
        return self._solver.advance_reduced(self._contact, depth)

    def _add(self, contact: ContactState) -> None:
        self._contact = contact
        self._levels.append(Level.of(contact))
        done = max(contact.count / self._until_count, contact.pressure_sum / self._until_pressure_sum)
        self._progress(min(done, 1.0) ** _PROGRESS_EXPONENT)

    def _approach(self, start_count: float) -> None:
        """Take long steps towards the smallest contact count of interest, and shorter steps close to it."""
        ratio, most = _APPROACH_DEPTH_RATIO, _APPROACH_SHARE * start_count
        while self._is_unfinished() and self._contact.count < most and ratio > _APPROACH_MIN_RATIO:
            contact = self._advance_to(self._contact.reduced_depth * ratio)
            # Contacts beyond the start are kept for later: the interval that contains the start must be short.
            if contact.count >= start_count or contact.pressure_sum > self._until_pressure_sum:
                self._ahead.keep(contact)
            else:
                self._add(contact)
            if self._ahead:  # then levels approach the nearest of these contacts
                ratio = (self._ahead[-1].reduced_depth / self._contact.reduced_depth) ** 0.5

    def _follow_events(self) -> None:
        """Add the contact events as levels while few elements are in contact; only a dense solution is exact enough."""
        contact = self._contact
        if not self._is_unfinished() or not isinstance(contact, DenseContact) or contact.count >= self._control.events:
            return
        most = min(self._control.events, int(np.ceil(self._until_count)))
        events, self._contact, _ = self._solver.follow_events(contact, most, self._until_pressure_sum)
        if events.depth.size and events.depth[0] <= contact.reduced_depth * (1 + ROUNDING):
            self._levels.pop()  # more elements touch at exactly this depth
        self._levels += [Level(*event) for event in zip(*events, strict=True)]
        nearest = self._control.min_ratio * self._contact.reduced_depth
        self._ahead = ContactsAhead(contact for contact in self._ahead if contact.reduced_depth > nearest)

    def _step_to_the_end(self) -> None:
        ratio = self._control.first_ratio(self._levels)
        while self._is_unfinished():
            if not self._ahead:
                self._ahead.append(self._advance(ratio))
            step = self._ahead[-1].reduced_depth / self._contact.reduced_depth
            excess = self._control.excess(self._contact, self._ahead[-1])
            if excess > 1 and step > self._control.min_ratio:
                divided = division(Level.of(self._contact), Level.of(self._ahead[-1]))
                self._ahead.keep(self._solver.advance_reduced(self._contact, divided))
                continue
            self._add(self._ahead.pop())
            ratio = self._control.next_ratio(step, excess)

    def _advance(self, ratio: float) -> ContactState:
        """Return the contact at a depth larger by a ratio, or at the largest force of the curve if that comes first."""
        contact, last_depth = self._contact, self._contact.reduced_depth
        # The curve lies above its tangent. At this depth the force therefore reaches the largest force of the
        # curve, or exceeds it by at least the rounding error of the contact.
        sufficient = (1 + ROUNDING) * self._until_pressure_sum
        sufficient_depth = last_depth + (sufficient - contact.pressure_sum) / contact.tangent_sum
        depth = max(min(last_depth * ratio, sufficient_depth), last_depth * self._control.min_ratio)
        if self._complete and depth * self._control.min_ratio >= self._complete.reduced_depth:
            return self._complete
        return self._advance_to(depth)
