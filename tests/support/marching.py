"""Direct integration with its complete results: numbers of elements in contact, and pressures at the last time."""

from types import SimpleNamespace

import numpy as np

from viscorough import Load, march
from viscorough.viscous.integration.internal_variables import integrate_steps


def stepped(indenter, medium, times, **load):
    """Return the motion by implicit steps under a `force` or at a `depth`, with `contact_count` and `pressure`."""
    motion, pressure = integrate_steps(indenter, medium, Load(times, **load))
    return _with_count(motion, indenter, pressure=pressure)


def evented(indenter, viscosity, times, force):
    """Return the motion in a Newtonian medium from contact event to contact event, with `contact_count`."""
    return _with_count(march(indenter, Load(times, force=force), viscosity, method="events"), indenter)


def _with_count(motion, indenter, **more):
    count = np.rint(motion.contact_fraction * indenter.elements).astype(int)
    return SimpleNamespace(**vars(motion), contact_count=count, **more)
