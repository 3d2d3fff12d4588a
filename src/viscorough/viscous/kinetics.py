"""Motion of an indenter in any linear viscoelastic half-space under any history, from its loading curve.

As long as the contact only grows, the correspondence with the elastic problem holds (Lee and Radok 1960). With the
creep compliance J of the medium and the creep response Φ(t) = ∫J(t − s) dF(s), depth and velocity are

    u(t) = u_el(F/G = Φ(t)),    v(t) = Φ'(t)/(k/G),

where u_el(F/G) and k/G are depth and stiffness of the loading curve. In a viscous medium Φ = ∫F dt/η (paper, Eqs. 1 to
3). Eqs. 7 to 9 of the paper contain an additional factor 1/Γ(2−α), because they apply a Laplace transform to the
relation u(F/G), which is not linear.

For every history, the motion is computed in four steps:

1. The loading curve becomes an equivalent row of unilateral springs (module `row`; docs/theory.md).
2. The medium becomes springs and dashpots with the same creep (`Medium.spectrum`).
3. The motion of the row under the load is computed exactly, from event to event (module `move`).
4. At times when the contact is as large as ever before, the values of the row are replaced by values of the
   interpolated curve, which have no error from the finite number of springs (module `refine`).
"""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from viscorough.basics.arrays import increasing, real_numbers
from viscorough.basics.errors import AccuracyWarning, ConvergenceError
from viscorough.basics.types import Array, Integers
from viscorough.media.creep_response import creep_response
from viscorough.media.kinds import medium_of
from viscorough.media.load import Load
from viscorough.media.medium import Medium
from viscorough.media.spectra import POWER_LAW_ERROR, Spectrum, zero_of_increasing
from viscorough.results.loading_curve import LoadingCurve, check_curve
from viscorough.results.motion import Motion
from viscorough.viscous.crossing import first_decrease
from viscorough.viscous.move import BEYOND_CURVE, CHATTERING, INFINITE_FORCE, RowMotion, move_row
from viscorough.viscous.refine import refine
from viscorough.viscous.row import ROUNDING, RowOfSprings, row_of_springs

# Time that counts as infinite: the end of the creep is searched for only before this time.
_LATEST = 1e300
# Number of default output times under a constant force. They begin when the creep response F J(t) reaches the first
# level of the curve, and end when it reaches the last level. If the response is above the first level from time 0 on,
# or always below the last level, the times begin or end when the response differs from its first or last value by the
# share _EARLY of its range.
_SPREAD, _EARLY = 100, 1e-3
# A motion that depends on the unknown curve before its first level gives a warning if the force at this level is more
# than this share of the largest elastic force.
_UNKNOWN_SHARE = 1e-2


def kinetics(
    curve: LoadingCurve,
    force: ArrayLike | Load | None = None,
    medium: Medium | float | None = None,
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
        `times`. Before the first sample there is no load. Forces F ≥ 0 are in N, and depths in m. A negative depth
        lifts the indenter above the plane of first contact. In a medium without an instantaneous response (Newtonian,
        Kelvin-Voigt, Springpot), a first depth above 0 would need an infinite force. If it exceeds neither a tenth of
        the largest depth nor the largest rise from a sample to the next, it is taken to be noise: the depth then rises
        from 0 to the first sample, within the length of the interval between the first two.
    medium : Medium or float
        Medium, such as viscorough.Maxwell, or the viscosity η > 0 of a Newtonian medium [Pa s]. In consistent units
        instead of SI units, F·t/η, or F divided by a modulus, must be a length².
    times : array_like, optional
        Increasing times of the output [s]; 0 or later for a constant load. The default for a Load is
        the times of its samples. The default for a constant force is a hundred times with equal ratios, while the creep
        goes from the first to the last level of the curve, or until it has almost ended. If the medium responds
        elastically at time 0, time 0 precedes them.

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
        If the motion depends on the curve before its first level, where the curve is taken to be a power law.

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
    medium = medium_of(medium)  # type: ignore[arg-type]  # None is refused
    load, place = _load_and_places(curve, medium, force, depth, times)
    if load.by_depth:
        _check_depths(curve, load.values[: place[-1] + 1])
    row = row_of_springs(curve, load)
    spectrum = medium.spectrum(load)
    moved = row_motion(curve, row, spectrum, load, int(place[-1]))
    _warn_of_the_beginning(curve, row, load, moved)
    refined = refine(curve, row, medium, spectrum, load, moved)
    receding_from = _receding_from(spectrum, load)
    if receding_from >= load.time[place[-1]]:
        receding_from = np.nan
    depth, velocity, fraction = refined.depth[place], refined.velocity[place], refined.contact_fraction[place]
    return Motion(load.time[place], depth, refined.force[place], velocity, fraction, curve.length_unit, receding_from)


def row_motion(curve: LoadingCurve, row: RowOfSprings, spectrum: Spectrum, load: Load, last: int = -1) -> RowMotion:
    """Return the motion of the row of springs of a curve under a load.

    last : index of the last sample of the load at which the motion is needed

    Raises ValueError if the motion ends before this sample.
    """
    moved = move_row(row.gap, row.stiffness, row.limit, spectrum, load.time, load.values, by_depth=load.by_depth)
    if moved.ended == CHATTERING and np.isfinite(moved.depth[~np.isnan(moved.depth)]).all():
        raise ConvergenceError(f"kinetics: the contact does not settle at time {moved.until:g}; other samples may help")
    if moved.ended not in (BEYOND_CURVE, INFINITE_FORCE):
        _check_overflow(moved.depth[last] + moved.force[last])
    if np.isnan(moved.depth[last]):
        _refuse(curve, row, spectrum, load, moved)
    return moved


def _receding_from(spectrum: Spectrum, load: Load) -> float:
    """Return the first time from which the contact recedes; nan if it never does.

    Under a force, the contact recedes when the creep response decreases. Under a prescribed depth, it recedes when a
    depth above zero decreases.
    """
    if not load.by_depth:
        return float(first_decrease(spectrum, load.time, load.values))
    falls = (np.diff(load.values) < 0) & (load.values[:-1] > 0)
    return float(load.time[np.argmax(falls)]) if falls.any() else np.nan


def _check_overflow(values: ArrayLike) -> None:
    """Raise ValueError unless all values are finite."""
    if not np.isfinite(values).all():
        raise ValueError(
            "load: depths or forces overflow in this medium; allowed: forces, depths and moduli whose "
            "ratios are ordinary numbers; check their units"
        )


def _load_and_places(curve: LoadingCurve, medium: Medium, force: Any, depth: Any, times: Any) -> tuple[Load, Integers]:
    """Return the load, with samples added at the output times, and the indices of these samples.

    The load ends at the first sample after the last output time. The arguments are explained in `kinetics`.
    """
    if isinstance(force, Load) and depth is None and force.by_depth:
        force, depth = None, force
    if (force is None) == (depth is None):
        raise ValueError("kinetics: one of force and depth is needed")
    name, value = ("depth", depth) if force is None else ("force", force)
    if times is not None:
        times = real_numbers("times", times)
    constant = False
    if isinstance(value, Load):
        if value.by_depth != (name == "depth"):
            raise ValueError(
                f"kinetics: {name}: a Load that prescribes the other quantity; {name}=Load(..., {name}=...)"
            )
        load = value
    else:
        values = real_numbers(name, value)
        if values.ndim:
            if times is None:
                raise ValueError(f"times: missing; a {name} given as samples needs the time of each sample")
            load, times = Load(times, **{name: values}), None
        else:
            constant = True
            load, times = _constant(curve, medium, name, float(values), times)
    first, samples = 0, load.time.size
    if load.by_depth and not constant and medium.creep_compliance(0.0) == 0:
        load = load.with_first_ramp()
        first = load.time.size - samples
    if times is None:
        return load, np.arange(first, load.time.size)
    load, place = load.with_times(times)
    kept = slice(None, int(place[-1]) + 2)
    return Load(load.time[kept], **{name: load.values[kept]}), place


def _constant(curve: LoadingCurve, medium: Medium, name: str, value: float, times: Any) -> tuple[Load, Array]:
    """Return a constant load from time 0 on, and the output times.

    name, value : "force" or "depth", and the value of the constant
    times : output times, or None for the default times
    """
    if not np.isfinite(value) or (name == "force" and value <= 0):
        raise ValueError(f"constant {name}: {value}; allowed: a finite number{' above 0' if name == 'force' else ''}")
    if name == "depth" and times is None:
        raise ValueError("times: missing; a constant depth needs the times of the output")
    times = _spread_times(curve, value, medium) if times is None else increasing("times", times)
    if times[0] < 0:
        raise ValueError(f"argument times: start at {times[0]:g}; allowed: from 0 on, where a constant {name} begins")
    samples = np.unique([0.0, times[-1]])
    return Load(samples, **{name: np.full(samples.size, value)}), times


def _spread_times(curve: LoadingCurve, force: float, medium: Medium) -> Array:
    """Return the default output times under a constant force, which have equal ratios.

    The first time is about the time when the creep reaches the first level of the curve. The last is about the time
    when the creep reaches the last level or has almost ended. If the medium responds elastically at time 0, time 0
    precedes them.
    """
    with np.errstate(over="ignore"):
        at_once, at_last = force * medium.creep_compliance(np.array([0.0, _LATEST]))
    first, last = curve.force[0] if curve.force.size > 1 else _EARLY * curve.force[-1], curve.force[-1]
    if not (at_once < last and at_last > first):
        raise ValueError(
            f"argument times: missing, and the creep is from F/G {at_once:.6g}, at once, to {at_last:.6g}, in the "
            f"end, beside the curve, from {first:.6g} to {last:.6g}; times or another force are needed"
        )
    # Before the first level and after the last the depth is unknown, so the times keep clear of them by more than the
    # error of a springpot.
    margin = 10 * POWER_LAW_ERROR
    start = (1 + margin) * first if at_once < first else at_once + _EARLY * (min(last, at_last) - at_once)
    end = (1 - margin) * last if at_last >= last else at_last - _EARLY * (at_last - max(first, at_once))
    target = np.array([start, end]) / force
    with np.errstate(all="ignore"):
        ends = zero_of_increasing(lambda t: medium.creep_compliance(t) - target, np.finfo(float).tiny, _LATEST)
    if not (0 < ends[0] < ends[1] < _LATEST / 2):
        raise ValueError(f"the times from {ends[0]:g} to {ends[1]:g} overflow; closer force and medium are allowed")
    times = np.geomspace(ends[0], ends[1], _SPREAD)
    springs = at_once > 0 and np.isfinite(curve.at_force(at_once)).all()
    return np.append(0.0, times) if springs else times


def _check_depths(curve: LoadingCurve, depths: Array) -> None:
    """Raise ValueError if a depth exceeds the last depth of a curve that ends before complete contact."""
    last = curve.depth[-1]
    if depths.max() > last * (1 + ROUNDING) and curve.contact_count[-1] < curve.elements:
        raise ValueError(
            f"load: the depth {depths.max():g} is beyond the curve's last level; allowed: up to {last:g}; "
            "indent further, with argument until_fraction=1"
        )


def _check_creep(curve: LoadingCurve, row: RowOfSprings, times: Array, creep: Array) -> None:
    """Raise ValueError if the creep response exceeds the last force of a curve that ends before complete contact."""
    beyond = ~(creep <= curve.force[-1] * (1 + ROUNDING))
    if beyond.any() and np.isfinite(row.limit):
        where, enough = int(np.argmax(beyond)), 1.01 * creep[np.isfinite(creep)].max()
        raise ValueError(
            f"load: at time {times[where]:g} the load has the depth of F/G = {creep[where]:.6g} in an "
            f"elastic half-space, beyond the curve's last level; allowed: up to {curve.force[-1]:.6g}; indent further, "
            f"with argument until_fraction=1 or, in units of F/G, argument until_force={enough:.3g}"
        )


def _refuse(curve: LoadingCurve, row: RowOfSprings, spectrum: Spectrum, load: Load, moved: RowMotion) -> None:
    """Raise the ValueError that states why a motion ended early."""
    if moved.ended == INFINITE_FORCE:
        raise ValueError(
            f"load: steps into the surface at time {moved.until:g}, which takes an infinite force here; allowed: ramps"
        )
    if not load.by_depth:
        _check_creep(curve, row, load.time, creep_response(spectrum, load))
    raise ValueError(
        f"load: at time {moved.until:g} the contact grows beyond the curve's last level; allowed: depths up to "
        f"{curve.depth[-1]:g}; indent further, with argument until_fraction=1"
    )


def _warn_of_the_beginning(curve: LoadingCurve, row: RowOfSprings, load: Load, moved: RowMotion) -> None:
    """Warn if the motion depends on the curve before its first level.

    There the curve is taken to be a power law.
    """
    if row.first_depth == 0:
        return
    if load.by_depth:
        low, high = np.minimum(load.values[1:], load.values[:-1]), np.maximum(load.values[1:], load.values[:-1])
        depends = ((np.diff(load.time) > 0) & (low < row.first_depth) & (high > 0)).any()
    else:
        depends = np.isfinite(moved.released_from)
    share = curve.force[0] / max(np.nanmax(moved.deflection), np.finfo(float).tiny)
    if depends and share > _UNKNOWN_SHARE:
        warnings.warn(
            "the motion depends on the curve before its first level, which is taken for a power "
            f"law; this level carries {100 * min(share, 1):.2g} % of the largest elastic force; an earlier first level "
            "is needed",
            AccuracyWarning,
            stacklevel=3,
        )
