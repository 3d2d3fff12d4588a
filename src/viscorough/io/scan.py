"""Convert the heights, spacings and units that a file states to an indenter."""

from typing import Any, NamedTuple

import numpy as np

from viscorough.basics import units
from viscorough.basics.argument_names import argument
from viscorough.basics.arrays import positive
from viscorough.basics.types import Array
from viscorough.surfaces.indenter import Indenter

Distance = float | units.Quantity
# A spacing that the user gives agrees with the spacing in the file if the relative difference is at most this.
_AGREEMENT = 1e-3
# Coordinates count as equally spaced if, apart from rounding, each step differs from the mean by at most this share.
_UNIFORMITY = 1e-2


class Scan(NamedTuple):
    """Heights of a map or line, with their spacing and units as a file states them. Larger heights are higher.

    heights : map of shape (rows, columns), where x runs along a row and y from row to row, or line of shape (points,).
        Points that were not measured are nan or masked
    unit : unit of the heights, as the file spells it; "1" if the file states no unit
    spacing : (dx, dy), the distance between neighbouring columns and the distance between neighbouring rows. A distance
        that the file does not state is nan; None if both are missing
    spacing_unit : unit of the spacing and of positions x and y, as the file spells it; "1" if the file states no unit
    corners : (left, bottom, right, top), x and y of the outermost points, if x and y have no unit and may be longitudes
        and latitudes; None otherwise. Coordinates that the file does not state are nan
    mentions : (line, unit) of lines in the file that hold a unit of length without stating that it is of the heights
    positions : (x of the columns, y of the rows) in the unit of the spacing; None if the file does not state them
    down : True if the file states that larger numbers are lower; the heights are then the negative numbers
    """

    heights: np.ndarray
    unit: str = units.UNKNOWN
    spacing: tuple[float, float] | None = None
    spacing_unit: str = units.UNKNOWN
    corners: tuple[float, float, float, float] | None = None
    mentions: tuple[tuple[str, str], ...] = ()
    positions: tuple[Array, Array] | None = None
    down: bool = False


def to_indenter(
    scan: Scan,
    spacing: Any = None,
    unit: str | None = None,
    lateral_unit: str | None = None,
    *,
    dimensions: int = 2,
) -> Indenter:
    """Convert a Scan to an Indenter, with spacings in the unit of the heights.

    spacing : one distance, or (dx, dy). Each is a plain number or has a unit, such as "0.2 um" (see units.with_unit).
        Needed if the file states no spacing; otherwise it must agree with the file
    unit : unit of the heights. Needed if the file states no unit; otherwise it must agree with the file
    lateral_unit : unit of x and y in the file, if the file does not state it; otherwise it must agree with the file.
        Plain numbers in `spacing` have this unit, too; without it they are in the unit of the heights
    dimensions : 2 for a map, 1 for a line

    Raises ValueError if file and arguments contradict each other, if spacing or unit is missing, for a unit that is not
    a unit of length, for coordinates that may be degrees, and for heights that Indenter refuses.
    """
    if scan.heights.ndim != dimensions:
        needed = "a line" if dimensions == 1 else "a two-dimensional map"
        raise ValueError(f"heights have the shape {scan.heights.shape}; {needed} is needed")
    length_unit = _unit_of_heights(scan, unit)
    if lateral_unit is not None:
        if length_unit == units.UNKNOWN:
            text = f"{argument('lateral_unit')} {lateral_unit}: heights are in no stated unit"
            is_missing = spacing is None and scan.spacing is None
            needed = f"{argument('unit')} and {argument('spacing')} are" if is_missing else f"{argument('unit')} is"
            raise ValueError(f"{text}; {needed} needed")
        lateral_unit = units.length_unit(lateral_unit)
        scan = scan._replace(
            spacing_unit=_agreed_unit("lateral_unit", "positions x and y", scan.spacing_unit, lateral_unit)
        )
    if length_unit == units.UNKNOWN and scan.corners is not None and _may_be_degrees(*scan.corners):
        left, bottom, right, top = scan.corners
        text = f"x from {left:g} to {right:g}, y from {bottom:g} to {top:g}, in no stated unit, may be degrees"
        raise ValueError(f"{text}; lengths are needed, with {argument('unit')}")
    in_file = _stated_spacing(scan, length_unit, is_given=spacing is not None)
    own = in_file if spacing is None else _given_spacing(scan, length_unit, spacing, lateral_unit)
    if not np.isfinite(own).all():
        which = "neighbouring points" if np.isnan(own).all() else "columns" if np.isnan(own[0]) else "rows"
        text, needed = f"the distance between {which} is not stated", f"{argument('spacing')} is needed"
        if length_unit == units.UNKNOWN:
            text, needed = f"{text}, nor a unit", f"{needed}, and {argument('unit')} for forces and results in SI units"
        raise ValueError(f"{text}; {needed}")
    names = ("points", "points") if dimensions == 1 else ("columns", "rows")
    for name, distance, stated in zip(names, own, in_file, strict=True):
        if abs(distance - stated) > _AGREEMENT * abs(stated):
            unit = "" if length_unit == units.UNKNOWN else f" {length_unit}"
            text = f"{distance:g}{unit} contradicts the file, in which {name} are {stated:g}{unit} apart"
            raise ValueError(f"{argument('spacing')} {text}; leave it out")
    dx, dy = in_file if np.isfinite(in_file).all() else own
    places = _places(scan, length_unit) if dimensions == 2 and np.isfinite(in_file).all() else (None, None)
    return Indenter(scan.heights, dx, dy, length_unit, *places)


def _places(scan: Scan, length_unit: str) -> tuple[Array | None, Array | None]:
    """Return the positions of columns and rows in the unit of the heights.

    Positions are None if the file states none, or if they rise and are 0 at the centre, as without a statement.
    """
    if scan.positions is None:
        return None, None
    unit = scan.spacing_unit.strip()
    has_unit = length_unit != units.UNKNOWN and unit not in ("", units.UNKNOWN)
    factor = units.factor(units.length_unit(unit), length_unit) if has_unit else 1.0
    x, y = (factor * positions for positions in scan.positions)
    centred = all(each[0] < each[-1] and abs(each[0] + each[-1]) <= 1e-12 * np.ptp(each) for each in (x, y))
    return (None, None) if centred else (x, y)


def _may_be_degrees(left: float, bottom: float, right: float, top: float) -> bool:
    """Return True if x and y of the corners may be degrees: longitudes from −180 to 360, latitudes from −90 to 90."""
    return -180 <= left < right <= 360 and -90 <= bottom < top <= 90


def _given_spacing(scan: Scan, length_unit: str, spacing: Any, plain_unit: str | None) -> tuple[float, ...]:
    """Convert a spacing that the user gives to (dx, dy) in the unit of the heights.

    length_unit : unit of the heights
    spacing : one distance, or (dx, dy)
    plain_unit : unit of distances that are plain numbers; None for the unit of the heights
    """
    pair = spacing if isinstance(spacing, tuple | list | np.ndarray) else (spacing, spacing)
    if len(pair) != 2:
        raise ValueError(f"{argument('spacing')} {spacing!r}: one distance, or the two of columns and rows, is needed")
    pair = [units.with_unit(distance) for distance in pair]
    if plain_unit is not None:
        pair = [_in_unit(distance, plain_unit) for distance in pair]
    have_units = all(isinstance(distance, units.Quantity) and distance.unit for distance in pair)
    if not have_units and scan.spacing is None and scan.spacing_unit not in (units.UNKNOWN, scan.unit):
        text = f"heights are in {scan.unit}, x and y in {scan.spacing_unit}; a spacing with a unit is needed"
        raise ValueError(f"{argument('spacing')} in plain numbers: {text}")
    name = argument("spacing")
    return tuple(positive(name, number) for number in units.numbers(pair, length_unit, length_unit, name))


def _in_unit(distance: Any, unit: str) -> units.Quantity:
    """Return a distance as a Quantity; a plain number gets the unit."""
    if isinstance(distance, units.Quantity):
        return distance if distance.unit else units.Quantity(distance.number, unit)
    return units.Quantity(positive(argument("spacing"), distance), unit)


def _unit_of_heights(scan: Scan, given: str | None) -> str:
    """Return the unit of the heights from the file or from the argument `given`; "1" if neither states it."""
    try:
        _stated_unit(scan.unit)
    except ValueError as error:
        text = f"{argument('scale')}, such as '5 nm', states the height of 1 {scan.unit.strip()[:60]}"
        raise ValueError(f"heights: {error}; {text}") from error
    unit = _agreed_unit("unit", "heights", scan.unit, given)
    if _stated_unit(scan.unit) is None and scan.mentions:
        line, mentioned = scan.mentions[0]
        if unit == units.UNKNOWN:
            text = f"the line {line!r} holds the unit {mentioned}, but does not state that heights are in it"
            raise ValueError(f"{text}; {argument('unit', mentioned)} states it, if they are")
        if all(units.metres(each) != units.metres(unit) for _, each in scan.mentions):
            text = f"{argument('unit')} {unit}: the line {line!r} holds the unit {mentioned}"
            raise ValueError(f"{text}; {argument('unit', mentioned)}, or a file without this line, is needed")
    return unit


def _stated_unit(in_file: str) -> str | None:
    """Return the unit of length that a file states; None if it states no unit. Raises ValueError for other units."""
    return None if in_file.strip() in ("", units.UNKNOWN) else units.length_unit(in_file)


def _agreed_unit(name: str, lengths: str, in_file: str, given: str | None) -> str:
    """Return the unit that the file or an argument of the user states; "1" if neither states a unit.

    name : name of the argument
    lengths : words for the lengths with this unit in the message, such as "heights"
    in_file : unit in the file
    given : value of the argument, or None

    Raises ValueError if file and argument state different units.
    """
    stated = _stated_unit(in_file)
    given = None if given is None or given == units.UNKNOWN else units.length_unit(given)
    if stated and given and units.metres(stated) != units.metres(given):
        raise ValueError(
            f"{argument(name)} {given} contradicts the file, in which {lengths} are in {stated}; leave it out"
        )
    return stated or given or units.UNKNOWN


def _stated_spacing(scan: Scan, length_unit: str, is_given: bool) -> tuple[float, ...]:
    """Return the spacing (dx, dy) that the file states, in the unit of the heights; (nan, nan) if none is stated.

    length_unit : unit of the heights
    is_given : True if the user gives a spacing. If only the heights in the file have a unit, the spacing in the file is
        then ignored
    """
    if scan.spacing is None:
        return np.nan, np.nan
    if scan.spacing_unit.strip() in ("", units.UNKNOWN):
        if scan.unit.strip() in ("", units.UNKNOWN):
            return scan.spacing
        if is_given:
            return np.nan, np.nan
        text = f"heights are in {length_unit}, coordinates in no stated unit"
        raise ValueError(f"{text}; {argument('spacing')} or {argument('lateral_unit')} is needed")
    unit = units.length_unit(scan.spacing_unit)
    if length_unit == units.UNKNOWN:
        raise ValueError(f"coordinates are in {unit}, heights in no stated unit; {argument('unit')} is needed")
    factor = units.factor(unit, length_unit)
    return tuple(float(f"{factor * distance:.14g}") for distance in scan.spacing)


def uniform_spacing(name: str, positions: Array) -> float:
    """Return the distance between equally spaced positions, which may rise or fall.

    name : name of the coordinate in the file, for messages

    Raises ValueError for fewer than two positions, and for distances that differ by more than rounding can cause.
    """
    positions = np.ma.filled(np.ma.asarray(positions).astype(float), np.nan)
    if positions.size < 2:
        raise ValueError(f"coordinate {name} has {positions.size} position; at least two are needed for a spacing")
    if not np.isfinite(positions).all():
        raise ValueError(f"coordinate {name} is not finite everywhere; equally spaced numbers are needed")
    with np.errstate(over="ignore"):
        steps = np.diff(positions)
        mean = (positions[-1] - positions[0]) / (positions.size - 1)
        largest = np.abs(positions).max()
        # If single precision represents all positions exactly, they may have been rounded to single precision.
        in_single = np.array_equal(positions, positions.astype(np.float32))
        rounding = float(np.spacing(largest.astype(np.float32))) if in_single else 4 * np.spacing(largest)
    is_uniform = mean != 0 and np.isfinite(mean) and np.abs(steps - mean).max() <= _UNIFORMITY * abs(mean) + rounding
    if not is_uniform or (np.sign(steps) != np.sign(mean)).any():
        text = f"coordinate {name} is not uniform: its steps lie between {steps.min():g} and {steps.max():g}"
        raise ValueError(f"{text}; equal spacing is needed")
    if rounding > _UNIFORMITY * abs(mean) * steps.size and np.ptp(steps) > _UNIFORMITY * abs(mean):
        raise ValueError(
            f"coordinate {name} is too coarse for its steps of {abs(mean):g}; {argument('spacing')} is needed"
        )
    return abs(mean)
