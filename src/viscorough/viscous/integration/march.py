"""Direct integration of the viscoelastic contact problem in time, by steps or from contact event to contact event."""

import numpy as np

from viscorough.basics.errors import ConvergenceError
from viscorough.basics.types import Progress
from viscorough.media.load import Load
from viscorough.media.medium import Medium
from viscorough.results.motion import Motion
from viscorough.surfaces.indenter import Indenter
from viscorough.viscous.integration.events import newtonian_events
from viscorough.viscous.integration.internal_variables import check_overflow, checked_input, integrate_steps

METHODS = ("implicit", "events")


def march(
    indenter: Indenter,
    load: Load,
    medium: Medium | float,
    *,
    method: str = "implicit",
    until_fraction: float = 1.0,
    progress: Progress | None = None,
) -> Motion:
    """Integrate the viscoelastic contact problem in time.

    The method never uses the loading curve, so it serves as an independent check of `kinetics`. Its cost grows with the
    third power of the number of elements in contact; use it for maps of up to about 65 x 65 elements.

    Parameters
    ----------
    indenter : Indenter
        Map of heights. Only elements that come into contact add to the cost.
    load : Load
        Depth [length] or force [N] over time [s], linear between samples. It may decrease. In a medium with a parallel
        dashpot (Newtonian, Kelvin-Voigt), a step of the depth must not press on the surface.
    medium : Medium or float
        Springs and dashpots (no Springpot), or the viscosity of a Newtonian medium [Pa s].
    method : {"implicit", "events"}, optional
        "implicit" solves one contact problem in each step, from one sample of the load to the next, for the pressures
        at its end. It is of second order in the time step. "events" proceeds from contact event to contact event. It is
        exact on the grid, but allows only forces on a Newtonian medium, whose contact never recedes.
    until_fraction : float, optional
        Contact fraction up to which "events" follows the contact, in (0, 1]. The method needs 8 (until_fraction ·
        elements)² bytes of memory.
    progress : Progress, optional
        Function that "implicit" calls after each step, with the share of the steps that is done.

    Returns
    -------
    Motion
        Time, depth, force, velocity and contact fraction at the samples of the load. An element stays in contact until
        its gap opens. Under no force the indenter rests on the surface; elements then count as in contact only if the
        whole previous contact still touches, as in a Newtonian medium. With "implicit", the velocity is the mean in the
        step after each time, `receding_from` is the end of a step, and in media with a parallel dashpot the force is
        the force just before each time.

    Raises
    ------
    ValueError
        For arguments out of range, and for the method "events" in other media and under a prescribed depth.
    ConvergenceError
        If a contact problem is not solved, or if more elements touch than `until_fraction` allows.
    MemoryError
        If the elements in contact are too many for the memory.

    Examples
    --------
    >>> import viscorough
    >>> disc = viscorough.self_affine_disc(0.7, 17, rms=0.01, seed=1)
    >>> load = viscorough.Load([0.0, 1.0, 2.0], force=[1.0, 1.0, 1.0])
    >>> viscorough.march(disc, load, medium=30.0, method="events").depth.round(4)
    array([0.    , 0.0247, 0.0369])
    """
    if method not in METHODS:
        raise ValueError(f"march: method {method!r}; allowed: {', '.join(METHODS)}")
    if method == "events":
        return _integrate_events(indenter, medium, load, until_fraction)
    return integrate_steps(indenter, medium, load, progress)[0]


def _integrate_events(indenter: Indenter, medium: Medium | float, load: Load, until_fraction: float) -> Motion:
    """Integrate the contact in a Newtonian medium under a force, exactly from contact event to contact event.

    until_fraction : contact fraction up to which events are followed

    Raises ConvergenceError if more elements touch than `until_fraction` allows.
    """
    relaxation, times, force = checked_input(indenter, medium, load)
    if load.by_depth or not relaxation.viscosity or relaxation.relaxed_modulus:
        found = "load of a depth" if load.by_depth else "a medium that is not Newtonian"
        raise ValueError(
            f"march: argument method='events', {found}; allowed: a force on a Newtonian medium, or "
            "argument method='implicit'"
        )
    impulse = load.integral / relaxation.viscosity
    check_overflow(impulse)
    events = newtonian_events(indenter, until_fraction=until_fraction)
    if impulse[-1] > events.impulse[-1] and events.contact_count[-1] < events.elements:
        raise ConvergenceError(
            f"march: {events.contact_count[-1]} elements touch before time {times[-1]:.6g}; a larger "
            "argument until_fraction is needed"
        )
    last_event = events.event_at(impulse)
    fraction = np.where(impulse > 0, events.contact_count[last_event], 0) / events.elements
    velocity = force / (relaxation.viscosity * events.resistance[last_event])
    return Motion(times, events.depth_at(impulse), force, velocity, fraction, indenter.length_unit)
