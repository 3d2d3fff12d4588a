"""Frictionless contact of a few elements by a dense influence matrix and an active set; needs numpy only.

It shares no code with the package, so that it can serve as a check of it; the stand-ins for other solvers use it.
"""

import numpy as np


def influence_matrix(rows, columns):
    """Influence matrix K of w = d/(πE*) K p (Love 1929) for a grid of square elements of side d.

    Elements are numbered row by row; shape (n, n) with n = rows · columns.
    """
    y, x = (i.ravel() for i in np.mgrid[:rows, :columns])
    total = 0.0
    for sign_y in (-0.5, 0.5):
        for sign_x in (-0.5, 0.5):
            b, a = (np.abs(i[:, None] - i) + sign for i, sign in ((y, sign_y), (x, sign_x)))
            rho = np.hypot(a, b)
            total = total + 4 * sign_y * sign_x * (a * np.log(b + rho) + b * np.log(a + rho))
    return total


def displacement(pressure, contact_modulus, side=1.0):
    """Displacement of the half-space of modulus E* at the elements of a grid under the pressure on them."""
    matrix = influence_matrix(*pressure.shape)
    return (side / (np.pi * contact_modulus) * matrix @ pressure.ravel()).reshape(pressure.shape)


def pressure_at_depth(gap, depth, contact_modulus, side=1.0):
    """Pressure of a rigid indenter with the given initial gap at a depth; same shape as the gap."""
    return _solve(gap, contact_modulus, side, lambda tangent, part: depth)


def pressure_at_force(gap, force, contact_modulus, side=1.0):
    """Pressure of a rigid indenter with the given initial gap under a force; same shape as the gap."""
    return _solve(gap, contact_modulus, side, lambda tangent, part: (force / side**2 + part.sum()) / tangent.sum())


def _solve(gap, contact_modulus, side, depth_of):
    """Pressure by an active set; `depth_of` is a function of K⁻¹ 1 and K⁻¹ g on the contact set."""
    matrix = side / (np.pi * contact_modulus) * influence_matrix(*gap.shape)
    initial_gap, contact = gap.ravel(), np.zeros(gap.size, dtype=bool)
    contact[initial_gap.argmin()] = True
    for _ in range(10 * gap.size):
        pressure = np.zeros(gap.size)
        right_hand_sides = np.array([np.ones(contact.sum()), initial_gap[contact]]).T
        tangent, gap_part = np.linalg.solve(matrix[np.ix_(contact, contact)], right_hand_sides).T
        depth = depth_of(tangent, gap_part)
        pressure[contact] = depth * tangent - gap_part
        overlap = depth - initial_gap - matrix @ pressure
        if (pressure < 0).any():
            contact &= pressure >= 0
        elif (overlap[~contact] > 1e-12 * depth).any():
            contact[np.where(contact, -np.inf, overlap).argmax()] = True
        else:
            return pressure.reshape(gap.shape)
    raise RuntimeError("the active set does not settle")


def disturbed(pressure, length, contact_modulus, side=1.0):
    """The pressure, raised on the element with the largest one such that this element is displaced by `length` more."""
    changed = np.array(pressure)
    changed.flat[pressure.argmax()] += length * np.pi * contact_modulus / (side * influence_matrix(1, 1)[0, 0])
    return changed
