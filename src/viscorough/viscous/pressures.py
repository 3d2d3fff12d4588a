"""Pressures on an indenter in a viscoelastic half-space, from elastic contacts at a sequence of forces.

While the contact does not recede, p(x, t) = ∫ ψ(t − s) d[p_el(x; Φ(s))/G], with the pressure p_el of the elastic
contact under the force F/G = Φ, the creep response.

Call W(s) = ∫₀ˢ ψ(t − s') dΦ(s') the force at time t if the depth were held from s on. It is known in closed form, and
W(t) = F(t) unless the medium has a parallel dashpot. Between two elastic contacts p_el is taken as linear in Φ, so that
each interval adds ΔW/ΔΦ times the difference of their pressures. The sum of the pressures is then F(t) exactly.

The remaining force F(t) − W(t) is distributed as q = dp_el/dF, the pressure of a flat punch of the shape of the
contact. It is carried by a parallel dashpot, or is a step of the force at t in a springpot, which the depth does not
follow at once.
"""

import numpy as np
from scipy.special import betainc

from viscorough import units
from viscorough.arrays import ForceHistory, jumps_and_slopes, whole_number
from viscorough.contact.prescribed_force import ForceSearch
from viscorough.contact.solver import ContactSolver, check_solvable
from viscorough.indenter import Indenter
from viscorough.types import Array, Integers
from viscorough.viscous.correspondence import consistent_force, impulses, resampled
from viscorough.viscous.creep_response import branch_states, creep_response
from viscorough.viscous.media import Springpot, medium_of
from viscorough.viscous.medium import Medium, RelaxationSpectrum, RetardationSpectrum

# Contacts are placed by the creep response at this many times per contact, at equal steps and at equal ratios from both
# ends of each interval between samples, the nearest at this distance relative to the interval.
_TIMES, _NEAREST = 8, 1e-14
# An interval between contacts is short if Φ increases by less than this multiple of the tolerance of the contacts, of
# which at least _FINEST counts: the difference of two computed pressures would consist of their errors.
_SHORT, _FINEST = 10.0, 1e-6


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
        Medium as in `kinetics`, except a CreepTable, for its ψ is not known.
    force : float or str or ForceHistory
        a number, the constant force F > 0 from t = 0 on; or a ForceHistory.
    time : float
        t, within the history, after its start. At a step of the force p is the pressure just after it; in a springpot
        and in media with a parallel dashpot the step is then carried as by a flat punch of the shape of the contact.
    contacts : int, optional
        Number of elastic contacts up to t, 1 or more; a step of the creep response adds up to two. Increase it for a
        smaller error of the pressures, which is of second order in 1/contacts in the mean over the elements. Media with
        a parallel dashpot (Newtonian, Kelvin-Voigt) need the contact at t alone, and have no such error.
    tolerance : float, optional
        Relative accuracy of the elastic contacts.

    Returns
    -------
    array
        Map of the shape of the heights, nan outside the indenter. Its sum times the area of an element is F(t) for any
        number of contacts: to rounding in the media of viscorough.viscous.media, to about 1e-3 in a user's subclass of
        Medium.

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
    tolerance = check_solvable("pressure_at", indenter, tolerance)
    medium, contacts = medium_of(medium, indenter.length_unit), whole_number("contacts", contacts, at_least=1)
    time = units.number(time, "s", indenter.length_unit, "time")
    if not isinstance(force, ForceHistory):
        force = impulses(np.full(2, units.number(force, "N", indenter.length_unit, "force")), [0.0, time])
    force = consistent_force(force, indenter.length_unit)
    start = force.times[0]
    if not start < time <= force.times[-1]:
        raise ValueError(
            f"time: {time}; allowed: within those of the force, above {start:g}, up to {force.times[-1]:g}"
        )
    times, load, creep, carried = _loading(medium, force, time, contacts)
    has_dashpot = medium.relaxation is not None and medium.relaxation.viscosity > 0
    nodes = np.array([times.size - 1]) if has_dashpot else _nodes(times, creep, carried, contacts)
    levels = creep[nodes]
    rise, share = np.diff(levels, prepend=0.0), np.diff(carried[nodes], prepend=0.0)
    # An interval adds ΔW/ΔΦ (p_j − p_{j−1}), or ΔW (q_j + q_{j−1})/2 if it is short; these are sums over the contacts.
    is_long = rise > _SHORT * max(tolerance, _FINEST) * levels
    modulus = np.where(is_long, share / np.where(is_long, rise, 1.0), 0.0)
    half = np.where(is_long, 0.0, 0.5 * share)
    of_pressure, of_tangent = modulus - np.append(modulus[1:], 0.0), half + np.append(half[1:], 0.0)
    solver = ContactSolver(indenter, tolerance / 2)  # the correction to the force takes the other half
    search, loads = ForceSearch(solver), solver.first_contact().member_loads()
    area = indenter.spacing * indenter.row_spacing
    total = np.where(np.isnan(indenter.heights), np.nan, 0.0)
    for level, pressure, tangent in zip(levels, of_pressure, of_tangent, strict=True):
        if level > 0:
            loads = search.contact_at(level).member_loads()
        place = solver.elements.places_on_map(loads.members)
        if level > 0 and pressure:
            total[place] += pressure * level / area * loads.pressure / loads.pressure.sum()
        total[place] += tangent / area * loads.tangent / loads.tangent.sum()
    remaining = max(load / area - np.nansum(total), 0.0)  # it may be negative by rounding
    total[place] += remaining * loads.tangent / loads.tangent.sum()
    return total


def _loading(medium: Medium, force: ForceHistory, time: float, contacts: int) -> tuple[Array, float, Array, Array]:
    """Return times up to `time`, the force at `time`, and Φ and W at these times, which are dense near the samples."""
    samples = np.unique(np.append(force.times[force.times < time], time))
    count = max(_TIMES * contacts // (samples.size - 1), 1)
    near = np.geomspace(0.5, _NEAREST, count)
    places = np.concatenate([np.linspace(0, 1, count + 1), near, 1 - near])
    between = samples[:-1, None] + np.diff(samples)[:, None] * places
    history, _ = resampled(force, np.unique(np.append(samples, between)))
    creep, _ = creep_response(medium, history)
    until = np.searchsorted(history.times, time, side="right")
    times, load, creep = history.times[:until], history.force[:until], np.maximum.accumulate(creep[:until])
    if medium.relaxation is not None and medium.retardation is not None:
        carried = _carried_by_branches(medium.relaxation, medium.retardation, times, load, creep)
    elif isinstance(medium, Springpot):
        carried = _carried_by_springpot(medium.exponent, force, times)
    else:
        lengths, lag = np.diff(times), time - times
        with np.errstate(divide="ignore", invalid="ignore"):
            mean = medium.relaxation_integral(lag[1:], lag[:-1]) / lengths
        mean = np.append(medium.relaxation_modulus(lag[0]), np.where(lengths > 0, mean, 0.0))
        carried = np.cumsum(mean * np.diff(creep, prepend=0.0))
    return times, load[-1], creep, carried


def _carried_by_branches(
    relaxation: RelaxationSpectrum, retardation: RetardationSpectrum, times: Array, force: Array, creep: Array
) -> Array:
    """Return W at the times, the last of them t, in a medium of springs and dashpots.

    The state of a Maxwell branch, ∫exp(−(s − s')/τ) dΦ(s'), is a sum of F and of the states z_j of the Kelvin-Voigt
    elements: φ τ F + Σ J_j τ/(θ_j − τ) z_j. A branch whose τ equals a θ_j to rounding has no strength.
    """
    _, left = branch_states(np.diff(times), force, retardation.times)
    apart = retardation.times - relaxation.times[:, None]
    factors = np.divide(retardation.compliances, apart, out=np.zeros_like(apart), where=apart != 0)
    states = relaxation.times * (retardation.fluidity * force[:, None] + left @ factors.T)
    decay = np.exp(-np.divide.outer(times[-1] - times, relaxation.times))
    return relaxation.relaxed_modulus * creep + (decay * states) @ relaxation.moduli


def _carried_by_springpot(exponent: float, force: ForceHistory, times: Array) -> Array:
    """Return W at the times, the last of them t, in a springpot of exponent a.

    At the time s, a unit step of the force at t₀ has left 1 − I(y; 1 − a, a), with the regularised incomplete beta
    function I and y = (t − s)/(t − t₀), and a unit slope has left (t − t₀) (1 − I(y; 1 − a, 1 + a)).
    """
    jumps, slopes = jumps_and_slopes(force.times, force.force)
    bends = np.diff(slopes, prepend=0.0, append=0.0)
    lag, carried = times[-1] - times, np.zeros(times.size)
    for start, jump, bend in zip(force.times, jumps, bends, strict=True):
        if start < times[-1]:
            y, rest = np.minimum(lag / (times[-1] - start), 1.0), times[-1] - start
            carried -= jump * betainc(1 - exponent, exponent, y) + bend * rest * betainc(1 - exponent, 1 + exponent, y)
    return carried - carried[0]


def _nodes(times: Array, creep: Array, carried: Array, contacts: int) -> Integers:
    """Return the indices of the times of the elastic contacts.

    They lie at equal steps of the sum of Φ and W, both relative to their values at t. This grading keeps the error of
    second order although Φ and ψ are singular in a springpot. Both ends of a step of Φ are nodes.
    """
    measure = sum(np.maximum.accumulate(values) / max(values[-1], np.finfo(float).tiny) for values in (creep, carried))
    graded = np.searchsorted(measure, np.linspace(measure[0], measure[-1], contacts + 1))
    steps = np.flatnonzero((np.diff(times) == 0) & (np.diff(creep) > 0))
    return np.unique(np.concatenate([graded, steps, steps + 1, [times.size - 1]]))
