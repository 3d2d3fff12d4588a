"""Kinetics of penetration: the loading curve read as the solution of the viscous problem.

The surface of a linearly viscous half-space moves at ẇ = (1/4πη)∫p/r dA. Integrated over time, with the pressure
impulse J = ∫p dt, this is the elastic relation w = (1/4πη)∫J/r dA, and ∫J dA = I = ∫F dt, the impulse. The elastic
solution at the force F/G = I/η meets every condition of the viscous problem at every time: more load on a
frictionless, non-adhesive contact adds the flat-punch pressure of the elements in contact, which is nowhere
negative, so the contact only grows and no pressure becomes tensile. Hence, for any topography and any F(t) ≥ 0,

    u(t) = u_el(F/G = I(t)/η),    v(t) = F(t)/(η·k/G),    k/G taken at I(t)/η    (paper, Eq. 1),

exactly. For a constant force I = Ft, so X = Ft/(4ηhL) and vt/h = X/κ(X) (Eqs. 2 and 3). Eqs. 7-9 of the paper
instead Laplace-transform the relation u(F/G), which is not linear, and so carry an extra factor 1/Γ(2−α).
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from viscorough.arrays import keep_read_only, read_only

_ROUNDING = 1e-10  # relative; the rounding error of an impulse summed over a million force samples


@dataclass(frozen=True)
class Kinetics:
    """Penetration over time; read-only arrays of shape (times,), in the units of curve, force and viscosity.

    time : t
    depth : u
    velocity : v = du/dt
    """

    time: np.ndarray
    depth: np.ndarray
    velocity: np.ndarray

    def __post_init__(self):
        keep_read_only(self)


class ForceHistory(NamedTuple):
    """A force over time and its integral; read-only arrays of shape (times,).

    times : t
    force : F(t) ≥ 0
    impulse : ∫F dt up to t
    """

    times: np.ndarray
    force: np.ndarray
    impulse: np.ndarray


def kinetics(curve, force, viscosity, times=None):
    """Depth and velocity of an indenter with the given loading curve in a linearly viscous half-space.

    curve : LoadingCurve of the indenter
    force : a number, the constant force F > 0 applied at t = 0; or samples F ≥ 0 of shape (times,), linear in
        between, applied from times[0] on (a jump is two samples close together)
    viscosity : η > 0, in a unit such that F·t/η is a length² in the curve's unit of length
    times : strictly increasing, and not negative if the force is constant; the default, for a constant force only, is
        the times at which the curve's levels are reached, t = (F/G)·η/F

    Returns Kinetics at `times`. The velocity is 0 where the force is 0. Between its levels the curve is interpolated
    (LoadingCurve.at_force); before its first level, where that is not possible, the result is nan.
    Raises ValueError for values outside these ranges and for an impulse beyond the curve's last level.
    """
    if not (np.ndim(viscosity) == 0 and np.isfinite(viscosity) and viscosity > 0):
        raise ValueError(f"viscosity: {viscosity}; allowed: a finite number above 0")
    constant = np.ndim(force) == 0
    if constant and not (np.isfinite(force) and force > 0):
        raise ValueError(f"constant force: {force}; allowed: a finite number above 0")
    if times is None:
        if not constant:
            raise ValueError("times: missing; a force given as samples needs the time of each sample")
        return Kinetics(curve.force * viscosity / force, curve.depth, force / (viscosity * curve.stiffness))

    times, force, impulse = impulses(force, times)
    depth, stiffness = _at_impulse(curve, impulse / viscosity, viscosity)
    # Without a force the velocity is 0 even before the first level, where the stiffness is nan.
    velocity = np.where(force == 0, 0.0, force / (viscosity * stiffness))
    return Kinetics(times, depth, velocity)


def impulses(force, times):
    """The ForceHistory of a force F(t) ≥ 0 at the given times.

    force : a constant F > 0 from t = 0 on, or samples of shape (times,), linear in between, from times[0] on
    times : strictly increasing

    Raises ValueError for values outside these ranges: under a negative force the contact would open, which the
    correspondence excludes.
    """
    times = read_only(times).astype(float)
    if times.ndim != 1 or times.size == 0 or not np.isfinite(times).all() or not (np.diff(times) > 0).all():
        raise ValueError("times: allowed is one row of finite numbers, each larger than the one before")
    if np.ndim(force) == 0:
        if times[0] < 0:
            raise ValueError(f"times: start at {times[0]:g}; allowed: from 0 on, where a constant force begins")
        force, impulse = np.full(times.shape, float(force)), force * times
    else:
        force = _samples(force, times)
        impulse = np.append(0, np.cumsum(0.5 * (force[1:] + force[:-1]) * np.diff(times)))
    return ForceHistory(*map(read_only, (times, force, impulse)))


def _samples(force, times):
    force = read_only(force).astype(float)
    if force.shape != times.shape:
        raise ValueError(f"force: samples of shape {force.shape}; allowed: one per time, shape {times.shape}")
    if not (np.isfinite(force) & (force >= 0)).all():
        where = int(np.argmin(np.isfinite(force) & (force >= 0)))
        raise ValueError(
            f"force: sample {where} is {force[where]}; "
            "allowed: finite, 0 or more (without adhesion a pull opens the contact)"
        )
    return force


def _at_impulse(curve, elastic_force, viscosity):
    """Depth and k/G at the impulse over viscosity I/η: those of the loading curve at F/G = `elastic_force` = I/η."""
    first, last = curve.force[0], curve.force[-1]
    largest = elastic_force.max()
    if largest > last * (1 + _ROUNDING):
        raise ValueError(
            f"impulse: {largest * viscosity:.6g} is beyond the curve's last level; "
            f"allowed: up to {last * viscosity:.6g}"
        )
    # An impulse that equals that of the first or last level up to rounding must not fall outside the curve.
    elastic_force = np.minimum(elastic_force, last)
    elastic_force = np.where(np.abs(elastic_force - first) <= _ROUNDING * first, first, elastic_force)
    depth, stiffness = curve.at_force(elastic_force)
    return np.where(elastic_force == 0, 0.0, depth), stiffness
