"""Motion of a row of unilateral springs by steps in time, for media that are known by their creep compliance alone.

The force φ_m of a spring is constant within step m and jumps at its start, so that its deflection is

    y_n = J(0) φ_n + Σ_{m≤n} φ_m (J(t_n − t_{m−1}) − J(t_n − t_m)).

A step solves for the springs that are pressed at its end. The error is of first order in the steps. Steps between two
samples are halved, every motion is extrapolated with the one before it, and this is repeated until extrapolated motions
differ by less than the tolerance.
"""

import warnings

import numpy as np

from viscorough.basics.errors import AccuracyWarning
from viscorough.basics.types import Array, Integers
from viscorough.media.load import Load
from viscorough.media.medium import Medium
from viscorough.viscous.springs import RowOfSprings
from viscorough.viscous.unilateral import RowMotion

# Tolerance of depth and force, relative to the largest one.
_TOLERANCE = 1e-4
# Largest number of steps, and of springs: the cost is steps² × springs.
_MOST_STEPS, _MOST_SPRINGS = 3000, 400
# Intervals of time over which a concave J rises less and less, and the rounding of these rises.
_LAGS, _BEND = 256, 1e-9
# Overlap that counts as none, relative to the depth.
_ROUNDING = 1e-13


def move_row_by_sums(row: RowOfSprings, medium: Medium, load: Load) -> RowMotion:
    """Return the motion of a row of springs; depth and force are nan from where the depth reaches the limit.

    Warns with AccuracyWarning if the largest number of steps does not reach the tolerance. Raises ValueError for a
    medium whose creep compliance is not concave.
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
            # The difference falls to a quarter when the steps are halved, but where springs touch and let go it may
            # also be small by chance.
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
    """Raise ValueError if J grows faster later on: contact that recedes is then no row of springs."""
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
    """Largest difference of two motions, over the largest value."""
    values = (one.force, other.force) if by_depth else (one.depth, other.depth)
    return float(np.nanmax(np.abs(values[0] - values[1])) / max(np.nanmax(np.abs(values[1])), np.finfo(float).tiny))


def _extrapolated(coarse: RowMotion, fine: RowMotion) -> RowMotion:
    """The limit of a motion with an error in proportion to the steps."""
    return fine._replace(
        depth=2 * fine.depth - coarse.depth,
        force=np.maximum(2 * fine.force - coarse.force, 0.0),
        velocity=2 * fine.velocity - coarse.velocity,
        deflection=2 * fine.deflection - coarse.deflection,
        pressures=np.maximum(2 * fine.pressures - coarse.pressures, 0.0),
        surface=2 * fine.surface - coarse.surface,
    )


def _with_fewer_springs(row: RowOfSprings) -> tuple[Array, Array, Integers]:
    """Gaps and stiffnesses of at most _MOST_SPRINGS groups of neighbouring springs, and the last index of each."""
    if row.gap.size <= _MOST_SPRINGS:
        return row.gap, row.stiffness, np.arange(row.gap.size)
    # Equal steps of the logarithm of the summed stiffness.
    sums = np.log(np.cumsum(row.stiffness))
    edges = np.searchsorted(sums, np.linspace(sums[0], sums[-1], _MOST_SPRINGS + 1)[1:-1], side="right")
    starts = np.unique(np.append(0, edges))
    starts = starts[starts < row.gap.size]
    stiffness = np.add.reduceat(row.stiffness, starts)
    gap = np.add.reduceat(row.stiffness * row.gap, starts) / stiffness
    return gap, stiffness, np.append(starts[1:], row.gap.size) - 1


def _refined(load: Load, parts: int) -> tuple[Array, Array, Array]:
    """Times and loads with so many steps between samples, and the indices of the samples."""
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
    """The motion by so many steps between samples."""
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
        elif not load.by_depth and n:  # a step of the force, under which the medium does not move at once
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
    """The u with Σ w (u − s)₊ = target; the lowest s if the target is 0."""
    order = np.argsort(surface, kind="stable")
    heights, sums = surface[order], np.cumsum(stiffness[order])
    moments = np.cumsum(stiffness[order] * heights)
    count = max(int(np.searchsorted(sums * heights - moments, target, side="left")), 1)
    return float((target + moments[count - 1]) / sums[count - 1])
