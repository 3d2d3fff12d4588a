"""Motion of a row of unilateral springs by steps in time, for media that are known only by their creep compliance J.

The force of a spring, divided by its stiffness, is a constant φ_m within step m, and jumps at the start of the step. So
the deflection of the spring at the end t_n of step n is

    y_n = J(0) φ_n + Σ_{m≤n} φ_m (J(t_n − t_{m−1}) − J(t_n − t_m)).

Each step is solved for the springs in contact at the end of the step, and for their forces. The error of the motion is
proportional to the length of the steps. So the steps are halved repeatedly, and after each halving the last two motions
are extrapolated to steps of zero length. The method ends when two successive extrapolated motions differ by less than
the tolerance.
"""

import warnings

import numpy as np

from viscorough.basics.errors import AccuracyWarning
from viscorough.basics.types import Array, Integers
from viscorough.media.load import Load
from viscorough.media.medium import Medium
from viscorough.viscous.springs import RowOfSprings
from viscorough.viscous.unilateral import RowMotion

# Tolerance of a motion: largest error of the depth (or of the force, under a prescribed depth), relative to its largest
# value.
_TOLERANCE = 1e-4
# Largest numbers of steps and of springs. The cost is steps² × springs.
_MOST_STEPS, _MOST_SPRINGS = 3000, 400
# To check that J is concave, the time is divided into _LAGS equal intervals. The rise of J in an interval may exceed
# the rise in the interval before it by at most the share _BEND of the largest rise, which allows for rounding.
_LAGS, _BEND = 256, 1e-9
# An overlap of indenter and spring below this share of the depth does not count as contact.
_ROUNDING = 1e-13


def move_row_by_sums(row: RowOfSprings, medium: Medium, load: Load) -> RowMotion:
    """Return the motion of a row of springs in a medium with a concave creep compliance.

    When the depth exceeds row.limit, depth and force are nan from this time on.

    Warns with AccuracyWarning if the tolerance is not reached with the largest number of steps. Raises ValueError if
    the creep compliance is not concave.
    """
    _check_concave(medium, float(load.time[-1] - load.time[0]))
    samples = load.time.size
    parts = max(1, min(4, _MOST_STEPS // (2 * samples)))
    coarse = step_row(row, medium, load, parts)
    error, difference, best = np.inf, np.inf, coarse
    extrapolated = None
    while error > _TOLERANCE and 2 * parts * samples <= _MOST_STEPS:
        parts *= 2
        fine = step_row(row, medium, load, parts)
        last, extrapolated = extrapolated, _extrapolated(coarse, fine)
        coarse, best = fine, extrapolated
        if last is not None:
            before, difference = difference, _difference(last, extrapolated, by_depth=load.by_depth)
            # When the steps are halved, the difference usually falls to a quarter. If springs touch and are released,
            # it may be small by chance. So the error is taken to be at least a quarter of the previous difference.
            error = max(difference, before / 4) if np.isfinite(before) else difference
    if error > _TOLERANCE:
        text = f"an error of about {error:.2g}" if np.isfinite(error) else "an unknown error"
        kind = "force" if load.by_depth else "depth"
        warnings.warn(
            f"kinetics: {parts} steps between samples leave {text} of the largest {kind} (tolerance {_TOLERANCE:g}); "
            "fewer samples, or a medium of springs and dashpots, allow more steps",
            AccuracyWarning,
            stacklevel=4,
        )
    return best


def _check_concave(medium: Medium, duration: float) -> None:
    """Raise ValueError if the creep compliance is not concave.

    In such a medium, the motion of a row of springs is wrong if the contact recedes.
    """
    lags = np.linspace(0.0, duration, _LAGS + 1)
    rises = medium.creep_increment(lags[:-1], lags[1:])
    faster = np.diff(rises) > _BEND * np.abs(rises).max()
    if faster.any():
        raise ValueError(
            f"kinetics: the compliance of {type(medium).__name__} grows faster after time "
            f"{lags[1:-1][np.argmax(faster)]:g} than before; allowed, under a depth and where contact recedes: a "
            "concave J, as of every medium that relaxes"
        )


def _difference(one: RowMotion, other: RowMotion, *, by_depth: bool) -> float:
    """Return the largest difference between two motions, relative to the largest value.

    Forces are compared if `by_depth` is true, and depths otherwise.
    """
    values = (one.force, other.force) if by_depth else (one.depth, other.depth)
    return float(np.nanmax(np.abs(values[0] - values[1])) / max(np.nanmax(np.abs(values[1])), np.finfo(float).tiny))


def _extrapolated(coarse: RowMotion, fine: RowMotion) -> RowMotion:
    """Return the motion extrapolated to steps of zero length.

    coarse, fine : motions with long steps, and with steps of half the length
    """
    return fine._replace(
        depth=2 * fine.depth - coarse.depth,
        force=np.maximum(2 * fine.force - coarse.force, 0.0),
        velocity=2 * fine.velocity - coarse.velocity,
        deflection=2 * fine.deflection - coarse.deflection,
        pressures=np.maximum(2 * fine.pressures - coarse.pressures, 0.0),
        surface=2 * fine.surface - coarse.surface,
    )


def _with_fewer_springs(row: RowOfSprings) -> tuple[Array, Array, Integers]:
    """Merge neighbouring springs into at most _MOST_SPRINGS springs.

    Return the gaps and the stiffnesses of the merged springs. Also return, for each merged spring, the index of the
    last spring of the row that it contains.
    """
    if row.gap.size <= _MOST_SPRINGS:
        return row.gap, row.stiffness, np.arange(row.gap.size)
    # From each merged spring to the next, the logarithm of the summed stiffness increases by about the same amount.
    sums = np.log(np.cumsum(row.stiffness))
    edges = np.searchsorted(sums, np.linspace(sums[0], sums[-1], _MOST_SPRINGS + 1)[1:-1], side="right")
    starts = np.unique(np.append(0, edges))
    starts = starts[starts < row.gap.size]
    stiffness = np.add.reduceat(row.stiffness, starts)
    gap = np.add.reduceat(row.stiffness * row.gap, starts) / stiffness
    return gap, stiffness, np.append(starts[1:], row.gap.size) - 1


def _refined(load: Load, parts: int) -> tuple[Array, Array, Array]:
    """Divide each interval between samples of the load into `parts` steps.

    Return times and loads at the ends of the steps, and the indices of the samples in these arrays.
    """
    share = np.arange(1, parts + 1) / parts
    times, values, place = [load.time[:1]], [load.values[:1]], [0]
    for k in range(1, load.time.size):
        shares = share if load.time[k] > load.time[k - 1] else np.ones(1)
        times.append(load.time[k - 1] + shares * (load.time[k] - load.time[k - 1]))
        values.append(load.values[k - 1] + shares * (load.values[k] - load.values[k - 1]))
        times[-1][-1], values[-1][-1] = load.time[k], load.values[k]
        place.append(place[-1] + shares.size)
    return np.concatenate(times), np.concatenate(values), np.array(place)


def step_row(row: RowOfSprings, medium: Medium, load: Load, parts: int) -> RowMotion:
    """Return the motion of a row of springs at the samples of the load, with `parts` time steps between two samples."""
    gap, stiffness, last_of_group = _with_fewer_springs(row)
    times, values, place = _refined(load, parts)
    steps, at_once = times.size, float(medium.creep_compliance(0.0))
    pressures, pressed = np.zeros((steps, gap.size)), np.zeros(steps, int)
    depth, force, largest = np.full(steps, np.nan), np.full(steps, np.nan), np.ones(steps, bool)
    receding_from = np.nan
    for n in range(steps):
        lags = times[n] - times[: n + 1]
        compliance = at_once + (float(medium.creep_increment(0.0, lags[n - 1])) if n else 0.0)
        surface = gap
        if n > 1:
            surface = gap + medium.creep_increment(lags[1:-1], lags[:-2]) @ pressures[1:n]
        u = values[n] if load.by_depth else _depth_under(surface, stiffness, compliance * values[n])
        overlap = np.maximum(u - surface, 0.0)
        pressed[n] = np.count_nonzero(overlap > _ROUNDING * abs(u))
        if compliance > 0:
            pressures[n] = overlap / compliance
        elif not load.by_depth and n:  # at a step of the force, a medium with J(0) = 0 does not move
            pressed[n] = pressed[n - 1]
        depth[n] = u
        force[n] = stiffness @ pressures[n] if load.by_depth else values[n]
        largest[n] = pressed[n] >= pressed[:n].max(initial=0)
        if n and pressed[n] < pressed[n - 1] and np.isnan(receding_from):
            receding_from = times[n]
        if u > row.limit:
            depth[n], force[n] = np.nan, np.nan
            break
    in_row = np.append(0, last_of_group + 1)[pressed]
    sums, moments = np.cumsum(row.stiffness), np.cumsum(row.stiffness * row.gap)
    deflection = np.append(0.0, sums)[in_row] * depth - np.append(0.0, moments)[in_row]
    lengths = np.diff(times)
    rate = np.divide(np.diff(depth), lengths, out=np.zeros(steps - 1), where=lengths > 0)
    velocity = np.append(rate, rate[-1:] if steps > 1 else 0.0)
    before_step = np.flatnonzero(lengths == 0)
    velocity[before_step] = np.where(before_step > 0, velocity[np.maximum(before_step, 1) - 1], 0.0)
    last = np.repeat(pressures[-1], np.diff(np.append(-1, last_of_group)))
    raised = np.interp(row.gap, gap, surface + compliance * pressures[-1] - gap)
    moved = (depth, force, velocity, in_row, deflection, largest)
    depth, force, velocity, in_row, deflection, largest = (each[place] for each in moved)
    return RowMotion(depth, force, velocity, in_row, deflection, largest, float(receding_from), last, row.gap + raised)


def _depth_under(surface: Array, stiffness: Array, target: float) -> float:
    """Return the depth u at which the springs carry the force `target`, Σ w max(u − s, 0) = target.

    If the target is 0, return the lowest s.

    surface, stiffness : position s and stiffness w of each spring, shape (springs,)
    """
    order = np.argsort(surface, kind="stable")
    heights, sums = surface[order], np.cumsum(stiffness[order])
    moments = np.cumsum(stiffness[order] * heights)
    count = max(int(np.searchsorted(sums * heights - moments, target, side="left")), 1)
    return float((target + moments[count - 1]) / sums[count - 1])
