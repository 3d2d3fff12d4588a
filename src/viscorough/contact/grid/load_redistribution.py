"""Estimate how the neighbours of an element take over its load when the element leaves the contact."""

from functools import lru_cache

import numpy as np

from viscorough.basics.types import Array
from viscorough.contact.halfspace.influence import influence_coefficient


@lru_cache(maxsize=4)
def load_redistribution_stencil(aspect: float) -> Array:
    """Return the shares of its load that an element passes to its eight neighbours when it leaves the contact.

    The shares result from eliminating the element from the influence matrix of the 5 × 5 elements around it.

    aspect : dy/dx of the elements

    Returns an array of shape (3, 3). At its centre is −1, because the element loses its whole load.
    """
    row, column = np.divmod(np.arange(25.0), 5)
    inverse = np.linalg.inv(influence_coefficient(row[:, None] - row, column[:, None] - column, aspect))
    return -inverse[12].reshape(5, 5)[1:-1, 1:-1] / inverse[12, 12]
