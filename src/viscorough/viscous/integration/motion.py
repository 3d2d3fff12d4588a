"""Direct integrations of the viscous problem as motions over time, for a given force and viscosity."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from viscorough.viscous.integration.events import Events

if TYPE_CHECKING:
    from viscorough.viscous.correspondence import ForceHistory
    from viscorough.viscous.integration.stepping import Steps


class ViscousMotion(NamedTuple):
    """Penetration into a linearly viscous half-space; arrays of shape (times,).

    time : t [s]; depth : u [length]; contact_count : elements in contact
    overlap : the largest, over depth [1], or None under a force history; force : F [N], or None if it is constant
    velocity : v = du/dt [length/s]; length_unit : of the indenter
    """

    time: np.ndarray
    depth: np.ndarray
    contact_count: np.ndarray
    overlap: np.ndarray | None
    force: np.ndarray | None
    velocity: np.ndarray
    length_unit: str


def under_constant_force(integration: Events | Steps, force_per_viscosity: float) -> ViscousMotion:
    """ViscousMotion of Events or Steps: the impulse over the viscosity is t F/η, and the velocity F/η over resistance.

    force_per_viscosity : F/η
    """
    time, velocity = integration.impulse / force_per_viscosity, force_per_viscosity / integration.resistance
    overlap = np.zeros_like(integration.depth) if isinstance(integration, Events) else integration.overlap
    of_levels = time, integration.depth, integration.contact_count, overlap
    return ViscousMotion(*of_levels, None, velocity, integration.length_unit)


def under_force_history(integration: Events | Steps, history: ForceHistory, viscosity: float) -> ViscousMotion:
    """ViscousMotion of Events or Steps at the times of a force history.

    integration : Events, or Steps that end at every impulse of the history above zero, over the viscosity
    history : viscous.correspondence.ForceHistory

    Raises ValueError for an impulse beyond the last event.
    """
    reached = history.impulse / viscosity
    if isinstance(integration, Events):
        if reached[-1] > integration.impulse[-1] * (1 + 1e-10) and integration.contact_count[-1] < integration.elements:
            text = f"impulse: {history.impulse[-1]:.6g} is beyond the contact fraction at which events end"
            raise ValueError(f"{text}; allowed: up to {integration.impulse[-1] * viscosity:.6g}")
        i, depth = integration.event_at(reached), integration.depth_at(reached)
    else:
        i = np.searchsorted(integration.impulse, reached * (1 - 1e-12))
        depth = np.where(reached > 0, integration.depth[i], 0.0)
    velocity = history.force / (viscosity * integration.resistance[i])
    of_times = history.times, depth, integration.contact_count[i]
    return ViscousMotion(*of_times, None, history.force, velocity, integration.length_unit)
