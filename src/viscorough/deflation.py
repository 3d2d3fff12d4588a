"""Search directions of conjugate gradients kept for later descents, in which they need not be searched again.

As long as no element outside the contact set carries load of it, a direction d with deflection K d serves for that set,
too: the part of a solution that lies along d follows at no cost, and later directions are made K-conjugate to it.
Contact only grows along a loading path, so that most directions of one depth serve for the next ones.
"""

import numpy as np


class Directions:
    """The latest directions, K-conjugate and of unit energy dᵀ K d = 1; the oldest make room for new ones.

    shape, border : rows and columns of the grid, and the width of the border that flat fields of it have
    """

    def __init__(self, capacity, shape, border, precision):
        bordered = [n + 2 * border for n in shape]
        fields = np.zeros((capacity, *bordered), dtype=precision)
        self._interior = fields[:, border : border + shape[0], border : border + shape[1]]
        self._deflections = fields.reshape(capacity, -1)
        self._slots = {}  # slot: (places of the set, direction on them)
        self._next = 0

    def add(self, places, direction, deflection, energy):
        """Keep a direction, given on the places of its set, and its deflection on the whole grid."""
        slot, scale = self._next, 1 / np.sqrt(energy)
        np.multiply(deflection, self._deflections.dtype.type(scale), out=self._interior[slot])
        self._slots[slot] = places, direction * scale
        self._next = (slot + 1) % len(self._deflections)

    def on(self, inside, places):
        """The directions that serve for a set, and their deflections on it, each of shape (count, places).

        Others are forgotten: elements that left the contact do not come back.
        """
        serves = {id(support): inside[support].all() for support, _ in self._slots.values()}
        self._slots = {slot: kept for slot, kept in self._slots.items() if serves[id(kept[0])]}
        index = np.empty(inside.size, dtype=np.int32)
        index[places] = np.arange(places.size, dtype=np.int32)
        directions = np.zeros((len(self._slots), places.size), dtype=self._deflections.dtype)
        deflections = np.empty_like(directions)
        for row, (slot, (support, direction)) in enumerate(self._slots.items()):
            directions[row, index[support]] = direction
            np.take(self._deflections[slot], places, out=deflections[row])
        return directions, deflections

    def deflection(self, weights):
        """Deflection on the whole grid of the weighted sum of the directions that served last."""
        every = np.zeros(len(self._deflections), dtype=self._deflections.dtype)
        every[list(self._slots)] = weights
        return every @ self._deflections
