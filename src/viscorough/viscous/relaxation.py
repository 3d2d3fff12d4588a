"""The force that holds an indenter at a given depth in a viscoelastic half-space: ramps, holds and relaxation.

While the depth does not decrease the contact does not recede, and the force is that of the elastic loading curve f(u) =
F_el/G, relaxed with the modulus ψ of the medium: F(t) = ∫ ψ(t − s) df(u(s)).
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from viscorough import units
from viscorough.arrays import ReadOnlyTuple, increasing, jumps_and_slopes, samples
from viscorough.loading_curve import LoadingCurve, check_curve
from viscorough.types import Array, Integers
from viscorough.viscous.creep_response import branch_states, sums_over_the_past
from viscorough.viscous.media import medium_of
from viscorough.viscous.medium import Medium
from viscorough.viscous.spectra import zero_of_increasing


class _DepthHistory(NamedTuple):
    time: np.ndarray
    depth: np.ndarray
    force: np.ndarray


class DepthHistory(ReadOnlyTuple, _DepthHistory):
    """A depth over time and the force that it takes; read-only arrays of shape (times,).

    Attributes
    ----------
    time : array
        Times t.
    depth : array
        u [length].
    force : array
        Force F.
    """

    __slots__ = ()


def force_under_depth(curve: LoadingCurve, depth: ArrayLike, medium: Medium | float, times: ArrayLike) -> DepthHistory:
    """Force on an indenter that is moved to given depths in a viscoelastic half-space.

    Parameters
    ----------
    curve : LoadingCurve
        LoadingCurve of the indenter.
    medium : Medium or float
        As in kinetics, but no CreepTable, whose ψ is not known.
    times, depth : array_like
        Shape (times,), u ≥ 0 and not decreasing, linear in between, and u = 0 before times[0]; a time given twice is a
        step, which a Newtonian or Kelvin-Voigt medium does not allow, as its force would be infinite.

    Returns
    -------
    DepthHistory
        Exact for steps and holds, and where the curve is exact between its levels (it is linear there as long as every
        level adds one element); elsewhere of second order in the distance between levels. At a step the force is its
        limit from either side, in a Springpot infinite. In a dashpot the force is that just after each time, and just
        before the last one and before a time that is given again.

    Raises
    ------
    ValueError
        For arguments out of range and for depths beyond the curve's last level.

    Examples
    --------
    >>> import viscorough
    >>> disc = viscorough.self_affine_disc(0.7, 17, rms=0.01, seed=1)
    >>> curve = viscorough.indent(disc)
    >>> solid = viscorough.StandardLinearSolid(4.0, 1.0, 0.5)
    >>> held = viscorough.force_under_depth(curve, [0.01, 0.01, 0.01], solid, [0.0, 1.0, 100.0])
    >>> round(float(held.force[0] / held.force[-1]), 6)  # it relaxes from one modulus to the other
    4.0
    """
    check_curve("force_under_depth", curve)
    unit = curve.length_unit
    medium, area = medium_of(medium, unit), units.square_metres(unit)
    times = increasing("times", units.numbers(times, "s", unit, "times"), steps="the depth")
    depth = samples("depth", units.numbers(depth, unit, unit, "depth"), times)
    if not (rises := np.diff(depth, prepend=0) >= 0).all():
        where = int(np.argmin(rises))
        raise ValueError(
            f"depth: sample {where} is {depth[where]:g}; allowed: depths that do not decrease, "
            "under which the contact does not recede (march_medium goes on there)"
        )
    if depth[-1] > curve.depth[-1] * (1 + 1e-12):
        raise ValueError(
            f"depth: {depth[-1]:g} is beyond the curve's last level; allowed: up to {curve.depth[-1]:g}; indent "
            "further, with until_fraction=1 or a level at that depth (depths)"
        )
    depth = np.minimum(depth, curve.depth[-1])
    node_times, node_depths, place = _with_levels(curve, times, depth)
    elastic, stiffness = elastic_force(curve, node_depths)
    if medium.relaxation is None:
        unit_loads = medium.relaxation_modulus, medium.relaxation_integral
        force = np.add(*sums_over_the_past(node_times, elastic, place, np.zeros(place.size), *unit_loads))
        return DepthHistory(times, depth, force * area)
    viscosity, relaxed, moduli, relaxation_times = medium.relaxation
    _, left = branch_states(np.diff(node_times), elastic, relaxation_times)
    force = relaxed * elastic + left @ moduli
    if viscosity:
        jumps, speed = jumps_and_slopes(node_times, node_depths)
        if jumps.any():
            where = int(np.argmax(jumps > 0))
            raise ValueError(
                f"depth: steps at time {node_times[where]:g}, which takes an infinite force here; allowed: ramps"
            )
        before, after = np.append(0.0, speed), np.append(speed, 0.0)
        last = np.append(np.diff(node_times) == 0, True)  # before a time that is given again, and at the end
        force = force + viscosity * stiffness * np.where(last, before, after)
    return DepthHistory(times, depth, force[place] * area)


def _with_levels(curve: LoadingCurve, times: Array, depth: Array) -> tuple[Array, Array, Integers]:
    """Times and depths with the levels of the curve on every ramp added, and the indices of the times given."""
    levels = curve.depth[(curve.depth > depth[0]) & (curve.depth < depth[-1])]
    # Levels within a step are at its time; that of a level next to a sample may be the sample's by rounding.
    new = np.setdiff1d(np.interp(levels, depth, times), times)
    place = np.searchsorted(times, new)
    nodes = np.insert(times, place, new), np.insert(depth, place, np.interp(new, times, depth))
    return *nodes, np.arange(times.size) + np.searchsorted(new, times)


def elastic_force(curve: LoadingCurve, depth: Array) -> tuple[Array, Array]:
    """F_el/G and k/G at depths up to the last level; before the first one the curve is taken for straight."""
    stiffness = np.full(depth.shape, curve.force[0] / curve.depth[0])
    force = depth * stiffness
    inside = depth >= curve.depth[0]
    wanted = depth[inside]
    force[inside] = zero_of_increasing(lambda force: curve.at_force(force)[0] - wanted, *curve.force[[0, -1]])
    stiffness[inside] = curve.at_force(force[inside])[1]
    return force, stiffness
