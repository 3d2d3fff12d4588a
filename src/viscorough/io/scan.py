"""What a file states about a measured surface, and how that becomes an indenter."""

from typing import NamedTuple

import numpy as np

from viscorough import units
from viscorough.indenter import Indenter, positive
from viscorough.types import Array
from viscorough.units import Quantity

Distance = float | units.Quantity
Spacing = tuple[Distance, Distance]  # between columns and between rows
_AGREEMENT = 1e-3  # relative difference up to which a spacing that is given agrees with the file's
_UNIFORMITY = 1e-2  # deviation from equal spacing that rounding of coordinates may cause, relative to the spacing


class Scan(NamedTuple):
    """A map of heights as its file states it; rows are along y, columns along x, larger is higher.

    heights : shape (rows, columns), nan or masked where nothing was measured
    unit : of the heights, as in the file; "1" if the file states none
    spacing : (dx, dy), distances between neighbouring columns and rows; None if the file states none, nan for a
        direction of which it states none
    spacing_unit : of the spacing, or of lengths along x and y, as in the file; "1" if the file states none
    """

    heights: np.ndarray
    unit: str = units.UNKNOWN
    spacing: tuple[float, float] | None = None
    spacing_unit: str = units.UNKNOWN


def to_indenter(scan: Scan, spacing: Spacing | None = None, unit: str | None = None) -> Indenter:
    """The Indenter of a Scan: heights in their unit, spacings converted to it.

    spacing : (dx, dy), numbers in the unit of the heights, or a viscorough.units.Quantity each, needed where the file
        states none; must agree with the file's
    unit : of the heights, and of a spacing without one, needed where the file states none; must agree with the file's

    Raises ValueError where file and arguments contradict each other, where something is missing, for a unit that is
    not one of length, and for heights that Indenter refuses.
    """
    heights = scan.heights
    if heights.dtype.kind not in "iuf":
        raise ValueError(f"heights are of type {heights.dtype}; real numbers are needed")
    if heights.ndim != 2:
        raise ValueError(f"heights have the shape {heights.shape}; a two-dimensional map is needed")
    length_unit = _length_unit(scan, unit)
    stated = _stated_spacing(scan, length_unit, spacing)
    in_plain_numbers = spacing is not None and not all(isinstance(each, Quantity) and each.unit for each in spacing)
    if in_plain_numbers and scan.spacing is None and scan.spacing_unit not in (units.UNKNOWN, scan.unit):
        text = f"heights are in {scan.unit}, x and y in {scan.spacing_unit}; a spacing with a unit is needed"
        raise ValueError(f"--spacing in plain numbers: {text}")
    given = None if spacing is None else (_number(spacing[0], length_unit), _number(spacing[1], length_unit))
    if given is None and (stated is None or not np.isfinite(stated).all()):
        which = "neighbouring points" if stated is None else "columns" if np.isnan(stated[0]) else "rows"
        raise ValueError(f"the distance between {which} is not stated; --spacing is needed")
    if given is not None and stated is not None:
        for name, own, in_file in zip(("columns", "rows"), given, stated, strict=True):
            if abs(own - in_file) > _AGREEMENT * in_file:
                unit = "" if length_unit == units.UNKNOWN else f" {length_unit}"
                text = f"--spacing {own:g}{unit} contradicts the file, in which {name} are {in_file:g}{unit} apart"
                raise ValueError(f"{text}; leave it out")
    known = stated if given is None or (stated is not None and np.isfinite(stated).all()) else given
    assert known is not None
    return Indenter(heights, *known, length_unit=length_unit)


def _number(distance: float | Quantity, length_unit: str) -> float:
    """A given distance, in the unit of the heights."""
    if not isinstance(distance, units.Quantity):
        return positive("spacing", distance)
    if distance.unit and length_unit == units.UNKNOWN:
        raise ValueError(f"--spacing {distance}: the unit of the heights is not known; --unit is needed")
    return distance.to(length_unit)


def _length_unit(scan: Scan, given: str | None) -> str:
    """The unit of the heights, stated by the file or given."""
    stated = None if scan.unit.strip() in ("", units.UNKNOWN) else units.length_unit(scan.unit)
    given = None if given is None or given == units.UNKNOWN else units.length_unit(given)
    if stated and given and units.metres(stated) != units.metres(given):
        raise ValueError(f"--unit {given} contradicts the file, in which heights are in {stated}; leave it out")
    return stated or given or units.UNKNOWN


def _stated_spacing(scan: Scan, length_unit: str, given: Spacing | None) -> tuple[float, float] | None:
    """The spacing (dx, dy) that the file states, in the unit of the heights; None if it states none.

    given : a given spacing, which then stands for one without a unit, or None
    """
    if scan.spacing is None:
        return None
    if scan.spacing_unit.strip() in ("", units.UNKNOWN):
        if scan.unit.strip() in ("", units.UNKNOWN):
            return scan.spacing
        if given is not None:
            return None
        raise ValueError(f"heights are in {length_unit}, coordinates in no stated unit; --spacing is needed")
    unit = units.length_unit(scan.spacing_unit)
    if length_unit == units.UNKNOWN:
        raise ValueError(f"coordinates are in {unit}, heights in no stated unit; --unit is needed")
    factor = units.factor(unit, length_unit)
    dx, dy = (float(f"{factor * distance:.14g}") for distance in scan.spacing)
    return dx, dy


def uniform_spacing(name: str, positions: Array) -> float:
    """The distance between equally spaced positions, in either direction.

    Raises ValueError unless there are at least two, and their distances are equal, as far as their precision tells.
    """
    positions = np.ma.filled(np.ma.asarray(positions).astype(float), np.nan)
    if positions.size < 2:
        raise ValueError(f"coordinate {name} has {positions.size} position; at least two are needed to tell a spacing")
    if not np.isfinite(positions).all():
        raise ValueError(f"coordinate {name} is not finite everywhere; equally spaced numbers are needed")
    with np.errstate(over="ignore"):
        steps = np.diff(positions)
        mean = (positions[-1] - positions[0]) / (positions.size - 1)
        largest = np.abs(positions).max()
        in_single = np.array_equal(positions, positions.astype(np.float32))  # so they may have been rounded to it
        rounding = float(np.spacing(largest.astype(np.float32))) if in_single else 4 * np.spacing(largest)
    is_uniform = mean != 0 and np.isfinite(mean) and np.abs(steps - mean).max() <= _UNIFORMITY * abs(mean) + rounding
    if not is_uniform or (np.sign(steps) != np.sign(mean)).any():
        text = f"coordinate {name} is not uniform: its steps lie between {steps.min():g} and {steps.max():g}"
        raise ValueError(f"{text}; equal spacing is needed")
    if rounding > _UNIFORMITY * abs(mean) * steps.size and np.ptp(steps) > _UNIFORMITY * abs(mean):
        raise ValueError(f"coordinate {name} is too coarse for its steps of {abs(mean):g}; --spacing is needed")
    return abs(mean)
