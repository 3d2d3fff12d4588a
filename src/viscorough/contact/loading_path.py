"""Compute the elastic loading curve of a rigid indenter by boundary elements, level by level at increasing depths.

A level is a computed point of the curve; the curve is interpolated between the levels. The loading curve determines the
solution of the viscous problem for every force history (viscorough.viscous.kinetics).

While few elements are in contact, there is a level at every contact event, the depth at which the next element touches.
The curve is straight between events, so interpolation is exact. Later, levels are placed as the interpolation requires
(step_control).

A curve that reaches complete contact ends at the depth of complete contact, which is computed from two linear problems
(joined_surface). This depth cannot be found by following the curve: an element that overlaps the surface by less than
the tolerance need not join the contact, so the last elements might never join.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterable
from dataclasses import dataclass, replace
from itertools import accumulate, islice

import numpy as np
from numpy.typing import ArrayLike

from viscorough.basics.arrays import fraction, increasing, positive, real_number, real_numbers
from viscorough.basics.errors import AccuracyWarning
from viscorough.basics.types import Array, Progress
from viscorough.contact.argument_checks import check_solvable, warn_beyond_theory
from viscorough.contact.dense import ROUNDING
from viscorough.contact.free_edges import FreeEdges
from viscorough.contact.grid_error import every_nth_point, highest_missed, with_grid_errors
from viscorough.contact.options import DEFAULT, SolverOptions
from viscorough.contact.prescribed_depth import ContactSolver
from viscorough.contact.prescribed_force import ForceSearch
from viscorough.contact.state import ContactState, DenseContact
from viscorough.contact.step_control import ContactsAhead, Level, StepControl, division
from viscorough.results.loading_curve import LoadingCurve
from viscorough.surfaces.indenter import Indenter

# Below the contact fraction `start_fraction`, levels are far apart: each depth is this multiple of the previous depth.
_APPROACH_DEPTH_RATIO = 4.0
# The long steps in depth below `start_fraction` end when the contact fraction reaches this share of `start_fraction`.
_APPROACH_SHARE = 0.7
# Close to the contact fraction `start_fraction`, the long steps in depth become shorter. They end at the latest when
# the ratio of successive depths falls to this value.
_APPROACH_MIN_RATIO = 1.02
# A curve ends at most this contact fraction beyond `until_fraction`, unless more elements touch almost at once.
_OVERSHOOT = 0.02
# A few elements more may touch at once without a warning, for example the eight equal elements of a symmetric body.
_FEW_AT_ONCE = 8
# Near `until_fraction`, an interval of depth is divided at most so close to its ends, as a share of the interval.
_END_DIVISION = 0.2, 0.8
# The depth of complete contact is not computed for curves that end at or below this contact fraction.
_FAR_FROM_COMPLETE = 0.95
# If the grid error is estimated, the curve of all points takes about this share of the time, and the curve of every
# second point takes the rest.
_SHARE_OF_CURVE = 0.75
# The finished share of the computation is estimated as s to this power, where s is the share of the final contact count
# or of the final force that the curve has reached.
_PROGRESS_EXPONENT = 0.5


def indent(
    indenter: Indenter,
    *,
    forces: ArrayLike | None = None,
    depths: ArrayLike | None = None,
    start_fraction: float = 0.0,
    until_fraction: float = 0.9,
    until_force: float = np.inf,
    tolerance: float = 1e-3,
    estimate_grid_error: bool = False,
    progress: Progress | None = None,
    threads: int = 1,
    options: SolverOptions = DEFAULT,
) -> LoadingCurve:
    """Compute the loading curve of a rigid indenter in an incompressible elastic half-space, without friction.

    At increasing depths u, the pressure p and the deflection w of the surface satisfy::

        w = (1/4πG) ∫ p/r dA,   p ≥ 0,   w ≥ u − g,   p (w − u + g) = 0

    Here G is the shear modulus, g the initial gap of an element, and r the distance from the area element dA. The
    pressure is uniform on each rectangular element (Love 1929).

    Parameters
    ----------
    indenter : Indenter
        Indenter with two-dimensional heights.
    forces : array_like, optional
        Forces F/G of the levels, increasing [length²]; not together with depths.
    depths : array_like, optional
        Depths of the levels, increasing [length]. By default levels are placed as the tolerance requires.
    start_fraction : float, optional
        Smallest contact fraction that is of interest, below `until_fraction`. At smaller fractions the curve has only a
        few levels, and the error of interpolation between them may exceed the tolerance. Ignored if depths or forces
        are given.
    until_fraction : float, optional
        Contact fraction at the end of the curve, in (0, 1]; ignored if depths or forces are given. The curve ends at
        most 0.02 beyond it, unless more elements touch almost at once, which a warning states.
    until_force : float, optional
        Largest F/G of the curve [length²]; ignored if depths or forces are given. A compressible half-space with
        Young's modulus E and Poisson ratio ν has G = E/(1 − ν²)/4.
    tolerance : float, optional
        Accuracy of every level, between 1e-12 and 0.1. It bounds the gap in contact and the overlap outside the
        contact, each divided by the depth, with rounding included. The relative error of the force is far smaller; the
        stiffness is less accurate (docs/solver.md). If neither depths nor forces are given, the tolerance (but at least
        1e-5) also bounds the relative error of the depth that LoadingCurve.at_force interpolates between levels. The
        error of the grid is not included and is often larger (see `estimate_grid_error`).
    estimate_grid_error : bool, optional
        Estimate the error due to the spacing of the map from a second curve on every second point; the result contains
        it as `grid_error`. The second curve takes 0.2 to 0.6 times as long as the first.
    progress : Progress, optional
        Function that is called after each level with the estimated finished share of the computation, up to 1.
    threads : int, optional
        Number of threads; it does not change the result. Use several for large maps.
    options : SolverOptions, optional
        Details of the iterations, such as their precision; change them only to measure their effect.

    Returns
    -------
    LoadingCurve
        Curve with the given depths or forces. If neither is given, the curve ends at the first level at or beyond
        `until_fraction` or `until_force`, or at the depth of complete contact, beyond which the curve is straight. If
        all heights of the indenter are equal, the curve is then a straight line from the origin, with a single level at
        the depth √(dx dy), where dx and dy are the spacings of the map.

    Raises
    ------
    ValueError
        For arguments out of range; for maps of fewer than 3 x 3 points if the error of the grid is needed.
    ConvergenceError
        If a level cannot be solved to the tolerance.

    Warns
    -----
    AccuracyWarning
        If the depth is larger than the map is wide, if more elements touch at the end than `until_fraction` allows, or
        if the border of a map from a file carries more than 5 % of the force while less than 30 % of its elements
        touch. The map then acts as a punch with free edges, and not as a part of a larger surface.

    Examples
    --------
    >>> import viscorough
    >>> disc = viscorough.self_affine_disc(0.7, 17, rms=0.01, seed=1)
    >>> curve = viscorough.indent(disc, depths=[0.005, 0.01])
    >>> curve.depth.tolist(), bool(curve.force[0] < curve.force[1])
    ([0.005, 0.01], True)
    """
    tolerance = check_solvable("indent", indenter, tolerance, threads, options)
    if depths is not None and forces is not None:
        raise ValueError("indent: depths and forces exclude each other; one of them is allowed")
    start_fraction, until_fraction = _check_fractions(start_fraction, until_fraction)
    request = _CurveRequest(
        start_fraction=start_fraction,
        until_fraction=until_fraction,
        until_force=_check_until_force(until_force),
        depths=_check_levels("argument depths", depths),
        forces=_check_levels("argument forces", forces),
        threads=threads,
        options=options,
    )
    progress = progress or (lambda done: None)
    if estimate_grid_error:
        curve = _curve_with_grid_errors(request, indenter, tolerance, progress)
    else:
        curve = _curve(request, indenter, tolerance, progress)
    warn_beyond_theory(indenter, curve.depth[-1])
    if depths is None and forces is None:
        _warn_of_end(curve, until_fraction)
    return curve


def _warn_of_end(curve: LoadingCurve, until_fraction: float) -> None:
    """Give an AccuracyWarning if a curve ends far beyond a contact fraction, unless all elements touch at once."""
    few = np.ceil(until_fraction * curve.elements) + max(_OVERSHOOT * curve.elements, _FEW_AT_ONCE)
    if curve.contact_count[-1] > few and curve.contact_count[0] < curve.elements:
        reached, asked = f"{curve.contact_fraction[-1]:.3g}", f"argument until_fraction {until_fraction:g}"
        text = f"the curve ends at a contact fraction of {reached}, beyond {asked}"
        text += "; too many elements touch between its last two levels"
        warnings.warn(text, AccuracyWarning, stacklevel=3)


@dataclass(frozen=True)
class _CurveRequest:
    """Arguments of `indent` after they were checked and converted to numbers.

    start_fraction, until_fraction : range of contact fractions
    until_force : largest F/G of the curve [length²]
    depths : depths of the levels [length], or None
    forces : forces F/G of the levels [length²], or None. Depths and forces are never both given. If either is given,
        the contact fractions and `until_force` are ignored
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
    """Return both contact fractions as floats. Raises ValueError if either is out of range."""
    until_fraction = fraction("argument until_fraction", until_fraction)
    start_fraction = real_number("argument start_fraction", start_fraction)
    if not 0 <= start_fraction < until_fraction:
        raise ValueError(f"indent: start_fraction must be from 0 to below until_fraction, not {start_fraction!r}")
    return start_fraction, until_fraction


def _check_until_force(until_force: float) -> float:
    """Return the largest force F/G of a curve [length²], which may be infinite. Raises ValueError unless above 0."""
    return np.inf if until_force == np.inf else positive("argument until_force", until_force)


def _check_levels(name: str, values: ArrayLike | None) -> Array | None:
    """Return the given depths or forces of the levels. Raises ValueError unless they are positive and increase."""
    return None if values is None else increasing(name, np.atleast_1d(real_numbers(name, values)), above_zero=True)


def _curve_with_grid_errors(
    request: _CurveRequest, indenter: Indenter, tolerance: float, progress: Progress
) -> LoadingCurve:
    """Return the LoadingCurve of a map with the errors of its grid, estimated from the curve of every second point."""
    curve = _curve(request, indenter, tolerance, part_of(progress, 0.0, _SHARE_OF_CURVE))
    coarse, rest = every_nth_point(indenter, 2), part_of(progress, _SHARE_OF_CURVE, 1.0)
    whole = replace(request, depths=None, forces=None, until_fraction=1.0, until_force=curve.force[-1])
    second = _curve(whole, coarse, tolerance, rest)
    return with_grid_errors(curve, second, indenter, highest_missed(indenter, coarse))


def part_of(progress: Progress, start: float, end: float) -> Progress:
    """Return a function that reports the progress of a part of a computation.

    The returned function takes the finished share of the part, from 0 to 1.

    progress : function that takes the finished share of the whole computation
    start, end : shares of the whole computation that are finished at the start and at the end of the part
    """
    return lambda done: progress(float(start + done * (end - start)))


def _curve(request: _CurveRequest, indenter: Indenter, tolerance: float, progress: Progress) -> LoadingCurve:
    """Compute the LoadingCurve of a map to a tolerance."""
    depths, forces, options, threads = request.depths, request.forces, request.options, request.threads
    if depths is not None:
        solver = ContactSolver(indenter, tolerance, options, threads, largest_depth=depths[-1], whole=False)
        edges, contacts = FreeEdges(solver), accumulate(depths, solver.advance, initial=solver.unloaded_state())
        levels = _levels(islice(contacts, 1, None), len(depths), edges, progress)
    elif forces is not None:
        # Contacts are solved to half of the tolerance. The other half is left for the correction of each contact to
        # exactly the given force.
        solver = ContactSolver(indenter, tolerance / 2, options, threads, whole=False)
        edges = FreeEdges(solver)
        levels = _levels(map(ForceSearch(solver).contact_at, forces), len(forces), edges, progress)
    else:
        solver = ContactSolver(indenter, tolerance, options, threads)
        edges = FreeEdges(solver)
        path = _LoadingPath(solver, request.until_fraction, request.until_force, edges, progress)
        levels = path.levels_from(request.start_fraction)
    depth = solver.units.length * np.array([level.depth for level in levels])
    force = solver.units.force * np.array([level.pressure_sum for level in levels])
    if not np.isfinite(force).all():
        raise ValueError("indent: forces are too large to represent; a larger unit of length is needed")
    edges.warn()
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
    """Raise ValueError if given depths or forces are so close together that the computed quantity does not increase.

    given : depths or forces of the levels as the user has given them, or None
    found : computed forces (for given depths) or computed depths (for given forces)
    name, other : names of the given and of the computed quantity, "depths" or "forces"
    """
    if given is not None and (closer := np.diff(found) <= 0).any():
        level, values = int(np.argmax(closer)), np.asarray(given)
        pair = f"{values[level]:.17g} and {values[level + 1]:.17g} are closer than the accuracy"
        text = f"argument {name}: {pair}, so that {other} do not increase"
        raise ValueError(f"{text}; fewer levels or a smaller tolerance are needed")


def _levels(contacts: Iterable[ContactState], number: int, edges: FreeEdges, progress: Progress) -> list[Level]:
    """Return the levels of contacts, and report progress after each contact.

    contacts : solved contacts, or an iterator that solves each contact when it is read
    number : number of contacts
    edges : FreeEdges that looks at each contact
    """
    levels = []
    for contact in contacts:
        edges.see(contact)
        levels.append(Level.of(contact))
        progress(len(levels) / number)
    return levels


class _LoadingPath:
    """Computation of the levels (points) of a loading curve, from first contact up to a contact fraction or force.

    The class works in the reduced units of contact.state.

    solver : ContactSolver of the indenter
    until_fraction : largest contact fraction of the curve
    until_force : largest F/G of the curve [length²]
    edges : FreeEdges that looks at each contact
    progress : function that is called with the finished share of the computation
    """

    def __init__(
        self,
        solver: ContactSolver,
        until_fraction: float,
        until_force: float,
        edges: FreeEdges,
        progress: Progress,
    ) -> None:
        self._solver, self._edges, self._progress = solver, edges, progress
        self._control = StepControl(solver.tolerance, solver.threads)
        self._until_count = until_fraction * solver.elements.count
        self._allowed_overshoot = max(_OVERSHOOT * solver.elements.count, 1.0)
        # Contact at the depth of complete contact; computed only when a solved contact may have reached this depth.
        self._complete: ContactState | None = None
        # The limit is slightly above `until_force`, so that rounding does not leave the last level below `until_force`.
        self._until_pressure_sum = (1 + ROUNDING / 2) * until_force / solver.units.force
        self._contact = solver.first_contact()
        self._levels = [Level.of(self._contact)]
        self._ahead = ContactsAhead()

    def levels_from(self, start_fraction: float) -> list[Level]:
        """Return the levels of the whole curve, with only a few levels below the contact fraction `start_fraction`."""
        self._approach(start_fraction * self._solver.elements.count)
        self._follow_events()
        self._step_to_the_end()
        return self._levels

    def _is_unfinished(self) -> bool:
        contact, every = self._contact, self._solver.elements.count
        if contact.pressure_sum >= self._until_pressure_sum or contact is self._complete or self._solver.is_flat:
            return False
        if contact.count < every or isinstance(contact, DenseContact):
            # A DenseContact was solved directly, with a dense matrix, so its number of elements in contact is exact.
            return contact.count < self._until_count
        # All elements are in contact on the grid, but contact need not be complete yet. Gaps on the grid are accurate
        # only to the tolerance, so elements may join slightly too early.
        return self._until_count > every - 1

    def _advance_to(self, depth: float) -> ContactState:
        """Return the contact at `depth`, or at the depth of complete contact if this depth is smaller than `depth`.

        The depth of complete contact is computed as soon as a contact may lie beyond it, unless the curve ends with
        this contact.
        """
        if self._complete is None:
            contact = self._solver.advance_reduced(self._contact, depth)
            every = self._solver.elements.count
            far = self._until_count <= _FAR_FROM_COMPLETE * every
            is_last = far and contact.count >= self._until_count
            is_last = is_last or (contact.count < every and contact.pressure_sum >= self._until_pressure_sum)
            if is_last or not self._solver.may_be_complete(contact):
                return contact
            self._complete = self._solver.solve_complete_contact()
            # If the contact is almost at the depth of complete contact, return the complete contact instead. Rounding
            # and residuals could otherwise put these two contacts in the wrong order.
            is_before = depth * self._control.min_ratio < self._complete.reduced_depth
            return contact if is_before else self._complete
        if depth >= self._complete.reduced_depth:
            return self._complete
        return self._solver.advance_reduced(self._contact, depth)

    def _add(self, contact: ContactState) -> None:
        self._contact = contact
        self._edges.see(contact)
        self._levels.append(Level.of(contact))
        done = max(contact.count / self._until_count, contact.pressure_sum / self._until_pressure_sum)
        self._progress(min(done, 1.0) ** _PROGRESS_EXPONENT)

    def _approach(self, start_count: float) -> None:
        """Take long steps in depth towards the contact count `start_count`, and shorter steps close to this count."""
        ratio, most = _APPROACH_DEPTH_RATIO, _APPROACH_SHARE * start_count
        while self._is_unfinished() and self._contact.count < most and ratio > _APPROACH_MIN_RATIO:
            contact = self._advance_to(self._contact.reduced_depth * ratio)
            # A contact beyond `start_count` is kept for later. It is not the next level, because levels near
            # `start_count` must be close together.
            if contact.count >= start_count or contact.pressure_sum > self._until_pressure_sum:
                self._ahead.keep(contact)
            else:
                self._add(contact)
            # On a logarithmic scale of depth, let the next step go half of the way to the nearest larger depth that has
            # been solved.
            if self._ahead:
                ratio = (self._ahead[-1].reduced_depth / self._contact.reduced_depth) ** 0.5

    def _follow_events(self) -> None:
        """Add a level at every contact event (depth at which an element touches), while few elements are in contact.

        Nothing is added once a contact was solved by iteration on the grid. Only contacts that are solved with a dense
        matrix are exact enough to find contact events.
        """
        contact = self._contact
        if not self._is_unfinished() or not isinstance(contact, DenseContact) or contact.count >= self._control.events:
            return
        most = min(self._control.events, int(np.ceil(self._until_count)))
        events, self._contact, _ = self._solver.follow_events(contact, most, self._until_pressure_sum)
        if events.depth.size and events.depth[0] <= contact.reduced_depth * (1 + ROUNDING):
            # Remove the last level: the first contact event has the same depth, but more elements in contact.
            self._levels.pop()
        self._edges.see(self._contact)
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
            elif self._is_beyond_the_end(self._ahead[-1], step):
                divided = self._depth_of_end(self._ahead[-1])
            else:
                self._add(self._ahead.pop())
                ratio = self._control.next_ratio(step, excess)
                continue
            self._ahead.keep(self._solver.advance_reduced(self._contact, divided))

    def _is_beyond_the_end(self, contact: ContactState, ratio: float) -> bool:
        """Return True if a contact has so many elements in contact that the curve must end before it.

        Levels that are closer than the step control allows are not accurate enough to have increasing stiffness.

        ratio : depth of the contact divided by the current depth
        """
        return contact.count > self._until_count + self._allowed_overshoot and ratio > self._control.min_ratio

    def _depth_of_end(self, contact: ContactState) -> float:
        """Return a depth at which the curve may end, between the current contact and a contact beyond the end."""
        target = self._until_count + 0.5 * self._allowed_overshoot
        share = np.clip((target - self._contact.count) / (contact.count - self._contact.count), *_END_DIVISION)
        return float(self._contact.reduced_depth * (contact.reduced_depth / self._contact.reduced_depth) ** share)

    def _advance(self, ratio: float) -> ContactState:
        """Return the contact at `ratio` times the current depth, or at a smaller depth that ends the curve.

        The curve ends at its largest force, or at the depth of complete contact.
        """
        contact, last_depth = self._contact, self._contact.reduced_depth
        # The tangent reaches the largest force of the curve at `sufficient_depth`. The curve lies above its tangent, so
        # its force at this depth is at least as large. The factor is a margin for rounding.
        sufficient = (1 + ROUNDING) * self._until_pressure_sum
        sufficient_depth = last_depth + (sufficient - contact.pressure_sum) / contact.tangent_sum
        depth = max(min(last_depth * ratio, sufficient_depth), last_depth * self._control.min_ratio)
        if self._complete and depth * self._control.min_ratio >= self._complete.reduced_depth:
            return self._complete
        return self._advance_to(depth)
