"""Direct integration of growing viscoelastic contact, exact from contact event to contact event.

While the contact set does not change, its elements move with the indenter: y' = q u' with K q = 1 on the set, whatever
the medium. Contact events therefore depend on the motion alone, and those of march_events, in which the impulse over
the viscosity is 4πd Σy, are those of any medium. With Z = 4πd Σy and the sums W_i of the internal variables over all
elements (internal_variables), the force is

    F = G∞ Z + Σ G_i W_i + η Z',    W_i' = Z' − W_i/τ_i,

a linear differential equation with constant coefficients, whose solution is a matrix exponential. Nothing here uses the
correspondence with the elastic problem, nor retardation times: this module checks both.
"""

import numpy as np
from numpy.typing import ArrayLike
from scipy.linalg import expm

from viscorough.errors import ConvergenceError
from viscorough.indenter import Indenter
from viscorough.types import Array
from viscorough.viscous.integration.events import march_events
from viscorough.viscous.integration.internal_variables import MediumMotion, checked_input
from viscorough.viscous.medium import Medium, RelaxationSpectrum

_ROUNDING = 1e-12  # of the motion in a step in which nothing moves


def march_medium_events(
    indenter: Indenter,
    medium: Medium | float,
    times: ArrayLike,
    *,
    force: ArrayLike,
    until_fraction: float = 1.0,
) -> MediumMotion:
    """Motion of a rigid indenter on a viscoelastic half-space while the contact grows, exact between contact events.

    Parameters
    ----------
    indenter, medium, times, force
        As of march_medium.
    until_fraction : float, optional
        As of march_events.

    Returns
    -------
    MediumMotion
        Without pressures.

    Raises
    ------
    ValueError
        For arguments out of range, and with the time from which on the contact recedes (march_medium goes on there).
    ConvergenceError
        If that many elements touch before the last time.
    MemoryError
        If 8 (until_fraction · elements)² bytes are not available.

    Examples
    --------
    >>> import viscorough
    >>> disc = viscorough.self_affine_disc(0.7, 9, rms=0.01, seed=1)
    >>> solid = viscorough.StandardLinearSolid(4.0, 1.0, 0.5)
    >>> motion = viscorough.march_medium_events(disc, solid, [0.0, 1.0], force=[0.001, 0.001])
    >>> bool(motion.depth[0] < motion.depth[1])
    True
    """
    relaxation, area, times, load = checked_input("march_medium_events", indenter, medium, times, force)
    events = march_events(indenter, until_fraction=until_fraction)
    motion = _total_motion(relaxation, times, load)
    if (recedes := np.diff(motion, prepend=0) < -_ROUNDING * motion).any():
        k = int(np.argmax(recedes))
        raise ValueError(
            f"march_medium_events: from a time between {times[k - 1]:.6g} and {times[k]:.6g} on the contact recedes; "
            "allowed: contact that grows (march_medium goes on there)"
        )
    if motion[-1] > events.impulse[-1] and events.contact_count[-1] < events.elements:
        raise ConvergenceError(
            f"march_medium_events: {events.contact_count[-1]} elements touch before time {times[-1]:.6g}; "
            "a larger until_fraction is needed"
        )
    count = events.contact_count[events.event_at(motion)]
    return MediumMotion(times, events.depth_at(motion), load * area, count, indenter.length_unit)


def _total_motion(relaxation: RelaxationSpectrum, times: Array, force: Array) -> Array:
    """Z under a force that is linear between its samples, shape (times,)."""
    viscosity, relaxed, moduli, relaxation_times = relaxation
    # The state is Z, the W_i, F over η or G₀, and its change within an interval, whose length is the unit of time.
    size = 1 + moduli.size
    unit = viscosity or relaxation.instantaneous_modulus
    state, motion = np.zeros(size + 2), np.empty(times.size)
    for k in range(times.size):
        length, change = (times[k] - times[k - 1], force[k] - force[k - 1]) if k else (0.0, force[0])
        state[-1] = change / unit
        if length > 0:
            matrix = np.zeros((size + 2, size + 2))
            if viscosity:
                matrix[:size, : size + 1] = length * np.concatenate([[-relaxed], -moduli, [viscosity]]) / viscosity
            else:  # from the derivative of F: G₀ Z' = F' + Σ G_i W_i/τ_i
                matrix[:size, 1:size] = length * moduli / relaxation_times / unit
                matrix[:size, -1] = 1.0
            matrix[1:size, 1:size] -= np.diag(length / relaxation_times)
            matrix[size, -1] = 1.0
            state = expm(matrix) @ state
        elif not viscosity:  # all springs respond elastically; with a dashpot in parallel, none does
            state[:size] += state[-1]
        state[size] = force[k] / unit
        motion[k] = state[0]
    return motion
