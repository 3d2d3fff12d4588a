"""Dense influence matrices of elements on a grid, with the package's coefficients."""

import numpy as np

from viscorough.contact.halfspace.influence import influence_coefficient


def influence_matrix(row, column, aspect=1.0):
    """Return K of w = d/(4πG) K p among the elements in these rows and columns."""
    return influence_coefficient(np.subtract.outer(row, row) * 1.0, np.subtract.outer(column, column) * 1.0, aspect)
