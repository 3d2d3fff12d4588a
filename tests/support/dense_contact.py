"""Frictionless contact of a few elements by a dense influence matrix and non-negative least squares.

It shares no code with the package, so it is an independent check. The stand-in for another solver uses it, too.
"""

import numpy as np
from scipy.optimize import brentq, nnls


def influence_matrix(rows, columns, aspect=1.0):
    """Return the influence matrix K of w = d/(πE*) K p (Love 1929) for elements of sides dx and dy, d = √(dx dy).

    aspect : dy/dx

    Elements are numbered row by row; shape (n, n) with n = rows · columns.
    """
    sides = np.sqrt(aspect), 1 / np.sqrt(aspect)
    y, x = (i.ravel() for i in np.mgrid[:rows, :columns])
    total = 0.0
    for sign_y in (-0.5, 0.5):
        for sign_x in (-0.5, 0.5):
            b = sides[0] * (np.abs(y[:, None] - y) + sign_y)
            a = sides[1] * (np.abs(x[:, None] - x) + sign_x)
            total = total + 4 * sign_y * sign_x * (a * np.arcsinh(b / abs(a)) + b * np.arcsinh(a / abs(b)))
    return total


def displacement(pressure, contact_modulus, side=1.0):
    """Return the displacement of a half-space of modulus E* at the elements of a grid under their pressure."""
    matrix = influence_matrix(*pressure.shape)
    return (side / (np.pi * contact_modulus) * matrix @ pressure.ravel()).reshape(pressure.shape)


def pressure_at_depth(gap, depth, contact_modulus, side=1.0):
    """Return the pressure of a rigid indenter with this initial gap at a depth; same shape as the gap.

    With K = R Rᵀ, complementarity is the least-squares problem |Rᵀ p − R⁻¹ (u − g)| with p ≥ 0.
    """
    root = np.linalg.cholesky(side / (np.pi * contact_modulus) * influence_matrix(*gap.shape))
    return nnls(root.T, np.linalg.solve(root, depth - gap.ravel()))[0].reshape(gap.shape)


def pressure_at_force(gap, force, contact_modulus, side=1.0):
    """Return the pressure of a rigid indenter with this initial gap under a force; same shape as the gap."""

    def excess(depth):
        return pressure_at_depth(gap, depth, contact_modulus, side).sum() * side**2 / force - 1

    one_element = force / (np.pi * contact_modulus * side) * influence_matrix(1, 1).item()
    depth = brentq(excess, gap.min(), gap.min() + 1.01 * one_element, xtol=1e-14 * one_element, rtol=1e-14)
    return pressure_at_depth(gap, depth, contact_modulus, side)


def disturbed(pressure, length, contact_modulus, side=1.0):
    """Raise the largest pressure by the amount that displaces its element by a further `length`."""
    changed = np.array(pressure)
    changed.flat[pressure.argmax()] += length * np.pi * contact_modulus / (side * influence_matrix(1, 1)[0, 0])
    return changed
