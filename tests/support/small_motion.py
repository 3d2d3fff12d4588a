"""Motion of a row of springs in a viscoelastic medium, by sums over the whole past.

It shares no code with the package, so it is an independent check. With the stiffnesses k of the springs, w = y/k, every
spring follows p = ∫ψ(t − s) dy(s). Steps in time make the assumptions of march:

- Without a parallel dashpot y is linear within a step, so that p_n = Σ_m ψ̄_nm (y_m − y_{m−1}), with ψ̄_nm the mean of ψ
  over the lags of step m.
- With a parallel dashpot p is constant within a step, so that y_n = Σ_m (J(t_n − t_{m−1}) − J(t_n − t_m)) p_m.

Either way y_n = y_free + a p_n, and step n is a complementarity problem: p ≥ 0, gap ≥ 0 and p · gap = 0, with the gap
g + y/k − u at the end of the step.
"""

from dataclasses import dataclass

import numpy as np
from scipy.special import exprel

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


def small_motion(gap, stiffness, medium, times, *, force=None, depth=None):
    """Return depths and forces of a row of springs with these initial gaps and stiffnesses, shape (2, times).

    medium : SpringsAndDashpots; force or depth : values at the times

    Under no force the indenter rests on the surface. With a parallel dashpot, forces hold just before each time under
    a prescribed depth.
    """
    by_depth, load = force is None, depth if force is None else force
    lengths = np.diff(times, prepend=times[0])
    motion, assumed = np.zeros((times.size + 1, gap.size)), np.zeros((times.size, gap.size))  # y, and p in the steps
    rows, u, rate = [], 0.0, 0.0
    for n, length in enumerate(lengths):
        surface = gap + motion[n] / stiffness
        rate = (load[n] - load[n - 1]) / length if length else rate
        if medium.viscosity and length == 0:  # the surface stays
            motion[n + 1] = motion[n]
            if by_depth and load[n] != u:
                u = load[n]
                assert (surface - u >= -_ROUNDING * (surface + u)).all(), "a step of the depth presses on a dashpot"
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
            open_gap = gap + free / stiffness
            u = target if by_depth else _depth(stiffness / compliance, open_gap, target)
            assumed[n] = np.maximum(u - open_gap, 0.0) * stiffness / compliance
            motion[n + 1] = free + compliance * assumed[n]
        pressure = assumed[n]
        if medium.viscosity and by_depth:  # p = G∞ y + η y', with y'/k ≥ u' where springs touch
            surface = gap + motion[n + 1] / stiffness
            touching = surface - u <= _ROUNDING * (surface + abs(u))
            pressed = np.maximum(medium.relaxed_modulus * motion[n + 1] + medium.viscosity * rate * stiffness, 0.0)
            pressure = np.where(touching, pressed, 0.0)
        rows.append((u, pressure.sum() if by_depth else load[n]))
    return np.array(rows).T


def _depth(stiffness, gap, force):
    """Return the depth u at which Σ k (u − gap)₊ is the force; the lowest gap without a force."""
    order = np.argsort(gap)
    gap, total = gap[order], np.cumsum(stiffness[order])
    depths = (force + np.cumsum(stiffness[order] * gap)) / total  # if the first springs touch
    return gap[0] if force == 0 else depths[np.flatnonzero(depths > gap)[-1]]
