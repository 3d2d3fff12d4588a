"""Kinetics of penetration: the loading curve read as the solution for any linear viscoelastic half-space.

The surface of a linearly viscous half-space moves at ẇ = (1/4πη)∫p/r dA. Integrated over time, this is the elastic
relation with ∫p dt in place of p, η in place of G, and the impulse I = ∫F dt in place of the force. The elastic
solution at F/G = I/η meets every condition of the viscous problem at every time: an increment of the load on a
frictionless, non-adhesive contact adds the flat-punch pressure of the elements in contact, which is nowhere
negative, so the contact only grows and no pressure becomes tensile. Hence, for any topography and any F(t) ≥ 0,

    u(t) = u_el(F/G = I(t)/η),    v(t) = F(t)/(η·k/G),    k/G taken at I(t)/η    (paper, Eq. 1),

exactly. For a constant force I = Ft, so X = Ft/(4ηhL) and vt/h = X/κ(X) (Eqs. 2 and 3). Eqs. 7-9 of the paper
instead Laplace-transform the relation u(F/G), which is not linear, and so carry an extra factor 1/Γ(2−α).

Likewise for a medium of creep compliance J(t): where the creep response Φ(t) = ∫J(t − s) dF(s) does not decrease,

    u(t) = u_el(F/G = Φ(t)),    v(t) = Φ'(t)/(k/G),

since the pressure ∫ψ(t − s) dp_el(s), with the relaxation modulus ψ ≥ 0, is nowhere tensile (Lee and Radok 1960 for
the sphere). Where Φ decreases the contact recedes, and the correspondence ends.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from viscorough import units
from viscorough.arrays import ForceHistory, ReadOnlyArrays, increasing, integral, real_numbers, samples
from viscorough.loading_curve import LoadingCurve, check_curve
from viscorough.saved import Saved
from viscorough.summaries import si_unit, span
from viscorough.types import Array, Integers
from viscorough.viscous.creep_response import creep_response
from viscorough.viscous.media import medium_of
from viscorough.viscous.medium import Medium
from viscorough.viscous.spectra import zero_of_increasing

_LATEST = 1e300  # time by which creep that ends has ended
_SPREAD, _EARLY = 100, 1e-3  # number of times that are chosen; share of the creep at their ends, where it has no level
_ROUNDING = 1e-10  # relative; the rounding error of an impulse summed over a million force samples


@dataclass(frozen=True)
class Kinetics(ReadOnlyArrays, Saved):
    """Penetration over time; read-only arrays of shape (times,).

    Attributes
    ----------
    time : array
        Times t, in s where the unit of length is known, else in the unit that those of force and viscosity make.
    depth : array
        u [length].
    velocity : array
        v = du/dt [length/time].
    length_unit : str
        Unit of the lengths; "1" if it is not known.
    """

    time: np.ndarray
    depth: np.ndarray
    velocity: np.ndarray
    length_unit: str = units.UNKNOWN

    def __str__(self) -> str:
        """What it is; the first and last time, depth and velocity."""
        unit = self.length_unit
        return (
            f"Penetration at {self.time.size} times\n"
            f"time t {span(self.time, si_unit('s', unit))}\n"
            f"depth u {span(self.depth, unit)}\n"
            f"velocity v {span(self.velocity, si_unit(f'{unit} s-1', unit))}"
        )


def kinetics(
    curve: LoadingCurve, force: ArrayLike | ForceHistory, medium: Medium | float | str, times: ArrayLike | None = None
) -> Kinetics:
    """Depth and velocity of an indenter with the given loading curve in a linear viscoelastic half-space.

    Parameters
    ----------
    curve : LoadingCurve
        LoadingCurve of the indenter.
    force : array_like or ForceHistory
        a number, the constant force F > 0 applied at t = 0; or samples F ≥ 0 of shape (times,), linear in between,
        applied from times[0] on, with a time given twice where the force steps; or a ForceHistory (`impulses`), whose
        samples need not be those of `times`. Forces are in N, or have a unit (texts as "5 mN", quantities of pint, also
        arrays of them), if the curve's unit of length is known.
    medium : Medium or float or str
        Medium, as viscorough.Maxwell, or the viscosity η > 0 of a Newtonian one; in Pa, s and Pa s, or a text as "2 kPa
        s", if the curve's unit of length is known, else in units such that F·t/η, or F over a modulus, is a length².
    times : array_like, optional
        Increasing, and not negative if the force is constant; in s, or with a unit. The default, for a constant force
        only, is a hundred times at equal ratios from the curve's first level to its last, or until creep has nearly
        ended; in a medium that responds elastically at t = 0, after time 0.

    Returns
    -------
    Kinetics
        At `times`. The velocity is that just after each time; at the last time of a history and before a step, that
        before it. Where an elastic medium steps, the velocity is that of the creep alone; it is infinite in a
        Springpot. Between its levels the curve is interpolated (LoadingCurve.at_force); before its first level, where
        that is not possible, the result is nan.

    Raises
    ------
    ValueError
        For values outside these ranges, for a force beyond the curve's last level, and, with the time, where the creep
        decreases and the contact would recede.

    Examples
    --------
    >>> import viscorough
    >>> disc = viscorough.self_affine_disc(0.7, 17, rms=0.01, seed=1)
    >>> curve = viscorough.indent(disc)
    >>> motion = viscorough.kinetics(curve, force=1.0, medium=30.0, times=[0.5, 1.0])
    >>> bool(motion.depth[0] < motion.depth[1]), bool(motion.velocity[0] > motion.velocity[1])
    (True, True)
    """
    check_curve("kinetics", curve)
    medium = medium_of(medium, curve.length_unit)
    load = consistent_force(force, curve.length_unit)
    constant = isinstance(load, float)
    if constant and not (np.isfinite(load) and load > 0):
        raise ValueError(f"constant force: {load}; allowed: a finite number above 0")
    if times is None and constant:
        times = _spread_times(curve, load, medium)
    elif times is None and not isinstance(load, ForceHistory):
        raise ValueError("times: missing; a force given as samples needs the time of each sample")
    elif times is not None:
        times = units.numbers(times, "s", curve.length_unit, "times")
    times, creep, rate = creep_and_rate(load, medium, times)
    depth, stiffness = _at_elastic_force(curve, creep, times)
    # Where nothing moves the velocity is 0 even before the first level, where the stiffness is nan.
    velocity = np.where(rate <= 0, 0.0, rate / stiffness)
    return Kinetics(times, depth, velocity, curve.length_unit)


def consistent_force(force: Any, length_unit: str) -> Any:
    """A force in N as one that is consistent with moduli in Pa and the unit of length of an indenter.

    force : a number, a text with a unit, samples or a ForceHistory; it is returned unchanged if the unit is not known
    """
    area = units.square_metres(length_unit)
    if isinstance(force, ForceHistory):
        return force if area == 1 else ForceHistory(force.times, force.force / area, force.impulse / area)
    forces = units.numbers(force, "N", length_unit, "force") / area
    return forces if forces.ndim else float(forces)


def _spread_times(curve: LoadingCurve, force: float, medium: Medium) -> Array:
    """Times at equal ratios under a constant force, from about the curve's first level to its last, or to the end.

    After time 0 where the medium responds elastically at t = 0.
    """
    limit = min(medium.last_time, _LATEST)
    with np.errstate(over="ignore"):
        at_once, at_last = force * medium.creep_compliance(np.array([0.0, limit]))
    first, last = curve.force[0] if curve.force.size > 1 else _EARLY * curve.force[-1], curve.force[-1]
    if not (at_once < last and at_last > first):
        raise ValueError(
            f"times: missing, and the creep is from F/G {at_once:.6g}, at once, to {at_last:.6g}, in the end, beside "
            f"the curve, from {first:.6g} to {last:.6g}; times or another force are needed"
        )
    start = first if at_once < first else at_once + _EARLY * (min(last, at_last) - at_once)
    end = last if at_last >= last else at_last - _EARLY * (at_last - max(first, at_once))
    wanted = np.array([start, end]) / force
    with np.errstate(all="ignore"):
        ends = zero_of_increasing(lambda t: medium.creep_compliance(t) - wanted, np.finfo(float).tiny, limit)
    if not (0 < ends[0] < ends[1] < _LATEST / 2):
        raise ValueError(f"times: from {ends[0]:g} to {ends[1]:g} they overflow; closer force and medium are allowed")
    times = np.geomspace(ends[0], ends[1], _SPREAD)
    springs = at_once > 0 and np.isfinite(curve.at_force(at_once)).all()
    return np.append(0.0, times) if springs else times


def creep_and_rate(force: Any, medium: Medium, times: Any) -> tuple[Array, Array, Array]:
    """Times, Φ and dΦ/dt there."""
    if not isinstance(force, float):
        history, place = resampled(force, times)
        creep, rate = creep_response(medium, history)
        return history.times[place], creep[place], rate[place]
    times = impulses(force, times).times
    if times[-1] > medium.last_time:
        raise ValueError(f"times: up to {times[-1]:g}; allowed: up to the last time of the table, {medium.last_time:g}")
    with np.errstate(over="ignore"):
        return times, force * medium.creep_compliance(times), force * medium.creep_rate(times)


def resampled(force: ForceHistory | Any, times: Any) -> tuple[ForceHistory, Integers]:
    """The ForceHistory with samples at `times` added, and the indices of those; after a step, where one is.

    force, times : as of `impulses`, or a ForceHistory and times within it, or None for those of its samples
    """
    if not isinstance(force, ForceHistory):
        force, times = impulses(force, times), None
    if times is None or times is force.times:
        return force, np.arange(force.times.size)
    times = increasing("times", times)
    if times[0] < force.times[0] or times[-1] > force.times[-1]:
        raise ValueError(
            f"times: from {times[0]:g} to {times[-1]:g}; allowed: within those of the force history, "
            f"{force.times[0]:g} to {force.times[-1]:g}"
        )
    new = np.setdiff1d(times, force.times)
    place = np.searchsorted(force.times, new)
    added = np.interp(new, force.times, force.force)
    history = impulses(np.insert(force.force, place, added), np.insert(force.times, place, new))
    return history, np.searchsorted(history.times, times, side="right") - 1


def impulses(force: Any, times: ArrayLike) -> ForceHistory:
    """The ForceHistory of a force F(t) ≥ 0 at the given times.

    Parameters
    ----------
    force : array_like
        a constant F > 0 from t = 0 on, or samples of shape (times,), linear in between, from times[0] on; plain numbers
        in N, or in consistent units if the unit of length is not known. Quantities with a unit are refused, since a
        history states none.
    times : array_like
        Strictly increasing, plain numbers; those of samples may be given twice, where the force steps.

    Raises
    ------
    ValueError
        For values outside these ranges: under a negative force the contact would open, which the correspondence
        excludes.

    Examples
    --------
    >>> import viscorough
    >>> viscorough.impulses(2.0, [0.0, 1.0, 3.0]).impulse.tolist()
    [0.0, 2.0, 6.0]
    """
    force = real_numbers("force", force)
    constant = force.ndim == 0
    times = increasing("times", times, steps=None if constant else "the force")
    if constant:
        if not 0 < force < np.inf:
            raise ValueError(f"constant force: {force}; allowed: a finite number above 0")
        if times[0] < 0:
            raise ValueError(f"times: start at {times[0]:g}; allowed: from 0 on, where a constant force begins")
        force, impulse = np.full(times.shape, force), force * times
    else:
        force = samples("force", force, times, " (without adhesion a pull opens the contact)")
        impulse = integral(times, force, times)
    return ForceHistory(times, force, impulse)


def _at_elastic_force(curve: LoadingCurve, creep: Array, times: Array) -> tuple[Array, Array]:
    """Depth and k/G at F/G = Φ = `creep`, at the given times."""
    first, last = curve.force[0], curve.force[-1]
    beyond = ~(creep <= last * (1 + _ROUNDING))
    if beyond.any():
        where, enough = int(np.argmax(beyond)), 1.01 * creep[np.isfinite(creep)].max()
        raise ValueError(
            f"force: at time {times[where]:g} the creep ∫J dF is {creep[where]:.6g}, beyond the curve's last level; "
            f"allowed: up to {last:.6g}; indent further, with until_fraction=1 or a level at F/G = {enough:.3g} "
            "(forces)"
        )
    # A force that equals that of the first or last level up to rounding must not fall outside the curve.
    creep = np.where(np.abs(creep - first) <= _ROUNDING * first, first, np.minimum(creep, last))
    return curve.at_force(creep)
