"""Least squares with non-negative unknowns, and the extreme values of linear functions of them.

Let x ≥ 0 minimise ½ ‖A x − b‖². An extreme value of r·x over all x ≥ 0 with ‖A x − b‖² ≤ least + distance² is found at
the minimiser of ½ ‖A x − b‖² − λ r·x, with λ adjusted to the distance. An active-set method finds this minimiser
(Lawson and Hanson 1974). It starts from the unknowns that were positive before, since few of them change with λ or r.

Further unknowns may have any sign. Each is replaced by its difference from a bound that lies far below it.
"""

from typing import Any

import numpy as np

from viscorough.basics.compilation import njit
from viscorough.basics.types import Array

_TRIALS, _CLOSE = 12, 0.01  # values of λ, and relative accuracy of the distance
_LARGEST_FACTOR, _LEAST_SHARE = 4.0, 1e-3  # of λ from one trial to the next; of the distance, to limit this factor
_ROUNDING = 1e-11  # of gradients, relative to the target; columns have norm 1
_FAR = 10.0  # bound of an unknown of any sign: its column would then be so many times as long as the target
_SINGULAR = 1e-13  # a column is taken for dependent on others if its remainder is shorter


def non_negative(matrix: Array, target: Array, signed: Array | None = None) -> tuple[Array, Array]:
    """Return x ≥ 0 and z that minimise ‖matrix x + signed z − target‖.

    matrix, signed : columns of non-negative unknowns, and of unknowns of any sign, shape (rows, unknowns)
    """
    from scipy.optimize import nnls  # takes long to import

    unknowns = matrix.shape[1]
    matrix, target, bounds = _with_signed(matrix, target, signed)
    scale = np.linalg.norm(matrix, axis=0)
    scale[scale == 0] = 1.0
    matrix = matrix / scale
    if matrix.shape[0] > matrix.shape[1] + 1:
        reduced: Any = np.linalg.qr(np.column_stack([matrix, target]), mode="r")
        matrix, target = reduced[:, :-1], reduced[:, -1]
    x = nnls(matrix, target, maxiter=30 * matrix.shape[1])[0] / scale
    return x[:unknowns], x[unknowns:] + bounds


def _with_signed(matrix: Array, target: Array, signed: Array | None) -> tuple[Array, Array, Array]:
    """Return the problem for x and z − bounds, all of them non-negative, and these bounds."""
    if signed is None or not signed.shape[1]:
        return matrix, target, np.empty(0)
    bounds = -_FAR * np.linalg.norm(target) / np.linalg.norm(signed, axis=0)
    return np.hstack([matrix, signed]), target - signed @ bounds, bounds


def extremes(
    matrix: Array, target: Array, functions: Array, distance: float, signed: Array | None = None
) -> tuple[Array, Array]:
    """Return the least and largest values of linear functions of x ≥ 0 near the minimiser of ‖matrix x − target‖.

    functions : coefficients of the functions, shape (functions, unknowns)
    distance : the squared residual may exceed its least value by distance²
    signed : columns of further unknowns, of any sign; each of these is a further function, after the others
    """
    from scipy.optimize import nnls  # takes long to import

    given, unknowns = functions.shape
    matrix, target, bounds = _with_signed(matrix, target, signed)
    # The values of signed unknowns are further functions.
    functions = np.pad(functions, [(0, bounds.size), (0, bounds.size)])
    functions[given:, unknowns:] = np.eye(bounds.size)
    scale = np.linalg.norm(matrix, axis=0)
    scale[scale == 0] = 1.0
    reduced: Any = np.linalg.qr(np.column_stack([matrix / scale, target]), mode="r")
    columns, target = np.ascontiguousarray(reduced[:, :-1].T), np.ascontiguousarray(reduced[:, -1])
    best = nnls(columns.T, target, maxiter=30 * columns.shape[0])[0]
    functions = np.ascontiguousarray(functions / scale)
    # λ if no unknown were bounded, of the solution of least norm.
    multiplier = distance / np.linalg.norm(np.linalg.lstsq(columns, functions.T, rcond=1e-10)[0], axis=0)
    shift = np.append(np.zeros(given), bounds)
    low, high = (
        _extremes(columns, target, functions, best, sign * multiplier, distance) + shift for sign in (-1.0, 1.0)
    )
    return low, high


@njit
def _extremes(columns, target, functions, best, multipliers, distance):
    """Extreme values of functions, of the sign of the multipliers, which are first guesses."""
    least, values = _square(columns, target, best), np.empty(functions.shape[0])
    for k in range(values.size):
        x, multiplier = best.copy(), multipliers[k]
        for _ in range(_TRIALS):
            _minimise(columns, target, multiplier * functions[k], x)
            excess = np.sqrt(max(_square(columns, target, x) - least, 0.0))
            ratio = distance / max(excess, _LEAST_SHARE * distance)
            if abs(ratio - 1) < _CLOSE:
                break
            multiplier *= min(ratio, _LARGEST_FACTOR)
        values[k] = functions[k] @ x
    return values


@njit(inner=True)
def _square(columns, target, x):
    """‖A x − b‖²."""
    residual = target.copy()
    for j in range(x.size):
        if x[j] > 0:
            residual -= x[j] * columns[j]
    return residual @ residual


@njit(inner=True)
def _minimise(columns, target, tilt, x):
    """Change x ≥ 0 into the minimiser of ½ ‖A x − b‖² − tilt·x.

    columns : columns of A as rows, of norm 1; the columns of positive x are independent
    """
    count, rounding = x.size, _ROUNDING * np.sqrt(target @ target)
    passive = x > 0
    for _ in range(3 * count):
        for _ in range(count):
            members = np.flatnonzero(passive)
            solution = _unbounded(columns, target, tilt, members)
            step, first = 1.0, -1
            for i in range(members.size):
                j = members[i]
                if solution[i] <= 0 and x[j] < step * (x[j] - solution[i]):
                    step, first = x[j] / (x[j] - solution[i]), i
            for i in range(members.size):
                x[members[i]] += step * (solution[i] - x[members[i]])
            if first < 0:
                break
            x[members[first]] = 0.0
            for j in members:
                if x[j] <= 0:
                    x[j], passive[j] = 0.0, False
        residual = target.copy()
        for j in range(count):
            if passive[j]:
                residual -= x[j] * columns[j]
        steepest, new = rounding, -1
        for j in range(count):
            if not passive[j]:
                gradient = columns[j] @ residual + tilt[j]
                if gradient > steepest:
                    steepest, new = gradient, j
        if new < 0:
            break
        passive[new] = True


@njit(inner=True)
def _unbounded(columns, target, tilt, members):
    """Minimiser with these members alone, of any sign, by the modified Gram-Schmidt method."""
    count = members.size
    basis, triangle = np.empty((count, target.size)), np.zeros((count, count))
    residual, solution = target.copy(), np.empty(count)
    for j in range(count):
        basis[j] = columns[members[j]]
        for i in range(j):
            triangle[i, j] = basis[i] @ basis[j]
            basis[j] -= triangle[i, j] * basis[i]
        triangle[j, j] = max(np.sqrt(basis[j] @ basis[j]), _SINGULAR)
        basis[j] /= triangle[j, j]
        solution[j] = basis[j] @ residual
        residual -= solution[j] * basis[j]
    # The solution of R s = Qᵀ b + R⁻ᵀ tilt.
    forward = np.empty(count)
    for j in range(count):
        value = tilt[members[j]]
        for i in range(j):
            value -= triangle[i, j] * forward[i]
        forward[j] = value / triangle[j, j]
    solution += forward
    for j in range(count - 1, -1, -1):
        for i in range(j + 1, count):
            solution[j] -= triangle[j, i] * solution[i]
        solution[j] /= triangle[j, j]
    return solution
