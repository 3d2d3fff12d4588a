"""Pressures on an indenter in a viscoelastic half-space at any time of any history, from elastic contacts.

With the forces φ(g, t) of the springs of the loading curve, per unit stiffness (docs/theory.md), the pressure is

    p(x, t) = −∫ q(x; A(g)) dφ(g, t)    [with a jump from φ(g*) to 0 at the last spring in contact, g*],

a sum of flat punches q = dp_el/du over the contact sets A(g) of loading. All springs that are pressed let go in the
reverse order, so that every weight is positive and the contact is A(g*).

1. The loading curve is computed up to the largest contact of the history, and its row of springs is moved.
2. Between two elastic contacts p_el is taken as linear in the force, so that each interval adds its part of the force
   times the difference of their pressures over that of their forces. The sum of the pressures is then F(t) exactly.
3. The force φ(g*) on the whole contact is distributed as q(A(g*)). In media with a parallel dashpot the rest of φ is
   linear in g, so that one further contact is enough.
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
from viscorough.results.loading_curve import LoadingCurve
from viscorough.surfaces.indenter import Indenter
from viscorough.viscous.kinetics import row_motion

# An interval between contacts is short if the force increases by less than this multiple of the tolerance of the
# contacts, of which at least _FINEST counts: the difference of two computed pressures would consist of their errors.
_SHORT, _FINEST = 10.0, 1e-6
# The curve ends at this multiple of the largest elastic force of the history: steps in time may go beyond it at first.
_BEYOND = 1.1
# State just after a time: at this share of the duration after it.
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
    """Pressure p on an indenter in a viscoelastic half-space at one time, in Pa or the unit of the moduli.

    Parameters
    ----------
    indenter : Indenter
        Indenter with two-dimensional heights.
    force : float or str or Load
        The constant force F > 0 from t = 0 on; or a Load, which may prescribe the depth instead.
    medium : Medium or float or str
        Medium as in `kinetics`.
    time : float
        t, within the history, after its start. p is the pressure just after it, also at a step; in a springpot and in
        media with a parallel dashpot a step of the force is carried as by a flat punch of the shape of the contact.
    contacts : int, optional
        Number of elastic contacts, 1 or more. Increase it for a smaller error of the pressures, which is of second
        order in 1/contacts in the mean over the elements. Media with a parallel dashpot (Newtonian, Kelvin-Voigt) need
        the contact at t alone, and have no such error.
    tolerance : float, optional
        Relative accuracy of the elastic contacts.

    Returns
    -------
    array
        Map of the shape of the heights, nan outside the indenter, 0 outside the contact. Its sum times the area of an
        element is F(t) for any number of contacts.

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
    curve = _curve(indenter, medium, load, tolerance)
    row, moved = row_motion(curve, medium, load)
    total = np.where(np.isnan(indenter.heights), np.nan, 0.0)
    count = int(moved.in_contact[-1])
    if count == 0:
        return total
    # The pressure of the row at the gap of each spring in contact, and the elastic force and stiffness there.
    carried, stiffness = moved.pressures[:count], np.cumsum(row.stiffness)[:count]
    elastic = np.append(0.0, np.cumsum(stiffness[:-1] * np.diff(row.gap[:count])))
    parts = stiffness[:-1] * -np.diff(carried)  # of the force, between neighbouring springs
    has_dashpot = medium.relaxation is not None and medium.relaxation.viscosity > 0
    nodes = np.unique([0, count - 1]) if has_dashpot else _nodes(elastic, parts, contacts)
    pressure = _PressureSum(indenter, tolerance / 2)  # the correction to the force takes the other half
    pressure.add_intervals(elastic[nodes], np.add.reduceat(np.append(parts, 0.0), nodes[:-1]), tolerance)
    # The last spring is in contact just beyond its gap.
    following = min(row.gap[count] if count < row.gap.size else row.limit, 2 * row.gap[count - 1] + curve.depth[0])
    pressure.add_rest(elastic[-1] + 0.5 * stiffness[-1] * (following - row.gap[count - 1]), moved.force[-1])
    return pressure.total


class _PressureSum:
    """Sum of the pressures of elastic contacts, each with its share of the force.

    total : map of the sum, shape of the heights, nan outside the indenter
    """

    def __init__(self, indenter: Indenter, tolerance: float) -> None:
        self.total = np.where(np.isnan(indenter.heights), np.nan, 0.0)
        self._area = indenter.spacing * indenter.row_spacing
        self._solver = ContactSolver(indenter, tolerance)
        self._search = ForceSearch(self._solver)

    def add_intervals(self, forces: Array, shares: Array, tolerance: float) -> None:
        """Add the pressures of intervals between elastic contacts.

        An interval from F_{j−1} to F_j adds its share of the force times (p_j − p_{j−1})/(F_j − F_{j−1}). If it is
        short, it adds the mean of the tangents q_j and q_{j−1} instead, each of them with the sum 1.

        forces : elastic forces F_j, the first of them that of the first contact, shape (intervals + 1,)
        shares : force of each interval; tolerance : relative accuracy of the elastic contacts
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
        """Add the tangent of the contact at an elastic force, so that the sum of the pressures carries `force`."""
        self.total = np.maximum(self.total, 0.0)  # it may be negative by rounding
        loads = self._search.contact_at(elastic).member_loads()
        self._add_tangent(loads, max(force - np.nansum(self.total) * self._area, 0.0))

    def _add_tangent(self, loads: MemberLoads, force: float) -> None:
        """Add the pressures of a flat punch of the shape of a contact that carries this force."""
        place = self._solver.elements.places_on_map(loads.members)
        self.total[place] += force / self._area * loads.tangent / loads.tangent.sum()


def _up_to(load: Load, time: float) -> Load:
    """Return the load up to just after a time, where the state after a kink or a step has settled.

    After its end a force is held. A depth ends there, so that its last rate counts.
    """
    after = time + _JUST_AFTER * (time - load.time[0])
    if after > load.time[-1]:
        if load.by_depth:
            return load
        return Load(np.append(load.time, after), force=np.append(load.values, load.values[-1]))
    longer, place = load.with_times([time, after])
    until = slice(int(place[-1]) + 1)
    return Load(longer.time[until], **{"depth" if load.by_depth else "force": longer.values[until]})


def _curve(indenter: Indenter, medium: Medium, load: Load, tolerance: float) -> LoadingCurve:
    """Return the loading curve of an indenter up to the largest contact of a history."""
    if load.by_depth:
        deepest = load.values.max()
        force = np.inf
        if deepest > 0:
            force = contact_at(indenter, depth=float(deepest), tolerance=tolerance).force
    else:
        force = creep_response(medium, load).creep.max()
    if not 0 < force < np.inf:  # nothing is touched
        return indent(indenter, tolerance=tolerance, until_fraction=1 / indenter.elements)
    return indent(indenter, tolerance=tolerance, until_force=_BEYOND * force)


def _nodes(elastic: Array, parts: Array, contacts: int) -> Integers:
    """Return the indices of springs between which p_el is taken as linear in the force, the first and last ones too.

    They lie at equal steps of the sum of the elastic force and of the force carried up to a spring, both relative to
    their last values: p changes with both.
    """
    carried = np.append(0.0, np.cumsum(np.maximum(parts, 0.0)))
    tiny = np.finfo(float).tiny
    measure = elastic / max(elastic[-1], tiny) + carried / max(carried[-1], tiny)
    graded = np.searchsorted(measure, np.linspace(0, measure[-1], contacts + 1))
    return np.unique(np.clip(np.append(graded, [0, elastic.size - 1]), 0, elastic.size - 1))
