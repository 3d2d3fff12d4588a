"""Pressures on an indenter in a viscoelastic half-space, from elastic contacts at a sequence of forces.

While the contact does not recede, p(x, t) = ∫ ψ(t − s) d[p_el(x; Φ(s))/G], with the pressure p_el of the elastic
contact under the force F/G = Φ, the creep of the force. A parallel dashpot carries what the other parts of the medium
leave of the force, distributed as dp_el/dF, the pressure of a flat punch of the shape of the contact.
"""

import numpy as np

from viscorough import units
from viscorough.arrays import ForceHistory
from viscorough.contact.prescribed_force import ForceSearch
from viscorough.contact.solver import ContactSolver, check_solvable
from viscorough.indenter import Indenter
from viscorough.types import Array
from viscorough.viscous.correspondence import consistent_force, impulses, resampled
from viscorough.viscous.creep_response import creep_response
from viscorough.viscous.media import medium_of
from viscorough.viscous.medium import Medium


def pressure_at(
    indenter: Indenter,
    medium: Medium | float | str,
    force: float | str | ForceHistory,
    time: float,
    *,
    contacts: int = 64,
    tolerance: float = 1e-4,
) -> Array:
    """Pressure p on an indenter in a viscoelastic half-space at one time, in Pa or the unit of the moduli.

    Parameters
    ----------
    indenter : Indenter
        Indenter with two-dimensional heights.
    medium : Medium or float or str
        As in kinetics, but no CreepTable, whose ψ is not known.
    force : float or str or ForceHistory
        a number, the constant force F > 0 from t = 0 on; or a ForceHistory.
    time : float
        t, within the history; where the force steps, p is that after the step.
    contacts : int, optional
        Number of elastic contacts between the start of the force and t, besides those at its samples. Between them
        pressures are taken as linear in time: the error is of second order in 1/contacts. Media with a parallel dashpot
        (Newtonian, Kelvin-Voigt) need the contact at t alone, and have no such error.
    tolerance : float, optional
        Of the elastic contacts.

    Returns
    -------
    array
        Map of the shape of the heights, nan outside the indenter; its sum times the area of an element is F(t) up to
        the error in time, so that this shows its size.

    Raises
    ------
    ValueError
        For arguments out of range and, with the time, where the contact would recede.

    Examples
    --------
    >>> import viscorough
    >>> disc = viscorough.self_affine_disc(0.7, 17, rms=0.01, seed=1)
    >>> pressure = viscorough.pressure_at(disc, 30.0, force=1.0, time=2.0)
    >>> pressure.shape
    (17, 17)
    """
    medium = medium_of(medium, indenter.length_unit)
    check_solvable("pressure_at", indenter, tolerance)
    if not isinstance(force, ForceHistory):
        force = impulses(np.full(2, units.number(force, "N", indenter.length_unit, "force")), [0.0, time])
    force = consistent_force(force, indenter.length_unit)
    start = force.times[0]
    if not start < time <= force.times[-1]:
        raise ValueError(
            f"time: {time}; allowed: within those of the force, above {start:g}, up to {force.times[-1]:g}"
        )
    has_dashpot = medium.relaxation is not None and medium.relaxation.viscosity > 0
    between = 1 if has_dashpot else max(int(contacts), 1)
    history, _ = resampled(force, np.linspace(start, time, between + 1))
    creep, _ = creep_response(medium, history)
    until = np.searchsorted(history.times, time, side="right")
    times, creep = history.times[:until], np.maximum.accumulate(creep[:until])
    levels, place = np.unique(creep, return_inverse=True)
    # Weights of the elastic pressures at the times, without a dashpot's.
    lengths, lag = np.diff(times), time - times
    with np.errstate(divide="ignore", invalid="ignore"):
        mean = medium.relaxation_integral(lag[1:], lag[:-1]) / lengths
    change = np.where(lengths > 0, mean, medium.relaxation_modulus(lag[1:]))
    at_times = np.append(medium.relaxation_modulus(lag[0]), change) - np.append(change, 0.0)
    weights = np.bincount(place, at_times, levels.size)
    solver = ContactSolver(indenter, tolerance / 2)  # the correction to the force takes the other half
    search, loads = ForceSearch(solver), solver.first_contact().member_loads()
    total = np.where(np.isnan(indenter.heights), np.nan, 0.0)
    for level, weight in zip(levels, weights, strict=True):
        if level > 0 and (weight != 0 or level == levels[-1]):
            loads = search.contact_at(level).member_loads()
            total[solver.elements.places_on_map(loads.members)] += weight * solver.units.pressure * loads.pressure
    if has_dashpot:
        area = indenter.spacing * indenter.row_spacing
        missing = history.force[until - 1] / area - np.nansum(total)
        total[solver.elements.places_on_map(loads.members)] += missing * loads.tangent / loads.tangent.sum()
    return total
