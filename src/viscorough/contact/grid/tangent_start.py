"""The tangent of a new contact before its iteration: the combination of known fields that is closest to it in energy.

Both pressures of a step and the last tangent are fields whose deflection is known, and the new tangent q is nearly a
combination of them.
"""

from typing import NamedTuple

import numpy as np

from viscorough.contact.grid import kernels
from viscorough.contact.grid.loops import GridLoops, field_to_fill
from viscorough.contact.state import BoundedField, ContactSet, GridFields
from viscorough.types import Array

# Eigenvalues of the energies of the loads, over the largest, that are zero but for rounding.
_DEPENDENT = 1e-10


class Loads(NamedTuple):
    """Pressure P and e − g = w − u, a BoundedField, of a contact at a reduced depth u; flat fields."""

    pressure: np.ndarray
    gap_change: BoundedField
    depth: float


def initial_tangent(
    now: Loads, last_depth: float, before: GridFields | None, contact_set: ContactSet, inner: slice, loops: GridLoops
) -> tuple[Array, BoundedField]:
    """The combination as initial q, and e_q = K q − 1 everywhere as a BoundedField.

    now : Loads after the step
    last_depth : before it; before : the GridFields there; None if there was no contact
    contact_set : the ContactSet after the step
    inner : slice of flat fields without the first and last rows of their border
    loops : GridLoops
    """
    known, last_rounding, tangent_rounding = 3 * (now.pressure, now.gap_change.values), 0.0, 0.0
    if before:
        known = (
            *known[:2], before.pressure, before.gap_change.values, before.tangent, before.tangent_gap.values,
        )  # fmt: skip
        last_rounding, tangent_rounding = before.gap_change.rounding, before.tangent_gap.rounding
    # An element that left the contact, within the tolerance, was loaded by fields that cannot be part of q.
    only_now = before is None or loops.difference(before.inside, contact_set.inside).size > 0
    weights = _weights(known, (now.depth, last_depth), contact_set, loops, slice(1) if only_now else slice(3))
    pressure_weight, last_pressure_weight, tangent_weight = weights
    shift = pressure_weight * now.depth + last_pressure_weight * last_depth + tangent_weight - 1
    tangent, tangent_gap = (field_to_fill(now.pressure.size, now.pressure.dtype, inner) for _ in range(2))
    loops.each(kernels.combine, (weights, shift), *(field[inner] for field in (tangent, tangent_gap, *known)))
    rounding = _rounding(weights, now, now.depth - last_depth, last_rounding, tangent_rounding)
    return tangent, BoundedField(tangent_gap, rounding)


def _weights(
    known: tuple[Array, ...], depths: tuple[float, float], contact_set: ContactSet, loops: GridLoops, combined: slice
) -> tuple[float, float, float]:
    """Weights of pressure, last pressure and last tangent in the combination of them closest to q in energy.

    known : these fields, each followed by its deflection; combined : those of them that have a weight
    """
    parts = loops.each(kernels.energies, (depths, *known), contact_set.places)
    energy, sums = (sum(part) for part in zip(*parts, strict=True))
    energy, sums = energy[combined, combined], sums[combined]
    scale = 1 / np.sqrt(np.maximum(np.diag(energy), np.finfo(float).tiny))
    # Least squares, since the loads may be multiples of each other.
    eigenvalues, vectors = np.linalg.eigh(scale[:, None] * energy * scale)
    independent = eigenvalues > _DEPENDENT * eigenvalues[-1]
    vectors = vectors[:, independent]
    weights = scale * (vectors @ ((scale * sums) @ vectors / eigenvalues[independent]))
    return *weights, *[0.0] * (3 - weights.size)


def _rounding(
    weights: tuple[float, float, float], now: Loads, depth_step: float, last_rounding: float, tangent_rounding: float
) -> float:
    """Bound on the rounding error of the combined e_q."""
    pressure_weight, last_pressure_weight, tangent_weight = weights
    rounding = now.gap_change.rounding
    # Unless it was recomputed, the gap has the errors of the last gap and tangent gap, which partly cancel here.
    added = rounding - last_rounding - depth_step * tangent_rounding
    if added >= 0:
        return (
            abs(pressure_weight + last_pressure_weight) * last_rounding
            + abs(pressure_weight * depth_step + tangent_weight) * tangent_rounding
            + abs(pressure_weight) * added
        )
    return (
        abs(pressure_weight) * rounding
        + abs(last_pressure_weight) * last_rounding
        + abs(tangent_weight) * tangent_rounding
    )
