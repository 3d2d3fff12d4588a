"""Compute influence coefficients of the elastic half-space: deflection by uniform pressure on a rectangular element."""

import numpy as np

from viscorough.basics.compilation import njit
from viscorough.basics.types import Array, Integers

# Beyond this distance the series (`_mean_inverse_distance`) is more accurate than the difference of logarithms
# (`_closed_form`). The unit of the distance is the longer side of an element. A long element is divided into parts; the
# unit is then the longer side of a part.
_FAR = 30


def influence_coefficient(row: Array | Integers, column: Array | Integers, aspect: float = 1.0) -> Array:
    """Return the influence coefficient K, the dimensionless deflection at a distance from an element under pressure.

    An element has sides dx along the rows and dy along the columns, and d = √(dx dy). A uniform pressure p on the
    element deflects the surface by w = p d/(πE*) K (Love 1929). For an incompressible half-space with the shear modulus
    G, this is w = p d/(4πG) K.

    Near the element K is computed in closed form, as the sum of ±(a ln(b + ρ) + b ln(a + ρ)) over the four corners of
    the element. Here a and b are the signed distances to a corner along the two sides, and ρ = √(a² + b²). Far from the
    element the closed form loses digits to cancellation, and K is computed from the moment expansion of ∫∫ dA/r to
    fourth order. The relative error is at most 1e-11.

    At the centre of the element, K(0, 0) = 4 (a asinh(b/a) + b asinh(a/b)) with the half sides a and b in units of d.
    For squares this is 4 ln(1 + √2) = 3.5254943481.

    row, column : distances from the centre of the element, in rows and in columns; their shapes are broadcast
    aspect : dy/dx

    Returns K (dimensionless) of the broadcast shape, taken from a table of all different distances.
    """
    rows, row_at = np.unique(abs(row), return_inverse=True)
    columns, column_at = np.unique(abs(column), return_inverse=True)
    return influence_table(rows, columns, aspect)[row_at, column_at]


def influence_table(row: Array, column: Array, aspect: float) -> Array:
    """Return the influence coefficients K at all pairs of a distance in rows and a distance in columns.

    row, column : distances from the centre of an element, arrays of shapes (m,) and (n,)
    aspect : dy/dx

    Returns K (dimensionless) of shape (m, n), see `influence_coefficient`.
    """
    height, width = np.sqrt(aspect), np.sqrt(1 / aspect)
    # At large distances, the deflection by a long element is computed as a sum over parts of the element, which are at
    # most twice as long as wide.
    parts = np.ceil(max(aspect / 2, 1.0)), np.ceil(max(1 / aspect / 2, 1.0))
    table = np.zeros((row.size, column.size))
    _fill_table(table, abs(row) * height, abs(column) * width, height / parts[0], width / parts[1], *parts)
    return table


@njit
def _fill_table(table, x, y, part_length, part_width, parts_x, parts_y):
    """Compute ∫∫ dA/r over a rectangle of area 1, for all pairs of distances x ≥ 0 and y ≥ 0 from its centre.

    Here r is the distance between a point of the rectangle and the point (x, y). First the series is computed for all
    pairs. Then values near the rectangle are replaced by the closed form. The inner loop of the series contains no
    condition, so the compiler can process several numbers at once.

    table : the results are stored here; zero on entry
    part_length, part_width : sides along x and y of the equal parts into which the rectangle is divided for the series
    parts_x, parts_y : number of parts along x and y
    """
    far = _FAR * max(part_length, part_width)
    for k in range(x.size):
        row = table[k]
        for i in range(parts_x):
            for j in range(parts_y):
                x_i, shift = x[k] + (i - 0.5 * (parts_x - 1)) * part_length, (j - 0.5 * (parts_y - 1)) * part_width
                for m in range(y.size):
                    row[m] += _mean_inverse_distance(x_i, y[m] + shift, part_length, part_width)
        for m in range(y.size):
            row[m] /= parts_x * parts_y
            if max(x[k], y[m]) <= far:
                row[m] = _closed_form(x[k], y[m], parts_x * part_length, parts_y * part_width)


@njit(inner=True)
def _closed_form(x, y, length, width):
    """Return ∫∫ dA/r over a rectangle by differences of logarithms.

    Here r is the distance between a point of the rectangle and the point (x, y). The origin is the centre of the
    rectangle.
    """
    total = 0.0
    for sign_x in (-1, 1):
        for sign_y in (-1, 1):
            a, b = x + 0.5 * sign_x * length, y + 0.5 * sign_y * width
            rho = np.sqrt(a * a + b * b)
            # For b < 0, the sum b + ρ loses digits, so ln(b + ρ) is computed as ln(a²/(ρ − b)). If b < 0 at both
            # corners with the same a, the terms with ln(a²) cancel in the sum over the corners.
            log_b = np.log(b + rho) if b > 0 else 2 * np.log(abs(a)) - np.log(rho - b)
            log_a = np.log(a + rho) if a > 0 else 2 * np.log(abs(b)) - np.log(rho - a)
            total += sign_x * sign_y * (a * log_b + b * log_a)
    return total


@njit(inner=True)
def _mean_inverse_distance(x, y, length, width):
    """Return the mean of 1/r over a distant rectangle, by a moment expansion to fourth order.

    Here r is the distance between a point of the rectangle and the point (x, y). The origin is the centre of the
    rectangle, and the result is nan there.
    """
    x2, y2 = x * x, y * y
    # Compute 1/r², with the distance r of the point (x, y) from the centre. The formulas below only multiply by powers
    # of 1/r, since further divisions would take most of the time.
    inverse2 = 1 / (x2 + y2)
    inverse = np.sqrt(inverse2)
    inverse5 = inverse2 * inverse2 * inverse
    length2, width2 = length * length, width * width
    # Mean and half difference of length² and width², and of length⁴ and width⁴. For a square of side 1 the means are 1
    # and the differences 0.
    second, second_difference = 0.5 * (length2 + width2), 0.5 * (length2 - width2)
    fourth, fourth_difference = 0.5 * (length2**2 + width2**2), 0.5 * (length2**2 - width2**2)
    second_term = (second / 24) * inverse2 * inverse + second_difference * (x2 - y2) * (inverse5 / 8)
    fourth_term = fourth * (33 * (x2 * x2 + y2 * y2) - 144 * x2 * y2) + fourth_difference * 15 * (x2 * x2 - y2 * y2)
    mixed = length2 * width2 * (81 * x2 * y2 - 12 * (x2 * x2 + y2 * y2))
    return inverse + second_term + (fourth_term / 1920 + mixed / 576) * inverse5 * inverse2 * inverse2
