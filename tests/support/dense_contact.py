"""Frictionless contact of a few elements by a dense influence matrix and an active set; needs numpy only.

It shares no code with the package, so that it can check it, and the stand-ins for other solvers solve with it.
"""

import numpy as np


def influence_matrix(rows, columns):
    """K in w = d/(πE*) K p (Love 1929) for square elements, row by row: shape (n, n) with n = rows · columns."""
    y, x = (i.ravel() for i in np.mgrid[:rows, :columns])
    total = 0.0
    for sign_y in (-0.5, 0.5):
        for sign_x in (-0.5, 0.5):
            b, a = (np.abs(i[:, None] - i) + sign for i, sign in ((y, sign_y), (x, sign_x)))
            rho = np.hypot(a, b)
            total = total + 4 * sign_y * sign_x * (a * np.log(b + rho) + b * np.log(a + rho))
    return total


def displacement(pressure, contact_modulus, side=1.0):
    """Displacement of the half-space of modulus E* under the pressure on each element of a grid."""
    matrix = influence_matrix(*pressure.shape)
    return (side / (np.pi * contact_modulus) * matrix @ pressure.ravel()).reshape(pressure.shape)


def pressure_at_depth(gap, depth, contact_modulus, side=1.0):
    """Pressure of a rigid indenter of that initial gap at a depth."""
    return _solve(gap, contact_modulus, side, lambda one, of_gap: depth)


def pressure_at_force(gap, force, contact_modulus, side=1.0):
    """Pressure of a rigid indenter of that initial gap under a force."""
    return _solve(gap, contact_modulus, side, lambda one, of_gap: (force / side**2 + of_gap.sum()) / one.sum())


def _solve(gap, contact_modulus, side, depth_of):
    """`depth_of` is called with K⁻¹ 1 and K⁻¹ g on the contact set."""
    matrix = side / (np.pi * contact_modulus) * influence_matrix(*gap.shape)
    free, contact = gap.ravel(), np.zeros(gap.size, dtype=bool)
    contact[free.argmin()] = True
    for _ in range(10 * gap.size):
        pressure = np.zeros(gap.size)
        right_hand_sides = np.array([np.ones(contact.sum()), free[contact]]).T
        one, of_gap = np.linalg.solve(matrix[np.ix_(contact, contact)], right_hand_sides).T
        depth = depth_of(one, of_gap)
        pressure[contact] = depth * one - of_gap
        overlap = depth - free - matrix @ pressure
        if (pressure < 0).any():
            contact &= pressure >= 0
        elif (overlap[~contact] > 1e-12 * depth).any():
            contact[np.where(contact, -np.inf, overlap).argmax()] = True
        else:
            return pressure.reshape(gap.shape)
    raise RuntimeError("the active set does not settle")


def disturbed(pressure, length, contact_modulus, side=1.0):
    """The pressure with more of it on the element that has most, so that it is displaced by that much more."""
    changed = np.array(pressure)
    changed.flat[pressure.argmax()] += length * np.pi * contact_modulus / (side * influence_matrix(1, 1)[0, 0])
    return changed
