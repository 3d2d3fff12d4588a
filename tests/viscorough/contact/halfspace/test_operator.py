"""Influence coefficients and the operator on the grid, against closed forms, quadrature and the dense matrix."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from support.influence import influence_matrix
from viscorough.contact.halfspace.influence import influence_coefficient
from viscorough.contact.halfspace.operator import Halfspace
from viscorough.contact.options import SolverOptions


@pytest.mark.skipif(np.finfo(np.longdouble).eps > 1e-18, reason="no numbers of higher precision")
@given(st.floats(-1, 1))
@settings(max_examples=10, deadline=None, derandomize=True)
def test_coefficients_of_rectangles_are_accurate_at_every_distance(exponent):
    """Against Love's closed form in extended precision, which keeps 1e-13 at these distances."""
    aspect = 5**exponent
    row, column = np.arange(0.0, 400, 7)[:, None], np.concatenate([np.arange(0.0, 70), np.arange(70.0, 1000, 31)])
    height, exact = np.sqrt(np.longdouble(aspect)), 0
    for sign_x in (-0.5, 0.5):
        for sign_y in (-0.5, 0.5):
            y, x = (row + sign_y) * height, (column + sign_x) / height
            exact = exact + 4 * sign_x * sign_y * (x * np.arcsinh(y / abs(x)) + y * np.arcsinh(x / abs(y)))
    computed = influence_coefficient(row, column, aspect)
    assert np.abs(computed / exact - 1).max() < 1e-11
    np.testing.assert_allclose(influence_coefficient(column, row, 1 / aspect), computed, rtol=1e-11)


# One row, few rows and many rows.
SHAPES = [(1, 1), (1, 2), (1, 7), (1, 150), (2, 1), (2, 2), (2, 40), (3, 31), (4, 9), (5, 1), (9, 9), (12, 31)]


@pytest.mark.parametrize("aspect", [1.0, 0.2])
@pytest.mark.parametrize("shape", SHAPES)
def test_operator_is_the_dense_matrix(shape, aspect):
    rows, columns = (i.ravel() for i in np.indices(shape))
    matrix = influence_matrix(rows, columns, aspect)
    pressure = np.random.default_rng(1).standard_normal(shape)
    halfspace = Halfspace(*shape, aspect=aspect)
    for _ in range(2):  # no data of the first application may remain in the second
        halfspace.load[:, : shape[1]] = pressure
        deflection = halfspace.apply()[:, : shape[1]]
        expected = (matrix @ pressure.ravel()).reshape(shape)
        np.testing.assert_allclose(deflection, expected, atol=1e-13 * np.abs(expected).max())
    assert halfspace.count == 2


@pytest.mark.parametrize("aspect", [1.0, 5.0])
@pytest.mark.parametrize("shape", [(257, 257), (200, 77), (1, 50_000), (3, 5000), (5, 2000)])
def test_rounding_stays_within_the_bound_that_the_solver_assumes(shape, aspect):
    """For loads of both signs, whose deflections cancel, as those of search directions do."""
    load = np.random.default_rng(3).standard_normal(shape).astype(np.float32)
    deflections = []
    for precision in (np.float32, np.float64):
        halfspace = Halfspace(*shape, precision, aspect=aspect)
        halfspace.load[:, : shape[1]] = load
        deflections.append(halfspace.apply()[:, : shape[1]])
    single, double = deflections
    error = np.abs(single - double).max() / np.abs(double).max()
    assert error < SolverOptions().operator_rounding * np.finfo(np.float32).eps
