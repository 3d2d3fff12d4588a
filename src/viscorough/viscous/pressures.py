"""Pressures on an indenter in a viscoelastic half-space, from elastic contacts at a sequence of forces.

While the contact does not recede, p(x, t) = ∫ ψ(t − s) d[p_el(x; Φ(s))/G], with the pressure p_el of the elastic
contact under the force F/G = Φ, the creep of the force.
"""

import numpy as np

from viscorough.contact.one_contact import contact_at
from viscorough.viscous.correspondence import ForceHistory, impulses, resampled
from viscorough.viscous.creep_response import creep_response
from viscorough.viscous.media import CreepTable, medium_of

# The last interval of a dashpot, over the whole time, and the tolerance of contacts whose difference is taken.
_LAST_SHARE, _OF_DIFFERENCES = 1e-3, 1e-8


def pressure_at(indenter, medium, force, time, *, contacts=64, tolerance=1e-4):
    """Pressure p on an indenter in a viscoelastic half-space at one time, in the unit of the moduli.

    indenter : Indenter with two-dimensional heights; medium : as in kinetics, but no CreepTable, whose ψ is not known
    force : a number, the constant force F > 0 from t = 0 on; or a ForceHistory
    time : t, within the history
    contacts : number of elastic contacts between the start of the force and t, besides those at its samples. Between
        them pressures are taken as linear in time: the error is of second order in 1/contacts, and the pressure of a
        dashpot (Newtonian, Kelvin-Voigt) is the mean over the last thousandth of the time
    tolerance : of the elastic contacts

    Returns a map of the shape of the heights, nan outside the indenter; its sum times the area of an element is F(t) up
    to the error in time, so that this shows its size. Raises ValueError for arguments out of range and, with the time,
    where the contact would recede.
    """
    medium = medium_of(medium)
    if isinstance(medium, CreepTable):
        raise ValueError("pressure_at: CreepTable; allowed: media whose relaxation is known, as a Prony series")
    if not isinstance(force, ForceHistory):
        force = impulses(np.full(2, float(force)), [0.0, time])
    start = force.times[0]
    if not start < time <= force.times[-1]:
        raise ValueError(
            f"time: {time}; allowed: within those of the force, above {start:g}, up to {force.times[-1]:g}"
        )
    between = np.linspace(start, time, max(int(contacts), 1) + 1)
    if viscous := hasattr(medium, "relaxation") and medium.relaxation.viscosity > 0:
        between = np.insert(between, -1, time - min(_LAST_SHARE * (time - start), 0.5 * (time - between[-2])))
    history, _ = resampled(force, between)
    creep, _ = creep_response(medium, history)
    until = np.searchsorted(history.times, time, side="right")
    times, creep = history.times[:until], np.maximum.accumulate(creep[:until])
    weights = _weights(medium, time, times)
    levels, place = np.unique(creep, return_inverse=True)
    total = np.where(np.isnan(indenter.heights), np.nan, 0.0)
    loaded = levels > 0
    if not loaded.any():
        return total
    if viscous:
        tolerance = min(tolerance, _OF_DIFFERENCES)
    weight_of_level = np.bincount(place, weights, levels.size)[loaded]
    elastic = contact_at(indenter, force=levels[loaded], tolerance=tolerance)
    for weight, contact in zip(weight_of_level, elastic, strict=True):
        total += weight * contact.pressure
    return total


def _weights(medium, time, times):
    """Weights of the elastic pressures at `times` in the pressure at `time`, the last of them."""
    lengths, lag = np.diff(times), time - times
    ramp, weights = lengths > 0, np.zeros(times.size)
    with np.errstate(divide="ignore", invalid="ignore"):
        if hasattr(medium, "relaxation"):
            viscosity, relaxed, moduli, relaxation_times = medium.relaxation
            x = lengths[:, None] / relaxation_times
            decays = -np.expm1(-x) / x * np.exp(-lag[1:, None] / relaxation_times)
            mean = relaxed + (moduli * np.where(ramp[:, None], decays, 0)).sum(axis=1)
            if viscosity and ramp[-1]:
                mean[-1] += viscosity / lengths[-1]
        else:
            mean = medium.relaxation_integral(lag[1:], lag[:-1]) / lengths
    change = np.where(ramp, mean, medium.relaxation_modulus(lag[1:]))
    weights[1:] += change
    weights[:-1] -= change
    weights[0] += medium.relaxation_modulus(lag[0])
    return weights
