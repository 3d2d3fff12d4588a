"""Motion of an indenter in any linear viscoelastic half-space under any history, from its loading curve.

As long as the contact only grows, the correspondence with the elastic problem holds (Lee and Radok 1960). With the
creep compliance J of the medium and the creep response Φ(t) = ∫J(t − s) dF(s), depth and velocity are

    u(t) = u_el(F/G = Φ(t)),    v(t) = Φ'(t)/(k/G),

where u_el(F/G) and k/G are depth and stiffness of the loading curve. In a viscous medium Φ = ∫F dt/η (paper, Eqs. 1 to
3). Eqs. 7 to 9 of the paper contain an additional factor 1/Γ(2−α), because they apply a Laplace transform to the
relation u(F/G), which is not linear.

For every other history, the loading curve is replaced by an equivalent row of unilateral springs (docs/theory.md):

1. The module `springs` computes the gaps and stiffnesses of the springs from the curve.
2. If the medium consists of springs and dashpots, the module `unilateral` computes the motion of the springs exactly. A
   springpot is replaced by springs and dashpots that have the same creep within 1e-10, from a millionth of the shortest
   interval between two turns of the history (changes of its slope) up to its whole duration. In every other medium, the
   module `unilateral_sums` computes the motion by steps in time.
3. At times when the contact is as large as ever before, depth and velocity follow from Φ and the interpolated curve.
   They then have no error from the finite number of springs.
"""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from viscorough.basics import units
from viscorough.basics.argument_names import argument, caller, spelled
from viscorough.basics.arrays import increasing
from viscorough.basics.errors import AccuracyWarning, ConvergenceError
from viscorough.basics.types import Array, Integers
from viscorough.media.creep_response import creep_response
from viscorough.media.kinds import Springpot, medium_of
from viscorough.media.load import Load
from viscorough.media.medium import Medium
from viscorough.media.spectra import power_law_spectrum, relaxation_spectrum, spectrum_of, zero_of_increasing
from viscorough.results.loading_curve import LoadingCurve, check_curve
from viscorough.results.motion import Motion
from viscorough.viscous.springs import ROUNDING, RowOfSprings, row_of_springs
from viscorough.viscous.unilateral import BEYOND, INFINITE, RESTLESS, RowMotion, move_row
from viscorough.viscous.unilateral_sums import move_row_by_sums

# Time that counts as infinite: the end of the creep is searched for only before this time.
_LATEST = 1e300
# Number of default output times under a constant force. They begin when the creep response F J(t) reaches the first
# level (computed point) of the curve, and end when it reaches the last level. If the response is above the first level
# from time 0 on, or always below the last level, the times begin or end when the response differs from its first or
# last value by the share _EARLY of its range.
_SPREAD, _EARLY = 100, 1e-3
# A springpot is replaced by springs and dashpots. They creep like the springpot only at times longer than this share of
# the shortest interval between two turns of the history (changes of its slope).
_SHORTEST = 1e-6
# Two slopes of a history count as equal if their relative difference is at most _SAME_SLOPE. If a sample follows a turn
# of the history after a time t, `_shortest_interval` returns at most _CLOSE · t.
_SAME_SLOPE, _CLOSE = 1e-6, 10.0
# A motion that depends on the unknown curve before its first level (computed point) gives a warning if the force at
# this level is more than this share of the largest elastic force.
_UNKNOWN_SHARE = 1e-2
# The springs that replace the contact have exactly the force of the loading curve at up to this number of depths, at
# which the history turns.
_MOST_TURNS = 200


def kinetics(
    curve: LoadingCurve,
    force: ArrayLike | Load | None = None,
    medium: Medium | float | str | None = None,
    times: ArrayLike | None = None,
    *,
    depth: ArrayLike | Load | None = None,
) -> Motion:
    """Compute the motion of an indenter with the given loading curve in a linear viscoelastic half-space.

    The history may load, hold, unload and reload. The motion is exact for the row of springs that is equivalent to the
    curve. So it does not depend on how densely the history is sampled.

    Parameters
    ----------
    curve : LoadingCurve
        Loading curve of the indenter.
    force, depth : array_like or Load, optional
        Prescribed load: either a force or a depth. It is a constant that is applied at time 0; or samples at `times`,
        linear in between, with a time given twice for a step; or a Load, whose samples may be at other times than
        `times`. Before the first sample there is no load. Forces are F ≥ 0, in N, and depths are in the curve's unit of
        length. If this unit is known, both may also have a unit (a text such as "5 mN", or a quantity of pint). A
        negative depth lifts the indenter above the plane of first contact. In a medium without an instantaneous
        response (Newtonian, Kelvin-Voigt, Springpot), a first depth above 0 would need an infinite force. If it does
        not exceed the largest rise from a sample to the next, it is taken to be noise: the depth then rises from 0 to
        the first sample, within a time equal to the interval between the first two samples.
    medium : Medium or float or str
        Medium, such as viscorough.Maxwell, or the viscosity η > 0 of a Newtonian medium. If the curve's unit of length
        is known, moduli, times and viscosities are in Pa, s and Pa s, and a text such as "2 kPa s" is allowed.
        Otherwise units must be such that F·t/η, or F divided by a modulus, is a length².
    times : array_like, optional
        Increasing times of the output, in s or with a unit; 0 or later for a constant load. The default for a Load is
        the times of its samples. The default for a constant force is a hundred times with equal ratios, while the creep
        goes from the first to the last level (computed point) of the curve, or until it has almost ended. If the medium
        responds elastically at time 0, time 0 precedes them.

    Returns
    -------
    Motion
        Motion at `times`. Force and velocity are the limits just after each time. At the last time of a history, and at
        the first of two equal times (a step), they are the limits just before it. At a step of the force, the velocity
        is due to the creep alone. In a Springpot this velocity is infinite, and so is the force at a step of the depth
        into the surface. Under no force the depth is not unique, and by convention the indenter rests on the recovering
        surface. Before the first level of the curve, depths under a force and forces at a depth are nan, unless the
        curve is a straight line there.

    Raises
    ------
    ValueError
        For values outside these ranges, for a contact beyond the last level of the curve, and for a step of the depth
        into the surface of a Newtonian or Kelvin-Voigt medium, which needs an infinite force.

    Warns
    -----
    AccuracyWarning
        If the motion depends on the curve before its first level, where the curve is taken to be a power law. Also if
        steps in time do not reach the tolerance; they are used for media that neither consist of springs and dashpots
        nor are a Springpot.

    Examples
    --------
    >>> import viscorough
    >>> disc = viscorough.self_affine_disc(0.7, 17, rms=0.01, seed=1)
    >>> curve = viscorough.indent(disc)
    >>> motion = viscorough.kinetics(curve, force=1.0, medium=30.0, times=[0.5, 1.0])
    >>> bool(motion.depth[0] < motion.depth[1]), bool(motion.velocity[0] > motion.velocity[1])
    (True, True)
    >>> solid = viscorough.StandardLinearSolid(4.0, 1.0, 0.5)
    >>> ramp = viscorough.Load([0.0, 1.0, 2.0], depth=[0.0, 0.01, 0.0])
    >>> viscorough.kinetics(curve, depth=ramp, medium=solid, times=[1.0, 1.1, 2.0]).force.round(4)
    array([0.0145, 0.0088, 0.    ])
    """
    check_curve("kinetics", curve)
    medium = medium_of(medium, curve.length_unit)  # type: ignore[arg-type]  # None is refused
    load, place = _load_and_places(curve, medium, force, depth, times)
    if (duration := load.time[-1] - load.time[0]) > medium.last_time:
        name = _load_name("depth" if load.by_depth else "force") if times is None else argument("times")
        allowed = f"allowed: up to the last time of the table, {medium.last_time:g}"
        raise ValueError(f"{name}: up to {duration:g} after the beginning of the load; {allowed}")
    if load.by_depth:
        _check_depths(curve, load.values[: place[-1] + 1])
    creep = None
    if not load.by_depth and medium.retardation is None:
        creep = creep_response(medium, load)
    if creep is not None and not creep.receding_from < load.time[-1]:
        row, needed = row_of_springs(curve), slice(int(place[-1]) + 1)
        _check_creep(curve, row, load.time[needed], creep.creep[needed])
        _check_overflow(load, creep.creep[needed])
        moved = _growing(curve, row, load, creep.creep)
    else:
        row, moved = row_motion(curve, medium, load, int(place[-1]))
    _warn_of_the_beginning(curve, row, load, moved)
    values = _without_discretisation(curve, medium, row, load, moved, creep)
    if medium.retardation is None and not medium.creep_compliance(0.0) > 0:
        _at_steps_of_soft_media(medium, load, *values)
    depths, forces, velocity, fraction = (each[place] for each in values)
    forces = forces * units.square_metres(curve.length_unit)
    receding_from = _receding_from(medium, load) if creep is None else creep.receding_from
    if receding_from >= load.time[place[-1]]:
        receding_from = np.nan
    return Motion(load.time[place], depths, forces, velocity, fraction, curve.length_unit, float(receding_from))


def row_motion(curve: LoadingCurve, medium: Medium, load: Load, last: int = -1) -> tuple[RowOfSprings, RowMotion]:
    """Return the row of springs that has the force of a curve, and its motion under a load in consistent units.

    last : index of the last sample of the load at which the motion is needed

    Raises ValueError if the motion ends before this sample.
    """
    row, spectra = row_of_springs(curve, _turning_depths(load)), _spectra(medium, load)
    if spectra is None:
        moved = move_row_by_sums(row, medium, load)
        ended, until = BEYOND, float(load.time[np.argmax(np.isnan(moved.depth))])
    else:
        law = spectrum_of(*spectra)
        row_and_law = row.gap, row.stiffness, row.limit, law
        moved, ended, until = move_row(*row_and_law, load.time, load.values, by_depth=load.by_depth)
    if ended == RESTLESS and np.isfinite(moved.depth[~np.isnan(moved.depth)]).all():
        raise ConvergenceError(f"kinetics: the contact does not settle at time {until:g}; other samples may help")
    if ended not in (BEYOND, INFINITE):
        _check_overflow(load, moved.depth[last] + moved.force[last])
    if np.isnan(moved.depth[last]):
        _refuse(curve, row, medium, load, ended, until)
    return row, moved


def _load_name(quantity: str) -> str:
    """Return the name of the argument that prescribes the load, for messages.

    In Python the name is "force" or "depth"; on the command line it is the corresponding option.

    quantity : "force" or "depth"
    """
    return spelled({"force": "--force or --force-history", "depth": "--depth-history"}[quantity], quantity)


def _check_overflow(load: Load, values: ArrayLike) -> None:
    """Raise ValueError unless all values are finite.

    load : load under which the values were computed, for the message
    """
    if not np.isfinite(values).all():
        kind = "depth" if load.by_depth else "force"
        raise ValueError(
            f"{_load_name(kind)}: depths or forces overflow in this medium; allowed: forces, depths and moduli whose "
            "ratios are ordinary numbers; check their units"
        )


def _turning_depths(load: Load) -> Array:
    """Return the depths at which a prescribed depth turns, steps or is held; at most the _MOST_TURNS deepest of them.

    For a prescribed force, the array is empty.
    """
    if not load.by_depth:
        return np.array([])
    moves = np.sign(np.diff(load.values, prepend=0.0))
    turns = np.append(moves[:-1] * moves[1:] <= 0, True) | (np.diff(load.time, append=np.inf) == 0)
    return np.unique(load.values[turns])[-_MOST_TURNS:]


def _receding_from(medium: Medium, load: Load) -> float:
    """Return the first time from which the contact recedes; nan if it never does.

    Under a force, the contact recedes when the creep response decreases. Under a prescribed depth, it recedes when a
    depth above zero decreases.
    """
    if not load.by_depth:
        return creep_response(medium, load).receding_from
    falls = (np.diff(load.values) < 0) & (load.values[:-1] > 0)
    return float(load.time[np.argmax(falls)]) if falls.any() else np.nan


def _load_and_places(curve: LoadingCurve, medium: Medium, force: Any, depth: Any, times: Any) -> tuple[Load, Integers]:
    """Return the load in consistent units, with samples added at the output times, and the indices of these samples.

    The load ends at the first sample after the last output time. The arguments are explained in `kinetics`.
    """
    unit = curve.length_unit
    if isinstance(force, Load) and depth is None and force.by_depth:
        force, depth = None, force
    if (force is None) == (depth is None):
        raise ValueError("kinetics: one of force and depth is needed")
    name, value = ("depth", depth) if force is None else ("force", force)
    if times is not None:
        times = units.numbers(times, "s", unit, "times")
    constant = False
    if isinstance(value, Load):
        if value.by_depth != (name == "depth"):
            raise ValueError(
                f"kinetics: {name}: a Load that prescribes the other quantity; {name}=Load(..., {name}=...)"
            )
        load = value.in_units_of(unit)
    else:
        values = units.numbers(value, "N" if name == "force" else unit, unit, name)
        if values.ndim:
            if times is None:
                raise ValueError(f"times: missing; a {name} given as samples needs the time of each sample")
            load, times = Load(times, **{name: values}).in_units_of(unit), None
        else:
            constant = True
            load, times = _constant(curve, medium, name, float(values), times)
    first, samples = 0, load.time.size
    if load.by_depth and not constant and not medium.creep_compliance(0.0) > 0:
        load = load.with_first_ramp()
        first = load.time.size - samples
    if times is None:
        return load, np.arange(first, load.time.size)
    load, place = load.with_times(times)
    kept = slice(None, int(place[-1]) + 2)
    return Load(load.time[kept], **{name: load.values[kept]}), place


def _constant(curve: LoadingCurve, medium: Medium, name: str, value: float, times: Any) -> tuple[Load, Array]:
    """Return a constant load from time 0 on as a Load in consistent units, and the output times.

    name, value : "force" or "depth", and the value of the constant
    times : output times, or None for the default times
    """
    if not np.isfinite(value) or (name == "force" and value <= 0):
        raise ValueError(f"constant {name}: {value}; allowed: a finite number{' above 0' if name == 'force' else ''}")
    if name == "force":
        value /= units.square_metres(curve.length_unit)
    elif times is None:
        raise ValueError("times: missing; a constant depth needs the times of the output")
    times = _spread_times(curve, value, medium) if times is None else increasing("times", times)
    if times[0] < 0:
        raise ValueError(
            f"{argument('times')}: start at {times[0]:g}; allowed: from 0 on, where a constant {name} begins"
        )
    if times[-1] > medium.last_time:
        allowed = f"allowed: up to the last time of the table, {medium.last_time:g}"
        raise ValueError(f"{argument('times')}: up to {times[-1]:g}; {allowed}")
    samples = np.unique([0.0, times[-1]])
    return Load(samples, **{name: np.full(samples.size, value)}), times


def _spread_times(curve: LoadingCurve, force: float, medium: Medium) -> Array:
    """Return the default output times under a constant force, which have equal ratios.

    The first time is about the time when the creep reaches the first level (computed point) of the curve. The last is
    about the time when the creep reaches the last level or has almost ended. If the medium responds elastically at time
    0, time 0 precedes them.
    """
    limit = min(medium.last_time, _LATEST)
    with np.errstate(over="ignore"):
        at_once, at_last = force * medium.creep_compliance(np.array([0.0, limit]))
    first, last = curve.force[0] if curve.force.size > 1 else _EARLY * curve.force[-1], curve.force[-1]
    if not (at_once < last and at_last > first):
        raise ValueError(
            f"{argument('times')}: missing, and the creep is from F/G {at_once:.6g}, at once, to {at_last:.6g}, in the "
            f"end, beside the curve, from {first:.6g} to {last:.6g}; times or another force are needed"
        )
    start = first if at_once < first else at_once + _EARLY * (min(last, at_last) - at_once)
    end = last if at_last >= last else at_last - _EARLY * (at_last - max(first, at_once))
    target = np.array([start, end]) / force
    with np.errstate(all="ignore"):
        ends = zero_of_increasing(lambda t: medium.creep_compliance(t) - target, np.finfo(float).tiny, limit)
    if not (0 < ends[0] < ends[1] < _LATEST / 2):
        raise ValueError(f"the times from {ends[0]:g} to {ends[1]:g} overflow; closer force and medium are allowed")
    times = np.geomspace(ends[0], ends[1], _SPREAD)
    springs = at_once > 0 and np.isfinite(curve.at_force(at_once)).all()
    return np.append(0.0, times) if springs else times


def _spectra(medium: Medium, load: Load) -> Any:
    """Return the relaxation and the retardation spectrum of a medium; None if it has no such spectra.

    The spectra of a Springpot are those of the springs and dashpots that replace it under this load.
    """
    if medium.relaxation is not None:
        return medium.relaxation, medium.retardation
    if not isinstance(medium, Springpot):
        return None
    duration = load.time[-1] - load.time[0]
    if duration == 0:
        return None
    shortest = _SHORTEST * _shortest_interval(load)
    retardation = power_law_spectrum(medium.modulus, medium.exponent, shortest, duration)
    return relaxation_spectrum(retardation), retardation


def _shortest_interval(load: Load) -> float:
    """Return the shortest interval between two successive turns of a history.

    At a turn, the slope of the history changes, or a step begins or ends. A sample soon after any turn also limits the
    result: the result is at most _CLOSE times the time from the turn to the sample.
    """
    time, values = load.time, load.values
    lengths = np.diff(time)
    # The slope is nan at a step of the load.
    slopes = np.divide(np.diff(values), lengths, out=np.full(lengths.size, np.nan), where=lengths > 0)
    differ = ~(np.abs(np.diff(slopes)) <= _SAME_SLOPE * np.maximum(np.abs(slopes[1:]), np.abs(slopes[:-1])))
    turns = np.concatenate([[True], differ, [True]])
    latest = time[np.maximum.accumulate(np.where(turns, np.arange(time.size), 0))]
    between, since = np.diff(time[turns]), time - latest
    return float(min(between[between > 0].min(), _CLOSE * since[since > 0].min(initial=np.inf)))


def _check_depths(curve: LoadingCurve, depths: Array) -> None:
    """Raise ValueError if a depth exceeds the last depth of a curve that ends before complete contact."""
    last = curve.depth[-1]
    if depths.max() > last * (1 + ROUNDING) and curve.contact_count[-1] < curve.elements:
        raise ValueError(
            f"{_load_name('depth')}: {depths.max():g} is beyond the curve's last level; allowed: up to {last:g}; "
            f"indent further, with {argument('until_fraction', 1)} or a level at that depth ({argument('depths')})"
        )


def _check_creep(curve: LoadingCurve, row: RowOfSprings, times: Array, creep: Array) -> None:
    """Raise ValueError if the creep response exceeds the last force of a curve that ends before complete contact."""
    beyond = ~(creep <= curve.force[-1] * (1 + ROUNDING))
    if beyond.any() and np.isfinite(row.limit):
        where, enough = int(np.argmax(beyond)), 1.01 * creep[np.isfinite(creep)].max()
        raise ValueError(
            f"{_load_name('force')}: at time {times[where]:g} the creep ∫J dF is {creep[where]:.6g}, beyond the "
            f"curve's last level; allowed: up to {curve.force[-1]:.6g}; indent further, with "
            f"{argument('until_fraction', 1)} or a level at F/G = {enough:.3g} ({argument('forces')})"
        )


def _refuse(curve: LoadingCurve, row: RowOfSprings, medium: Medium, load: Load, ended: int, until: float) -> None:
    """Raise the ValueError that states why a motion ended early.

    ended : how the motion ended: BEYOND or INFINITE
    until : when the motion ended
    """
    if ended == INFINITE:
        raise ValueError(
            f"{_load_name('depth')}: steps into the surface at time {until:g}, which takes an infinite force here; "
            "allowed: ramps"
        )
    if not load.by_depth:
        _check_creep(curve, row, load.time, creep_response(medium, load).creep)
    raise ValueError(
        f"{_load_name('depth' if load.by_depth else 'force')}: at time {until:g} the contact grows beyond the curve's "
        f"last level; allowed: depths up to {curve.depth[-1]:g}; indent further, with {argument('until_fraction', 1)}"
    )


def _growing(curve: LoadingCurve, row: RowOfSprings, load: Load, creep: Array) -> RowMotion:
    """Return the motion of a row of springs whose contact only grows, from the creep response at each sample."""
    depth = _at_elastic_force(curve, row, creep)[0]
    in_contact = np.searchsorted(row.gap, np.nan_to_num(depth), side="left")
    nothing = np.zeros(load.time.size)
    always = np.ones(load.time.size, bool)
    return RowMotion(depth, load.values, nothing, in_contact, creep, always, np.nan, nothing, nothing)


def _at_elastic_force(curve: LoadingCurve, row: RowOfSprings, creep: Array) -> tuple[Array, Array]:
    """Return depth and stiffness k/G of the loading curve at the force F/G = `creep`.

    After complete contact, the depth continues along the tangent of the last level (computed point).

    creep : creep response Φ
    """
    first, last = curve.force[0], curve.force[-1]
    # Rounding must not move a force at the first or last computed point out of the range of the curve.
    inside = np.where(np.abs(creep - first) <= ROUNDING * first, first, np.clip(creep, 0.0, last))
    depth, stiffness = curve.at_force(inside)
    beyond = creep > last * (1 + ROUNDING)
    return np.where(beyond, depth + (creep - last) / row.stiffness.sum(), depth), stiffness


def _without_discretisation(
    curve: LoadingCurve, medium: Medium, row: RowOfSprings, load: Load, moved: RowMotion, creep: Any
) -> tuple[Array, Array, Array, Array]:
    """Return depth, force, velocity and contact fraction at the samples of the load.

    While the contact is as large as ever before, these values follow from the interpolated curve. Otherwise they follow
    from the motion `moved` of the row of springs.

    creep : CreepResponse if a force acts on a medium that does not consist of springs and dashpots; otherwise None
    """
    depth, force, velocity = moved.depth.copy(), moved.force.copy(), moved.velocity.copy()
    count = moved.in_contact
    front = np.where(count > 0, row.gap[np.maximum(count, 1) - 1], 0.0)
    if load.by_depth:
        front = np.where(moved.largest, depth, front)
        viscosity = 0.0 if medium.relaxation is None else medium.relaxation.viscosity
        if viscosity > 0:
            # The force of a dashpot is η k u', with the stiffness k. The total stiffness of the springs jumps when a
            # spring touches, so replace it by the stiffness of the curve.
            sums = np.append(0.0, np.cumsum(row.stiffness))[count]
            excess = viscosity * velocity * (curve.at_depth(np.maximum(depth, 0.0))[1] - sums)
            corrected = moved.largest & (force > 0) & np.isfinite(excess)
            force[corrected] = np.maximum(force + excess, 0.0)[corrected]
    else:
        elastic = np.maximum(moved.deflection, 0.0)
        if creep is not None:
            exact = load.time <= np.nan_to_num(creep.receding_from, nan=np.inf)
            elastic[exact] = creep.creep[exact]
        corrected = moved.largest & np.isfinite(moved.depth)
        if creep is not None:
            corrected |= exact
        at_curve, stiffness = _at_elastic_force(curve, row, elastic)
        sums = np.append(0.0, np.cumsum(row.stiffness))[count]
        rate = velocity * sums
        if creep is not None:
            rate[exact] = creep.rate[exact]
        with np.errstate(invalid="ignore"):
            # An indenter at rest has the velocity 0, even before the first computed point of the curve, where the
            # stiffness is nan.
            at_rate = np.where(rate == 0, 0.0, rate / stiffness)
        depth, velocity = np.where(corrected, at_curve, depth), np.where(corrected, at_rate, velocity)
    unknown = (count > 0) & (front > 0) & (front < row.first_depth) & (force > 0)
    if load.by_depth:
        force[unknown] = np.nan
    else:
        unknown &= ~corrected
        depth[unknown] = velocity[unknown] = np.nan
    fraction = np.where(count > 0, row.contact_fraction[np.maximum(count, 1) - 1], 0.0)
    if not load.by_depth:
        # Under no force the indenter rests on the first spring, which does not count as contact.
        fraction[(load.values == 0) & (count <= 1)] = 0.0
    return depth, force, velocity, fraction


def _at_steps_of_soft_media(
    medium: Medium, load: Load, depth: Array, force: Array, velocity: Array, fraction: Array
) -> None:
    """Correct, in place, the motion at steps of the load in a medium with J(0) = 0 that has no springs and dashpots.

    Such a medium does not move at a step of the force. A step of the depth into the surface needs an infinite force,
    and after a step out of the surface there is no force.
    """
    with np.errstate(over="ignore"):
        unbounded = np.isinf(medium.creep_rate(0.0))
    jumps = np.diff(load.values, prepend=0.0)
    steps = np.flatnonzero((np.diff(load.time, prepend=load.time[0]) == 0) & (jumps != 0))
    for k in steps:
        if load.by_depth:
            force[k] = np.inf if jumps[k] > 0 and fraction[k] > 0 else 0.0
            fraction[k] = fraction[k] if jumps[k] > 0 else 0.0
        else:
            depth[k], fraction[k] = (depth[k - 1], fraction[k - 1]) if k else (0.0, 0.0)
            if unbounded:
                velocity[k] = np.copysign(np.inf, jumps[k])


def _warn_of_the_beginning(curve: LoadingCurve, row: RowOfSprings, load: Load, moved: RowMotion) -> None:
    """Warn if the motion depends on the curve before its first level (computed point).

    There the curve is taken to be a power law.
    """
    if row.first_depth == 0:
        return
    if load.by_depth:
        low, high = np.minimum(load.values[1:], load.values[:-1]), np.maximum(load.values[1:], load.values[:-1])
        depends = ((np.diff(load.time) > 0) & (low < row.first_depth) & (high > 0)).any()
    else:
        depends = np.isfinite(moved.receding_from)
    share = curve.force[0] / max(np.nanmax(moved.deflection), np.finfo(float).tiny)
    if depends and share > _UNKNOWN_SHARE:
        warnings.warn(
            f"{caller('kinetics')}the motion depends on the curve before its first level, which is taken for a power "
            f"law; this level carries {100 * min(share, 1):.2g} % of the largest elastic force; an earlier first level "
            "is needed",
            AccuracyWarning,
            stacklevel=3,
        )
