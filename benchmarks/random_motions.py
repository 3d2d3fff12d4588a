"""Random histories of force or depth on random loading curves in random media, to find motions that are wrong.

The inequalities of docs/theory.md, "Any history: a row of springs", hold for every history: the forces of the springs
fall along the row (c ≥ 0), and free springs keep their order (C ≤ 1).
"""

import warnings
from dataclasses import dataclass

import numpy as np
from random_heights import random_heights, with_random_aspect

from viscorough.basics.errors import AccuracyWarning
from viscorough.contact.loading_path import indent
from viscorough.media.creep_response import creep_response
from viscorough.media.kinds import KelvinVoigt, Maxwell, Newtonian, Prony, Springpot, StandardLinearSolid
from viscorough.media.load import Load
from viscorough.media.medium import Medium
from viscorough.reference import cone, sphere
from viscorough.results.loading_curve import LoadingCurve
from viscorough.surfaces.indenter import Indenter
from viscorough.viscous.kinetics import kinetics, row_motion
from viscorough.viscous.row import row_of_springs

_LARGEST = 24  # largest number of elements across
_ENDS = 3  # number of times at which the springs of a history are examined
# Tolerances of c over the largest φ of the history, of C − 1, and of the sum of the forces over the largest force.
_LEAST_C, _MOST_C, _SUM = 1e-10, 1e-9, 1e-9
# Tolerance of differences between histories with few and with many samples, over the largest value.
_SAMPLES = {Springpot: 1e-7}
_SAMPLES_OF_SPRINGS = 1e-9
# Largest share of the last level at which a history ends. After contact recedes and returns, depths exceed Φ.
_SHARE = 0.6


@dataclass(frozen=True)
class RandomMotion:
    """A loading curve, a medium, and a history of force or depth."""

    curve: LoadingCurve
    medium: Medium
    load: Load


def random_motion(generator):
    """Draw a RandomMotion from a numpy Generator."""
    curve, (medium, own_time) = _random_curve(generator), _random_medium(generator)
    by_depth, rigid = generator.random() < 0.5, isinstance(medium, Newtonian | KelvinVoigt)
    time, shape = _random_shape(generator, own_time, may_step=not (by_depth and rigid))
    share = _SHARE * 10.0 ** generator.uniform(-2, 0)
    if by_depth:
        if isinstance(medium, Springpot):
            shape[0] = 0.0  # a small first depth would become a ramp as long as the first interval between samples
        below = generator.random() * generator.choice([0.0, 0.5])
        lifted = np.where((shape == 0) & (np.arange(shape.size) > 0), -below, shape)
        return RandomMotion(curve, medium, Load(time, depth=share * curve.depth[-1] * lifted))
    fine, _ = Load(time, force=shape).with_times(np.unique(np.append(time, np.linspace(time[0], time[-1], 200))))
    largest = creep_response(medium.spectrum(fine), fine).max()
    scale = share * curve.force[-1] / largest if largest > 0 else 1.0
    return RandomMotion(curve, medium, Load(time, force=scale * shape))


def _random_curve(generator):
    """Return the curve of a round body, with exact levels, or of a random map at a random tolerance."""
    if generator.random() < 0.2:
        body = (
            sphere(10.0 ** generator.uniform(-1, 1)) if generator.random() < 0.5 else cone(generator.uniform(0.05, 1))
        )
        depth = np.geomspace(10.0 ** generator.uniform(-7, -4), 1.0, generator.integers(30, 400))
        count = 10 * np.arange(1, depth.size + 1)
        levels = depth, body.force(depth), body.stiffness(depth), count
        return LoadingCurve(*levels, 10 * depth.size + 1, "exact", 1e-6, 0, np.zeros(depth.size))
    heights = random_heights(generator, int(generator.integers(2, _LARGEST + 1)))
    height, length = 10.0 ** generator.uniform(-6, 6, 2) if generator.random() < 0.2 else (1.0, 1.0)
    indenter = with_random_aspect(Indenter(height * heights, length), generator)
    return indent(
        indenter, tolerance=10.0 ** -generator.uniform(1, 6), until_fraction=generator.choice([0.3, 0.7, 1.0])
    )


def _random_medium(generator):
    """Return a medium of any kind, and one of its relaxation times."""
    kind = generator.choice(["newtonian", "maxwell", "kelvin_voigt", "solid", "prony", "springpot"])
    modulus, time = 10.0 ** generator.uniform(-4, 4, 2)
    if kind == "newtonian":
        return Newtonian(modulus * time), time
    if kind == "kelvin_voigt":
        return KelvinVoigt(modulus, modulus * time), time
    if kind == "maxwell":
        return Maxwell(modulus, modulus * time), time
    if kind == "solid":
        return StandardLinearSolid(modulus, modulus * 10.0 ** generator.uniform(-4, -0.01), time), time
    if kind == "prony":
        number = generator.integers(1, 6)
        relaxed = generator.choice([0.0, modulus * 10.0 ** generator.uniform(-3, 1)])
        times = time * 10.0 ** generator.uniform(-3, 3, number)
        return Prony(relaxed, modulus * 10.0 ** generator.uniform(-2, 2, number), times), time
    return Springpot(modulus, generator.uniform(0.02, 0.98)), time


def _random_shape(generator, own_time, *, may_step):
    """Return times, and a load from 0 to 1 with ramps, holds and rests; a repeated time has a step."""
    number = generator.integers(3, 12)
    equal = np.full(number, 10.0 ** generator.uniform(-1.5, 0.5))
    lengths = equal if generator.random() < 0.5 else 10.0 ** generator.uniform(-2, 1, number)
    time = own_time * np.append(0.0, np.cumsum(lengths))
    shape = generator.random(time.size) * generator.choice([0.0, 1.0, 1.0, 1.0], time.size)
    held = np.flatnonzero(generator.random(time.size - 1) < 0.3)
    shape[held + 1] = shape[held]
    shape /= max(shape.max(), 1e-3)
    if not may_step:
        return time, np.append(0.0, shape[1:])
    twice = 1 + (generator.random(time.size) < 0.2)
    time, steps = np.repeat(time, twice), np.repeat(shape, twice)
    second = np.flatnonzero(np.diff(time) == 0) + 1
    steps[second] = generator.random(second.size)
    return time, steps


def motion_failure(case):
    """Return an error message on the motion of a RandomMotion; "" if it is right.

    A motion may be refused only if its contact grows beyond the curve.
    """
    motion = _moved(case, case.load)
    return _range_failure(case, motion) or _samples_failure(case, motion) or _springs_failure(case)


def _moved(case, load):
    """Return the motion under a load."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", AccuracyWarning)
        return kinetics(case.curve, load, case.medium)


def _range_failure(case, motion):
    """Return an error message unless depths are finite, forces not negative, and contact fractions from 0 to 1."""
    is_finite = np.isfinite(motion.depth) & np.isfinite(motion.force)
    if not is_finite.any():
        return "nothing is known"
    if (motion.force[is_finite] < 0).any():
        return f"a force of {motion.force[is_finite].min():.2g}"
    if not ((motion.contact_fraction >= 0) & (motion.contact_fraction <= 1)).all():
        return "a contact fraction beyond 0 and 1"
    return ""


def _samples_failure(case, motion):
    """Return an error message if more samples of the same history change the motion."""
    load = case.load
    pairs = zip(load.time[:-1], load.time[1:], strict=True)
    inner = np.concatenate([a + (b - a) * np.array([0.21, 0.5, 0.83]) for a, b in pairs if b > a])
    more, _ = load.with_times(np.unique(np.append(load.time, inner)))
    kept = ~np.isin(more.time, inner)
    again = _moved(case, more)
    allowed = _SAMPLES.get(type(case.medium), _SAMPLES_OF_SPRINGS)
    for name in ("depth", "force"):
        one, other = getattr(motion, name), getattr(again, name)[kept]
        finite = np.isfinite(one) & np.isfinite(other)
        largest = max(np.abs(one[finite]).max(initial=0), np.finfo(float).tiny)
        found = np.abs(one[finite] - other[finite]).max(initial=0) / largest
        if found > allowed:
            return f"more samples change the {name} by {found:.2g}"
    return ""


def _largest_force(row, motion):
    """Return the largest force φ in a motion; at samples before the last, the mean of the springs in contact."""
    is_finite = np.isfinite(motion.force) & (motion.in_contact > 0)
    means = motion.force[is_finite] / np.cumsum(row.stiffness)[motion.in_contact[is_finite] - 1]
    return max(motion.pressures.max(), means.max(initial=0))


def _springs_failure(case):
    """Return an error message unless c ≥ 0, C ≤ 1, and the springs carry the force, at parts of the history."""
    load, ends = case.load, np.linspace(case.load.time[0], case.load.time[-1], _ENDS + 1)[1:]
    moved = []
    for end in ends:
        longer, (place,) = load.with_times([end])
        values = longer.values[: place + 1]
        part = Load(longer.time[: place + 1], **{"depth" if load.by_depth else "force": values})
        row = row_of_springs(case.curve, part)
        motion = row_motion(case.curve, row, case.medium.spectrum(part), part)
        moved.append((end, row, motion))
    largest = max(_largest_force(row, motion) for _, row, motion in moved)
    most = max(motion.force.max() for *_, motion in moved)
    for end, row, motion in moved:
        rise = np.diff(motion.pressures).max(initial=0)
        if rise > _LEAST_C * largest or motion.pressures.min() < 0:
            return f"c of {-rise / largest:.2g} times the largest force at time {end:g}"
        crossing = (-np.diff(motion.surface) / np.diff(row.gap)).max(initial=0)
        rounding = 1e-13 * np.abs(motion.surface).max() / np.diff(row.gap).min(initial=np.inf)
        if crossing > _MOST_C + rounding:
            return f"C of 1 + {crossing:.2g} at time {end:g}"
        error = abs(row.stiffness @ motion.pressures - motion.force[-1])
        if error > _SUM * most:
            return f"springs carry {error / most:.2g} times the largest force too much or too little at time {end:g}"
    return ""
