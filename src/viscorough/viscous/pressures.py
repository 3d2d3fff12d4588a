"""Pressures on an indenter in a viscoelastic half-space at any time of any history, from elastic contacts.

The loading curve is equivalent to a row of independent springs (docs/theory.md). The spring with initial gap g has the
force φ(g, t) per unit stiffness, and the last spring in contact has the gap g*. Let A(g) be the set of elements in
contact in the elastic problem at depth g, and q(x; A) = dp_el/du the pressure of a flat punch of the shape A at unit
depth. Then the pressure at point x is

    p(x, t) = −∫ q(x; A(g)) dφ(g, t),

where φ jumps from φ(g*) to 0 at g*. This is a sum of pressures of flat punches with the weights −dφ. Springs are
released in the reverse order of touching, so every weight is positive, and the contact set is A(g*). The sum is
computed in three steps:

1. Compute the loading curve up to the largest contact of the history, and the motion of the equivalent springs.
2. Choose some elastic contacts. Between two successive contacts, p_el is taken to be linear in the force F_el, so this
   interval adds the pressure ΔF · Δp_el/ΔF_el. Here Δp_el and ΔF_el are the differences between the two contacts, and
   ΔF is the part of the force F that the interval carries. The sum of all pressures is then exactly F(t).
3. Distribute the force due to φ(g*), which acts on the whole contact, like q(x; A(g*)). In media with a parallel
   dashpot φ is linear in g apart from this force, so that step 2 needs only a single interval.
"""

import numpy as np

from viscorough.basics import units
from viscorough.basics.arrays import whole_number
from viscorough.basics.types import Array, Integers
from viscorough.contact.argument_checks import check_solvable
from viscorough.contact.loading_path import indent
from viscorough.contact.one_contact import contact_at
from viscorough.contact.prescribed_depth import ContactSolver
from viscorough.contact.prescribed_force import ForceSearch
from viscorough.contact.state import MemberLoads
from viscorough.media.creep_response import creep_response
from viscorough.media.kinds import medium_of
from viscorough.media.load import Load, force_load
from viscorough.media.medium import Medium
from viscorough.media.spectra import Spectrum
from viscorough.results.loading_curve import LoadingCurve
from viscorough.surfaces.indenter import Indenter
from viscorough.viscous.kinetics import row_motion
from viscorough.viscous.row import row_of_springs

# An interval between two elastic contacts is short if the relative increase of the force in the interval is at most
# _SHORT times the tolerance of the contacts. A tolerance below _FINEST counts as _FINEST. In a short interval, the
# difference of the two pressures would consist of their errors.
_SHORT, _FINEST = 10.0, 1e-6
# The loading curve is computed up to this multiple of the largest elastic force of the history.
_BEYOND = 1.1
# The state just after a time is computed slightly later. The delay is this share of the time since the start of the
# load.
_JUST_AFTER = 1e-12


def pressure_at(
    indenter: Indenter,
    force: float | str | Load,
    medium: Medium | float | str,
    time: float,
    *,
    contacts: int = 64,
    tolerance: float = 1e-4,
) -> Array:
    """Return the pressure p on an indenter in a viscoelastic half-space at one time, in Pa or the unit of the moduli.

    Parameters
    ----------
    indenter : Indenter
        Indenter with two-dimensional heights.
    force : float or str or Load
        Constant force F > 0 that acts from t = 0 on; or a Load, which may prescribe the depth instead.
    medium : Medium or float or str
        Medium, or the viscosity of a Newtonian medium; see `kinetics`.
    time : float
        Time t within the history, after its start. The pressure is the limit just after t, also at a step. In a
        springpot and in media with a parallel dashpot, the pressure due to a step of the force is the pressure of a
        flat punch of the shape of the contact.
    contacts : int, optional
        Number of elastic contacts from which the pressure is computed, 1 or more. Increase it for a smaller error of
        the pressures. The error, averaged over the elements, is of second order in 1/contacts. In media with a parallel
        dashpot (Newtonian, Kelvin-Voigt), only the contact at t is needed, and there is no such error.
    tolerance : float, optional
        Relative accuracy of the elastic contacts.

    Returns
    -------
    array
        Map of pressures with the shape of the heights, nan outside the indenter and 0 outside the contact. The sum of
        the map, multiplied by the area of an element, is F(t) for any number of contacts.

    Raises
    ------
    ValueError
        For arguments out of range.

    Examples
    --------
    >>> import viscorough
    >>> disc = viscorough.self_affine_disc(0.7, 17, rms=0.01, seed=1)
    >>> pressure = viscorough.pressure_at(disc, force=1.0, medium=30.0, time=2.0)
    >>> pressure.shape
    (17, 17)
    """
    tolerance = check_solvable("pressure_at", indenter, tolerance)
    if isinstance(force, Medium):
        text = f"pressure_at: force: {type(force).__name__}; a force or a viscorough.Load is needed, before the medium"
        raise TypeError(text)
    unit = indenter.length_unit
    medium, contacts = medium_of(medium, unit), whole_number("contacts", contacts, at_least=1)
    time = units.number(time, "s", unit, "time")
    load = force.in_units_of(unit) if isinstance(force, Load) else force_load(force, np.array([time]), unit)
    start = load.time[0]
    if not start < time <= load.time[-1]:
        raise ValueError(f"time: {time}; allowed: within those of the load, above {start:g}, up to {load.time[-1]:g}")
    load = _up_to(load, time)
    spectrum, _ = medium.spectrum(load)
    curve = _curve(indenter, spectrum, load, tolerance)
    row = row_of_springs(curve, load)
    moved = row_motion(curve, row, spectrum, load)
    total = np.where(np.isnan(indenter.heights), np.nan, 0.0)
    count = int(moved.in_contact[-1])
    if count == 0:
        return total
    # For each spring in contact: its force per unit stiffness, and the stiffness and elastic force of the curve at its
    # gap.
    carried, stiffness = moved.pressures[:count], np.cumsum(row.stiffness)[:count]
    elastic = np.append(0.0, np.cumsum(stiffness[:-1] * np.diff(row.gap[:count])))
    parts = stiffness[:-1] * -np.diff(carried)  # parts of the force F, between neighbouring springs
    nodes = np.unique([0, count - 1]) if spectrum.viscosity > 0 else _nodes(elastic, parts, contacts)
    # Compute the contacts to half of the tolerance. The other half is left for the correction of the pressures to the
    # exact force.
    pressure = _PressureSum(indenter, tolerance / 2)
    pressure.add_intervals(elastic[nodes], np.add.reduceat(np.append(parts, 0.0), nodes[:-1]), tolerance)
    # Use the elastic contact halfway to the gap of the next spring instead of the contact at g*, so that the last
    # spring is in contact.
    following = min(row.gap[count] if count < row.gap.size else row.limit, 2 * row.gap[count - 1] + curve.depth[0])
    pressure.add_rest(elastic[-1] + 0.5 * stiffness[-1] * (following - row.gap[count - 1]), moved.force[-1])
    return pressure.total


class _PressureSum:
    """Sum of the pressures of elastic contacts, each multiplied by a weight.

    total : map of the sum, with the shape of the heights; nan outside the indenter
    """

    def __init__(self, indenter: Indenter, tolerance: float) -> None:
        self.total = np.where(np.isnan(indenter.heights), np.nan, 0.0)
        self._area = indenter.spacing * indenter.row_spacing
        self._solver = ContactSolver(indenter, tolerance)
        self._search = ForceSearch(self._solver)

    def add_intervals(self, forces: Array, shares: Array, tolerance: float) -> None:
        """Add the pressures of the intervals between successive elastic contacts.

        An interval between the contacts at the forces F_{j−1} and F_j adds s (p_j − p_{j−1})/(F_j − F_{j−1}), where s
        is the part of the force F that it carries. A short interval (see _SHORT) adds s (q_{j−1} + q_j)/2 instead,
        where q is dp/du of a contact, scaled to the sum 1.

        forces : elastic forces F_j of the contacts; the first is 0, at first contact; shape (intervals + 1,)
        shares : part s of the force F for each interval, shape (intervals,)
        tolerance : relative accuracy of the elastic contacts
        """
        rise, levels = np.diff(forces), forces[1:]
        is_long = rise > _SHORT * max(tolerance, _FINEST) * levels
        slope = np.where(is_long, shares / np.where(is_long, rise, 1.0), 0.0)
        half = np.where(is_long, 0.0, 0.5 * shares)
        by_pressure, by_tangent = slope - np.append(slope[1:], 0.0), half + np.append(half[1:], 0.0)
        if half.size:
            self._add_tangent(self._solver.first_contact().member_loads(), half[0])
        for level, pressure, tangent in zip(levels, by_pressure, by_tangent, strict=True):
            loads = self._search.contact_at(level).member_loads()
            place = self._solver.elements.places_on_map(loads.members)
            self.total[place] += pressure * level / self._area * loads.pressure / loads.pressure.sum()
            self._add_tangent(loads, tangent)

    def add_rest(self, elastic: float, force: float) -> None:
        """Add the pressure of a flat punch, so that the sum of all pressures carries `force`.

        elastic : elastic force of the contact whose shape the punch has
        """
        self.total = np.maximum(self.total, 0.0)  # rounding may make a pressure negative
        loads = self._search.contact_at(elastic).member_loads()
        self._add_tangent(loads, max(force - np.nansum(self.total) * self._area, 0.0))

    def _add_tangent(self, loads: MemberLoads, force: float) -> None:
        """Add the pressure of a flat punch that carries `force`.

        loads : loads of the elastic contact whose shape the punch has
        """
        place = self._solver.elements.places_on_map(loads.members)
        self.total[place] += force / self._area * loads.tangent / loads.tangent.sum()


def _up_to(load: Load, time: float) -> Load:
    """Cut the load just after a time, so that a kink or a step at this time is included.

    If the load ends at this time, a force is continued with its last value. A depth is not continued, so that the
    velocity before the end counts.
    """
    after = time + _JUST_AFTER * (time - load.time[0])
    if after > load.time[-1]:
        if load.by_depth:
            return load
        return Load(np.append(load.time, after), force=np.append(load.values, load.values[-1]))
    longer, place = load.with_times([time, after])
    until = slice(int(place[-1]) + 1)
    return Load(longer.time[until], **{"depth" if load.by_depth else "force": longer.values[until]})


def _curve(indenter: Indenter, spectrum: Spectrum, load: Load, tolerance: float) -> LoadingCurve:
    """Return the loading curve of an indenter up to the largest contact during the load."""
    if load.by_depth:
        deepest = load.values.max()
        force = np.inf
        if deepest > 0:
            force = contact_at(indenter, depth=float(deepest), tolerance=tolerance).force
    else:
        force = creep_response(spectrum, load).max()
    if not 0 < force < np.inf:  # there is no contact during the load
        return indent(indenter, tolerance=tolerance, until_fraction=1 / indenter.elements)
    return indent(indenter, tolerance=tolerance, until_force=_BEYOND * force)


def _nodes(elastic: Array, parts: Array, contacts: int) -> Integers:
    """Return the indices of the springs at whose gaps elastic contacts are computed, first and last spring included.

    Between two of these springs, p_el is taken to be linear in the force. The pressure changes with the elastic force
    at the gap of a spring, and with the part of the force F up to this spring. So both are divided by their values at
    the last spring, and the chosen springs lie at equal steps of the sum of the two ratios.

    elastic : elastic force at the gap of each spring
    parts : parts of the force F between neighbouring springs
    """
    carried = np.append(0.0, np.cumsum(np.maximum(parts, 0.0)))
    tiny = np.finfo(float).tiny
    measure = elastic / max(elastic[-1], tiny) + carried / max(carried[-1], tiny)
    graded = np.searchsorted(measure, np.linspace(0, measure[-1], contacts + 1))
    return np.unique(np.clip(np.append(graded, [0, elastic.size - 1]), 0, elastic.size - 1))
