"""Replace the values of a row of springs by values of the interpolated loading curve.

A row has finitely many springs, so its stiffness jumps at every touch. While the contact is as large as ever before,
the correspondence with the elastic problem holds: the sum Σ W y of the row is the creep response Φ, and depth and
velocity follow from the interpolated curve at the force F/G = Φ. All other values are the values of the row.

A springpot, and other media with J(0) = 0, do not move at once at a step of the force. The springs and dashpots that
replace them have a very stiff spring, so that the values just after a step or a kink of the load are set here.
"""

from typing import NamedTuple

import numpy as np

from viscorough.basics.types import Array, Mask
from viscorough.media.load import Load
from viscorough.media.medium import Medium
from viscorough.media.spectra import Spectrum
from viscorough.results.loading_curve import LoadingCurve
from viscorough.viscous.move import RowMotion
from viscorough.viscous.row import ROUNDING, RowOfSprings, elements_in_contact


class RefinedMotion(NamedTuple):
    """Motion of an indenter at the samples of a load, in consistent units; arrays of shape (samples,).

    Values that depend on the unknown curve before its first level are nan.
    """

    depth: Array
    force: Array
    velocity: Array
    contact_fraction: Array


def refine(
    curve: LoadingCurve, row: RowOfSprings, medium: Medium, spectrum: Spectrum, load: Load, moved: RowMotion
) -> RefinedMotion:
    """Return the motion of an indenter from the motion of its row of springs.

    curve, row : loading curve of the indenter, and the row of springs with this curve
    medium, spectrum : medium, and the springs and dashpots that represent it
    load, moved : load, and the motion of the row under this load
    """
    stiff = spectrum.instantaneous > 0 and medium.creep_compliance(0.0) == 0
    if load.by_depth:
        refined = _at_depth(curve, row, spectrum, load, moved)
        return _after_steps_of_depth(load, refined) if stiff else refined
    refined = _under_force(curve, row, spectrum, load, moved, stiff=stiff)
    return _after_steps_of_force(medium, load, refined) if stiff else refined


def _at_depth(
    curve: LoadingCurve, row: RowOfSprings, spectrum: Spectrum, load: Load, moved: RowMotion
) -> RefinedMotion:
    """Return the motion at a prescribed depth."""
    count, force = moved.in_contact, moved.force
    if spectrum.viscosity > 0:
        # The force of a dashpot is η k u', with the stiffness k. The total stiffness of the springs jumps when a spring
        # touches, so replace it by the stiffness of the curve.
        at_curve = curve.at_depth(np.maximum(moved.depth, 0.0))[1]
        excess = spectrum.viscosity * moved.velocity * (at_curve - _stiffness_in_contact(row, moved))
        corrected = moved.largest & (force > 0) & np.isfinite(excess)
        force = np.where(corrected, np.maximum(force + excess, 0.0), force)
    front = np.where(moved.largest, moved.depth, _front(row, moved))
    unknown = (count > 0) & (front > 0) & (front < row.first_depth) & (moved.force > 0)
    fraction = _contact_fraction(curve, row, load, moved, moved.depth)
    return RefinedMotion(moved.depth, np.where(unknown, np.nan, force), moved.velocity, fraction)


def _under_force(
    curve: LoadingCurve, row: RowOfSprings, spectrum: Spectrum, load: Load, moved: RowMotion, *, stiff: bool
) -> RefinedMotion:
    """Return the motion under a prescribed force.

    stiff : whether the medium has no instantaneous response, although `spectrum` has. A change of the slope of the
        force then changes the velocity only gradually
    """
    count, corrected = moved.in_contact, moved.largest & np.isfinite(moved.depth)
    at_curve, stiffness = _at_elastic_force(curve, row, np.maximum(moved.deflection, 0.0))
    rate = moved.velocity * _stiffness_in_contact(row, moved)
    if stiff:
        rate = rate - spectrum.instantaneous * _changes_of_slope(load)
    # An indenter at rest has the velocity 0, even before the first level of the curve, where the stiffness is nan.
    moving = np.where(corrected, stiffness, _stiffness_in_contact(row, moved))
    velocity = np.divide(rate, moving, out=np.zeros_like(rate), where=rate != 0)
    depth = np.where(corrected, at_curve, moved.depth)
    front = _front(row, moved)
    unknown = ~corrected & (count > 0) & (front > 0) & (front < row.first_depth) & (moved.force > 0)
    depth, velocity = (np.where(unknown, np.nan, values) for values in (depth, velocity))
    return RefinedMotion(depth, moved.force, velocity, _contact_fraction(curve, row, load, moved, at_curve))


def _at_elastic_force(curve: LoadingCurve, row: RowOfSprings, creep: Array) -> tuple[Array, Array]:
    """Return depth and stiffness k/G of the loading curve at the force F/G = `creep`.

    After complete contact, the depth continues along the tangent of the last level.

    creep : creep response Φ
    """
    first, last = curve.force[0], curve.force[-1]
    # Rounding must not move a force at the first or last computed point out of the range of the curve.
    inside = np.where(np.abs(creep - first) <= ROUNDING * first, first, np.clip(creep, 0.0, last))
    depth, stiffness = curve.at_force(inside)
    beyond = creep > last * (1 + ROUNDING)
    return np.where(beyond, depth + (creep - last) / row.stiffness.sum(), depth), stiffness


def _stiffness_in_contact(row: RowOfSprings, moved: RowMotion) -> Array:
    """Return the sum of the stiffnesses of the springs in contact at each sample."""
    return np.append(0.0, np.cumsum(row.stiffness))[moved.in_contact]


def _front(row: RowOfSprings, moved: RowMotion) -> Array:
    """Return the gap of the last spring in contact at each sample; 0 without contact."""
    return np.where(moved.in_contact > 0, row.gap[np.maximum(moved.in_contact, 1) - 1], 0.0)


def _contact_fraction(curve: LoadingCurve, row: RowOfSprings, load: Load, moved: RowMotion, front: Array) -> Array:
    """Return the share of the elements that are in contact at each sample.

    front : depth of the curve at which the contact is as large as at each sample; used only where `moved.largest`
    """
    count = moved.in_contact
    touched = np.where(count > 0, row.contact_fraction[np.maximum(count, 1) - 1], 0.0)
    known = np.where(moved.largest & (count > 0) & np.isfinite(front), front, 0.0)
    fraction = np.maximum(touched, elements_in_contact(curve, known) / curve.elements)
    if load.by_depth:
        return fraction
    # Under no force the indenter rests on the first spring, which does not count as contact.
    return np.where((load.values == 0) & (count <= 1), 0.0, fraction)


def _changes_of_slope(load: Load) -> Array:
    """Return the slope of the load just after each sample minus the slope just before it.

    It is 0 at the samples whose velocity is the velocity just before them.
    """
    changes = np.append(load.slopes, 0.0) - np.append(0.0, load.slopes)
    return np.where(_is_before_step(load), 0.0, changes)


def _is_before_step(load: Load) -> Mask:
    """Return True for the last sample, and for the first of the two samples of a step."""
    return np.diff(load.time, append=load.time[-1]) == 0


def _after_steps_of_depth(load: Load, refined: RefinedMotion) -> RefinedMotion:
    """Set the force just after steps of the depth, in a medium with J(0) = 0.

    A step into the surface needs an infinite force. After a step out of the surface there is no force.
    """
    steps, pressed = load.jumps != 0, load.jumps > 0
    force = np.where(pressed & (refined.contact_fraction > 0), np.inf, np.where(steps, 0.0, refined.force))
    return refined._replace(force=force, contact_fraction=np.where(steps & ~pressed, 0.0, refined.contact_fraction))


def _after_steps_of_force(medium: Medium, load: Load, refined: RefinedMotion) -> RefinedMotion:
    """Keep depth and contact at steps of the force, in a medium with J(0) = 0."""
    steps = load.jumps != 0
    depth, fraction = (
        np.where(steps, np.append(0.0, values[:-1]), values) for values in (refined.depth, refined.contact_fraction)
    )
    velocity = refined.velocity
    if np.isinf(medium.creep_rate(0.0)):
        velocity = np.where(steps, np.copysign(np.inf, load.jumps), velocity)
    return refined._replace(depth=depth, velocity=velocity, contact_fraction=fraction)
