"""Motion of an indenter of a few elements in a viscoelastic half-space, by sums over the whole past.

It shares no code with the package, so it is an independent check. With the influence matrix S of the surface,
w = S y, every element follows p = ∫ψ(t − s) dy(s). Steps in time make the assumptions of march:

- Without a parallel dashpot y is linear within a step, so that p_n = Σ_m ψ̄_nm (y_m − y_{m−1}), with ψ̄_nm the mean of ψ
  over the lags of step m.
- With a parallel dashpot p is constant within a step, so that y_n = Σ_m (J(t_n − t_{m−1}) − J(t_n − t_m)) p_m.

Either way y_n = y_free + a p_n, and step n is a complementarity problem: p ≥ 0, gap ≥ 0 and p · gap = 0, with the gap
g + S y − u at the end of the step. It is solved by non-negative least squares.
"""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import nnls
from scipy.special import exprel

from support.dense_contact import influence_matrix

_ROUNDING = 1e-12  # rounding error of gaps, relative to the initial gap, the depth, and the largest displacement so far


@dataclass(frozen=True)
class SpringsAndDashpots:
    """ψ(t) = η δ(t) + G∞ + Σ G_i exp(−t/τ_i), with η or with branches i, but not both."""

    viscosity: float
    relaxed_modulus: float
    moduli: tuple = ()
    times: tuple = ()

    def mean_modulus(self, lag, length):
        """Return the mean of ψ without η over an interval that starts at a lag; ψ itself for length 0. Any shape."""
        mean = self.relaxed_modulus + 0 * lag
        for modulus, time in zip(self.moduli, self.times, strict=True):
            mean = mean + modulus * np.exp(-lag / time) * exprel(-length / time)
        return mean

    def creep(self, lag, length):
        """Return the increase of J over an interval from a lag on, of a dashpot with or without a spring. Any shape."""
        rate = self.relaxed_modulus / self.viscosity
        return np.exp(-lag * rate) * length * exprel(-length * rate) / self.viscosity


@dataclass(frozen=True)
class SmallMotion:
    """Depth, force and number of elements in contact at every time; last loads; when the contact first recedes."""

    depth: np.ndarray
    force: np.ndarray
    contact_count: np.ndarray
    loads: np.ndarray
    receding_from: float


def half_space(heights, spacing):
    """Return initial gaps and S, for forces on elements, of the elements of a map (its entries that are not nan).

    spacing : dx and dy
    """
    dx, dy = spacing
    exists = np.isfinite(heights).ravel()
    matrix = influence_matrix(*heights.shape, dy / dx)[np.ix_(exists, exists)] / (4 * np.pi * np.sqrt(dx * dy))
    return (np.nanmax(heights) - heights).ravel()[exists], matrix


def row_of_springs(gaps, stiffnesses):
    """Return initial gaps and S of independent springs."""
    return gaps, np.diag(1 / stiffnesses)


def small_motion(gap, matrix, medium, times, *, force=None, depth=None):
    """Return the SmallMotion of elements with these initial gaps and this S, under a force or at a depth.

    matrix : S of w = S y, for loads per element; medium : SpringsAndDashpots

    A step that presses an element brings it into contact; it leaves when its gap opens. Under no force the indenter
    rests on the surface, and the contact stays only if all its elements still touch. With a parallel dashpot
    the loads hold just after a step of the force, and just before each time under a prescribed depth.
    """
    by_depth, load = force is None, depth if force is None else force
    lengths, count = np.diff(times, prepend=times[0]), gap.size
    motion, assumed = np.zeros((times.size + 1, count)), np.zeros((times.size, count))  # y, and p within the steps
    touching, rows, u, rate, largest, receding_from = np.zeros(count, bool), [], 0.0, 0.0, 0.0, np.nan
    for n, length in enumerate(lengths):
        before, surface = touching, matrix @ motion[n]
        largest = max(largest, surface.max())
        rate = (load[n] - load[n - 1]) / length if length else rate
        if medium.viscosity and length == 0:  # the surface stays
            motion[n + 1] = motion[n]
            if by_depth and load[n] != u:
                u = load[n]
                rounding = _ROUNDING * (largest + gap + u)
                assert (gap + surface - u >= -rounding).all(), "a step of the depth presses on a dashpot"
                touching = before & (gap + surface - u <= rounding)
        else:
            lags = times[n] - times[:n]
            if medium.viscosity:
                compliance = medium.creep(0.0, length)
                free = medium.creep(lags, lengths[:n]) @ assumed[:n]
                target = load[n] if by_depth else 0.5 * (load[n - 1] + load[n])
            else:
                compliance = 1 / medium.mean_modulus(0.0, length)
                left = medium.mean_modulus(lags, lengths[:n]) @ np.diff(motion[: n + 1], axis=0)
                free, target = motion[n] - compliance * left, load[n]
            if by_depth:
                u, assumed[n] = target, _pressures(compliance * matrix, gap + matrix @ free - target)
            else:
                u, assumed[n] = _depth_and_pressures(compliance * matrix, gap + matrix @ free, target)
            motion[n + 1] = free + compliance * assumed[n]
            rounding = _ROUNDING * (largest + gap + abs(u))
            closed = gap + matrix @ motion[n + 1] - u <= rounding
            if by_depth or target > 0:
                touching = closed & (before | (compliance * np.diag(matrix) * assumed[n] > rounding))
            else:
                touching = before & closed[before].all()
        if np.isnan(receding_from) and (before & ~touching).any():
            receding_from = times[n]
        pressure = assumed[n]
        if medium.viscosity:  # p = G∞ y + η y', with S y' ≥ u' where elements touch
            among = touching
            if not (by_depth or among.any()):
                height = gap + matrix @ motion[n + 1]
                among = height - height.min() <= _ROUNDING * (largest + gap)
            pressure, inside = np.zeros(count), np.ix_(among, among)
            recovery = -medium.relaxed_modulus * (matrix @ motion[n + 1])[among]
            if by_depth and among.any():
                pressure[among] = _pressures(matrix[inside], recovery - medium.viscosity * rate)
            elif not by_depth:
                pressure[among] = _depth_and_pressures(matrix[inside], recovery, load[n])[1]
        rows.append((u, pressure.sum() if by_depth else load[n], touching.sum()))
    return SmallMotion(*np.array(rows).T, pressure, receding_from)


def _pressures(matrix, gap):
    """Return p ≥ 0 with gap + S p ≥ 0, such that p or the gap is zero at every element.

    With S = R Rᵀ this is the least-squares problem |Rᵀ p + R⁻¹ gap| with p ≥ 0. Its active set is solved once more.
    An element with an open gap at zero pressure is never in contact, because all S are positive.
    """
    p, near = np.zeros(gap.size), np.flatnonzero(gap < 0)
    if not near.size:
        return p
    root = np.linalg.cholesky(matrix[np.ix_(near, near)])
    active = near[nnls(root.T, -np.linalg.solve(root, gap[near]))[0] > 0]
    p[active] = np.linalg.solve(matrix[np.ix_(active, active)], -gap[active])
    rounding = 1e-9 * np.abs(gap[near]).max()
    assert (np.diag(matrix) * p >= -rounding).all(), "tension"
    assert (gap + matrix @ p >= -rounding).all(), "overlap"
    return np.maximum(p, 0.0)


def _depth_and_pressures(matrix, free, total):
    """Solve the complementarity problem with the gap free + S p − u and Σp = total for depth u and pressures p.

    Σp is a convex function of u, straight between contact events: Newton's method from above ends at the solution.
    """
    if total == 0:
        return free.min(), np.zeros(free.size)
    nearest = free.argmin()
    u, last = free[nearest] + matrix[nearest, nearest] * total, None
    for _ in range(1000):
        active = _pressures(matrix, free - u) > 0
        punch, rest = np.linalg.solve(matrix[np.ix_(active, active)], np.c_[np.ones(active.sum()), free[active]]).T
        u = (total + rest.sum()) / punch.sum()
        if last is not None and np.array_equal(active, last):
            p = np.zeros(free.size)
            p[active] = u * punch - rest
            return u, p
        last = active
    raise AssertionError("no depth found")
