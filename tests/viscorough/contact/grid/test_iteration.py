"""Loads that an element passes on when it leaves the contact, against direct elimination of the element."""

import numpy as np
import pytest

from support.influence import influence_matrix
from viscorough.contact.grid.iteration import load_redistribution_stencil


@pytest.mark.parametrize("aspect", [1.0, 3.0])
def test_load_redistribution_stencil_eliminates_an_element(aspect):
    row, column = np.divmod(np.arange(25), 5)
    matrix = influence_matrix(row.astype(float), column.astype(float), aspect)
    inverse = np.linalg.inv(matrix)
    others = np.arange(25) != 12
    # Without the element the others solve a smaller system. The change is the load that they take over from it.
    deflection = np.random.default_rng(2).random(25)
    load = inverse @ deflection
    change = np.linalg.solve(matrix[np.ix_(others, others)], deflection[others]) - load[others]
    near = np.isin(np.flatnonzero(others), [6, 7, 8, 11, 13, 16, 17, 18])
    np.testing.assert_allclose(
        change[near], load[12] * load_redistribution_stencil(aspect).ravel()[[0, 1, 2, 3, 5, 6, 7, 8]], rtol=1e-9
    )
