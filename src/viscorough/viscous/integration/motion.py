"""Direct integrations of the viscous problem as motions over time, for a given force and viscosity."""

import numpy as np

from viscorough.arrays import ForceHistory
from viscorough.types import Array
from viscorough.viscous.integration.events import Events
from viscorough.viscous.integration.stepping import Steps


def under_constant_force(integration: Events | Steps, force_per_viscosity: float) -> dict[str, Array]:
    """Time, depth, contact count, overlap over depth, and velocity of Events or Steps, by name.

    force_per_viscosity : F/η; the impulse over the viscosity is t F/η, and the velocity F/η over the resistance
    """
    time, velocity = integration.impulse / force_per_viscosity, force_per_viscosity / integration.resistance
    overlap = np.zeros_like(integration.depth) if isinstance(integration, Events) else integration.overlap
    depth, count = integration.depth, integration.contact_count
    return {"time": time, "depth": depth, "contact_count": count, "overlap": overlap, "velocity": velocity}


def under_force_history(integration: Events | Steps, history: ForceHistory, viscosity: float) -> dict[str, Array]:
    """Time, depth, contact count, force and velocity of Events or Steps at the times of a force history, by name.

    integration : Events, or Steps that end at every impulse of the history above zero, over the viscosity
    history : arrays.ForceHistory

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
    motion = {"time": history.times, "depth": depth, "contact_count": integration.contact_count[i]}
    return motion | {"force": history.force, "velocity": velocity}
