"""Direct integration of the viscous problem in time, never using its correspondence with the elastic one.

The surface sinks at ẇ = (1/4πη) ∫ p/r dA. With Q = p d/(4πη), a rate of length, ẇ = K Q and F/η = 4π d ΣQ. While the
contact set does not change, its elements move with the indenter: K Q = v, hence Q = v q with K q = 1 on the set,
v = F/(4π d η Σq), and everything outside sinks at v K q. Depth, pressure impulse ∫Q dt and surface are then linear in
the impulse ∫F dt, so the next element to touch, and when, is known exactly: an event.
"""

from dataclasses import dataclass

import numpy as np

from viscorough import memory
from viscorough.compilation import njit
from viscorough.contact.halfspace import influence_coefficient
from viscorough.errors import ConvergenceError
from viscorough.interrupts import uninterrupted


@dataclass(frozen=True)
class Events:
    """The penetration of an indenter, contact event by contact event; arrays of shape (events,).

    impulse : ∫F dt/η at which the contact set grew [length²]
    depth : u at that impulse [length]
    resistance : F/(ηv) from there to the next event [length]
    contact_count : elements in contact from there on
    elements : number of elements of the indenter
    """

    impulse: np.ndarray
    depth: np.ndarray
    resistance: np.ndarray
    contact_count: np.ndarray
    elements: int

    def depth_at(self, impulse):
        """Depth at given impulses ∫F dt/η, linear between events; beyond the last one its set stays in contact."""
        i = self.event_at(impulse)
        return self.depth[i] + (impulse - self.impulse[i]) / self.resistance[i]

    def event_at(self, impulse):
        """Number of the last event at given impulses."""
        return np.searchsorted(self.impulse, impulse, side="right") - 1


def march_events(indenter, *, until_fraction=1.0):
    """Penetration of a rigid indenter into a linearly viscous half-space, exact from contact event to contact event.

    Every event adds one element to the contact set and one row to the Cholesky factor of its influence matrix. The
    surface is integrated as the response to the pressure impulse. Only elements that can touch next are looked at:
    gaps close at v at most.

    indenter : Indenter with two-dimensional heights
    until_fraction : contact fraction at which to stop, in (0, 1]

    Returns Events. Memory is 8 (until_fraction · elements)² bytes, time of third order in the elements in contact.
    Raises ValueError for arguments out of range, MemoryError where that memory is not there, ConvergenceError if an
    element comes under tension: contact could then open, which it cannot without adhesion and with F ≥ 0.
    """
    if indenter.heights.ndim != 2:
        raise ValueError("march_events: the indenter's heights must be two-dimensional")
    if not 0 < until_fraction <= 1:
        raise ValueError(f"march_events: until_fraction must lie in (0, 1], not {until_fraction!r}")
    row, column = np.nonzero(np.isfinite(indenter.heights))
    gap = indenter.initial_gap[row, column].astype(float)
    order = np.argsort(gap, kind="stable")
    distance = [np.arange(n, dtype=float) for n in indenter.heights.shape]
    influence = influence_coefficient(distance[0][:, None], distance[1][None, :])
    most = max(1, int(np.ceil(until_fraction * gap.size)))
    memory.require(8 * most**2, f"march_events: the factor for {most} elements in contact")
    with uninterrupted():
        impulse, depth, resistance, pulling = _march(influence, row[order], column[order], gap[order], most)
    if pulling >= 0:
        raise ConvergenceError(f"march_events: tension on element {pulling} of the contact set; contact would open")
    scale = 4 * np.pi * indenter.spacing
    return Events(scale * impulse, depth, scale * resistance, np.arange(1, most + 1), gap.size)


@njit(fastmath=True)
def _respond(influence, row, column, members, count, first, second, element):
    """Σ_j K_ij first_j and Σ_j K_ij second_j over the contact set, at one element i."""
    a, b = 0.0, 0.0
    r, c = row[element], column[element]
    for t in range(count):
        value = influence[abs(row[members[t]] - r), abs(column[members[t]] - c)]
        a += value * first[t]
        b += value * second[t]
    return a, b


@njit(fastmath=True)
def _append(factor, influence, row, column, members, count, element, forward):
    """Add an element to the set: a row of the Cholesky factor L, and the entry of L⁻¹·1 that belongs to it."""
    new = factor[count]
    for t in range(count):
        new[t] = influence[abs(row[members[t]] - row[element]), abs(column[members[t]] - column[element])]
    square, total = influence[0, 0], 1.0
    for i in range(count):
        above = factor[i]
        value = new[i]
        for j in range(i):
            value -= above[j] * new[j]
        value /= above[i]
        new[i] = value
        square -= value * value
        total -= value * forward[i]
    new[count] = np.sqrt(square)
    forward[count] = total / new[count]
    members[count] = element


@njit(fastmath=True)
def _rates(factor, count, forward, rate):
    """q = L⁻ᵀ (L⁻¹·1) of the contact set; returns its sum."""
    rate[:count] = forward[:count]
    total = 0.0
    for i in range(count - 1, -1, -1):
        below = factor[i]
        value = rate[i] / below[i]
        rate[i] = value
        total += value
        for j in range(i):
            rate[j] -= below[j] * value
    return total


@njit
def _march(influence, row, column, gap, most):
    """Impulse/(4π d), depth and Σq at every event; and the place in the set of an element under tension, or −1."""
    elements = gap.size
    factor = np.empty((most, most))
    members = np.empty(most, np.int64)
    forward, rate, load = np.zeros(most), np.zeros(most), np.zeros(most)
    inside = np.zeros(elements, np.bool_)
    # What is known of the distance e to the indenter: at `known_at` it was `known`, since then it shrank by less than
    # the indenter went down.
    known, known_at = gap.copy(), np.zeros(elements)
    impulse, depth, resistance = np.zeros(most), np.zeros(most), np.zeros(most)
    element, u, total = 0, 0.0, 0.0
    for count in range(1, most + 1):
        _append(factor, influence, row, column, members, count - 1, element, forward)
        inside[element] = True
        stiffness = _rates(factor, count, forward, rate)
        for t in range(count):
            if rate[t] < 0:
                return impulse, depth, resistance, t
        impulse[count - 1], depth[count - 1], resistance[count - 1] = total, u, stiffness
        if count == most:
            break

        nearest, element = np.inf, -1
        for i in range(elements):
            if not inside[i] and known[i] + known_at[i] < nearest:
                nearest, element = known[i] + known_at[i], i
        wait, next_element = np.inf, -1
        candidate = element  # the likeliest first: it rules most others out
        for i in range(-1, elements):
            if i >= 0:
                candidate = i
                if inside[i] or known[i] + known_at[i] - u >= wait:
                    continue
            sunk, speed = _respond(influence, row, column, members, count, load, rate, candidate)
            known[candidate], known_at[candidate] = sunk - u + gap[candidate], u
            until_touch = max(known[candidate], 0.0) / max(1.0 - speed, 1e-300)
            if until_touch < wait:
                wait, next_element = until_touch, candidate
        element = next_element
        u += wait
        total += wait * stiffness
        for t in range(count):
            load[t] += wait * rate[t]
    return impulse, depth, resistance, -1
