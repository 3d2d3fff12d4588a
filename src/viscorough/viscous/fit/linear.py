"""Least squares with non-negative unknowns, and extreme values of linear functions of these unknowns near the best fit.

The best fit is the x ≥ 0 that minimises ‖A x − b‖². An x ≥ 0 is near the best fit if ‖A x − b‖² exceeds its minimum by
at most distance², so that it does not exceed a given sum of squares. Among these x, a linear function r·x is largest
(λ > 0) or smallest (λ < 0) at the minimiser of ½ ‖A x − b‖² − λ r·x. The multiplier λ is adjusted until the excess of
‖A x − b‖² equals distance². An active-set method finds the minimiser for each λ (Lawson and Hanson 1974). It starts
from the unknowns that were positive for the previous λ, because few of them change.

Additional unknowns may have any sign. Each of them is replaced by a non-negative unknown: its difference from a bound
far below its value.
"""

from typing import Any

import numpy as np

from viscorough.basics.compilation import njit
from viscorough.basics.types import Array

# Largest number of values of λ that are tried for an extreme value, and largest accepted relative error of the
# distance.
_TRIALS, _CLOSE = 60, 0.01
# The next λ is the present λ multiplied by the ratio of the required distance and the reached distance. The reached
# distance counts as at least this share of the required distance, because a smaller one consists of rounding errors.
_LEAST_SHARE = 1e-3
# Rounding error of the gradient of ½ ‖A x − b‖², relative to the norm of b. Columns of A have the norm 1.
_ROUNDING = 1e-11
# An unknown of any sign gets a negative lower bound. The norm of its column, multiplied by the absolute value of the
# bound, is this multiple of the norm of b.
_FAR = 10.0
# A column of A counts as a linear combination of other columns if its part perpendicular to them is shorter than this.
_SINGULAR = 1e-13


def non_negative(matrix: Array, target: Array, signed: Array | None = None) -> tuple[Array, Array]:
    """Return x ≥ 0, and z of any sign, that minimise ‖matrix x + signed z − target‖.

    matrix : shape (rows, unknowns x)
    signed : shape (rows, unknowns z); None if there are no unknowns of any sign
    """
    from scipy.optimize import nnls  # this import takes long

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
    """Replace unknowns z of any sign by the non-negative unknowns z − bounds.

    Return the matrix with the columns `signed` appended, the target for the new unknowns, and the bounds.
    """
    if signed is None or not signed.shape[1]:
        return matrix, target, np.empty(0)
    norms = np.linalg.norm(signed, axis=0)
    # An unknown without an effect on the residual is 0.
    bounds = -_FAR * np.divide(np.linalg.norm(target), norms, out=np.zeros_like(norms), where=norms > 0)
    return np.hstack([matrix, signed]), target - signed @ bounds, bounds


def extremes(
    matrix: Array, target: Array, functions: Array, largest: float, signed: Array | None = None
) -> tuple[Array, Array]:
    """Return the smallest and the largest value of linear functions of x ≥ 0 near the best fit of matrix x to target.

    They are nan for functions that the target does not determine.

    functions : coefficients r of each function r·x, shape (functions, unknowns)
    largest : largest ‖matrix x − target‖² of an x near the best fit, above the smallest
    signed : columns of additional unknowns, which may have any sign. The extreme values of these unknowns are returned,
        too, after the values of `functions`
    """
    from scipy.optimize import nnls  # this import takes long

    given, unknowns = functions.shape
    matrix, target, bounds = _with_signed(matrix, target, signed)
    # Append each unknown of any sign to the functions, so that its extreme values are found, too.
    functions = np.pad(functions, [(0, bounds.size), (0, bounds.size)])
    functions[given:, unknowns:] = np.eye(bounds.size)
    scale = np.linalg.norm(matrix, axis=0)
    scale[scale == 0] = 1.0
    reduced: Any = np.linalg.qr(np.column_stack([matrix / scale, target]), mode="r")
    columns, target = np.ascontiguousarray(reduced[:, :-1].T), np.ascontiguousarray(reduced[:, -1])
    best = nnls(columns.T, target, maxiter=30 * columns.shape[0])[0]
    residual = target - best @ columns
    distance = np.sqrt(max(largest - residual @ residual, np.finfo(float).tiny))
    functions = np.ascontiguousarray(functions / scale)
    # First guess of λ for a function r·x: distance/‖y‖, with the shortest y that satisfies Aᵀ y = r. This λ is exact if
    # no unknown is bounded. A function of unknowns without an effect on the residual is not determined.
    length = np.linalg.norm(np.linalg.lstsq(columns, functions.T, rcond=1e-10)[0], axis=0)
    multiplier = np.divide(distance, length, out=np.zeros_like(length), where=length > 0)
    shift = np.append(np.zeros(given), bounds)
    low, high = (
        np.where(length > 0, _extremes(columns, target, functions, best, sign * multiplier, distance) + shift, np.nan)
        for sign in (-1.0, 1.0)
    )
    return low, high


@njit
def _extremes(columns, target, functions, best, multipliers, distance):
    """Return the largest (multiplier > 0) or smallest (multiplier < 0) value of each function near the best fit.

    columns : Aᵀ, where the columns of A have the norm 1
    target : b
    functions : r of each function r·x
    best : x of the best fit
    multipliers : first guess of λ for each function
    """
    least, values = _square(columns, target, best), np.empty(functions.shape[0])
    for k in range(values.size):
        x, multiplier = best.copy(), multipliers[k]
        for _ in range(_TRIALS):
            _minimise(columns, target, multiplier * functions[k], x)
            excess = np.sqrt(max(_square(columns, target, x) - least, 0.0))
            ratio = distance / max(excess, _LEAST_SHARE * distance)
            if abs(ratio - 1) < _CLOSE:
                break
            multiplier *= ratio
        values[k] = functions[k] @ x
    return values


@njit(inner=True)
def _square(columns, target, x):
    """Return ‖A x − b‖², where `columns` is Aᵀ and `target` is b."""
    residual = target.copy()
    for j in range(x.size):
        if x[j] > 0:
            residual -= x[j] * columns[j]
    return residual @ residual


@njit(inner=True)
def _minimise(columns, target, tilt, x):
    """Replace x ≥ 0, in place, by the minimiser of ½ ‖A x − b‖² − tilt·x.

    columns : Aᵀ. Columns of A have the norm 1; the columns with x > 0 at the start must be linearly independent
    target : b
    tilt : λ r
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
    """Return the values of the unknowns `members` that minimise ½ ‖A x − b‖² − tilt·x if all other unknowns are 0.

    The values may have any sign. The modified Gram-Schmidt method factorises the columns of these unknowns, A = Q R.
    """
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
    # Solve R x = Qᵀ b + R⁻ᵀ tilt. Here `solution` is Qᵀ b, and `forward` becomes R⁻ᵀ tilt.
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
