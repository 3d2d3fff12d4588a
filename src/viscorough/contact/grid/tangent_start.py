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
    now: Loads, last: Loads, before: GridFields, contact_set: ContactSet, inner: slice, loops: GridLoops
) -> tuple[Array, BoundedField]:
    """The combination as initial q, and e_q = K q − 1 everywhere as a BoundedField.

    now, last : Loads after and before the step; before : the GridFields before it
    contact_set : the ContactSet after the step
    inner : slice of flat fields without the first and last rows of their border
    loops : GridLoops
    """
    weights = _weights(now, last, before, contact_set, loops)
    pressure_weight, last_pressure_weight, tangent_weight = weights
    shift = pressure_weight * now.depth + last_pressure_weight * last.depth + tangent_weight - 1
    tangent, tangent_gap = (field_to_fill(now.pressure.size, now.pressure.dtype, inner) for _ in range(2))
    fields = tangent, tangent_gap, *_known_fields(now, last, before)
    loops.each(kernels.combine, (weights, shift), *(field[inner] for field in fields))
    return tangent, BoundedField(tangent_gap, _rounding(weights, now, last, before.tangent_gap.rounding))


def _known_fields(now: Loads, last: Loads, before: GridFields) -> tuple[Array, ...]:
    """The fields that are combined, each with its deflection."""
    loads = now.pressure, now.gap_change.values, last.pressure, last.gap_change.values
    return *loads, before.tangent, before.tangent_gap.values


def _weights(
    now: Loads, last: Loads, before: GridFields, contact_set: ContactSet, loops: GridLoops
) -> tuple[float, float, float]:
    """Weights of pressure, last pressure and last tangent in the combination of them closest to q in energy."""
    fixed = (now.depth, last.depth), *_known_fields(now, last, before)
    energy, sums = (sum(parts) for parts in zip(*loops.each(kernels.energies, fixed, contact_set.places), strict=True))
    if loops.difference(before.inside, contact_set.inside).size:
        # An element left the contact, within the tolerance: fields that load it cannot be part of q.
        energy, sums = energy[:1, :1], sums[:1]
    scale = 1 / np.sqrt(np.maximum(np.diag(energy), np.finfo(float).tiny))
    # Least squares, since the loads may be multiples of each other.
    eigenvalues, vectors = np.linalg.eigh(scale[:, None] * energy * scale)
    independent = eigenvalues > _DEPENDENT * eigenvalues[-1]
    vectors = vectors[:, independent]
    weights = scale * (vectors @ ((scale * sums) @ vectors / eigenvalues[independent]))
    return *weights, *[0.0] * (3 - weights.size)


def _rounding(weights: tuple[float, float, float], now: Loads, last: Loads, tangent_rounding: float) -> float:
    """Bound on the rounding error of the combined e_q."""
    pressure_weight, last_pressure_weight, tangent_weight = weights
    rounding, last_rounding, depth_step = now.gap_change.rounding, last.gap_change.rounding, now.depth - last.depth
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
