"""Convert the heights, spacings and units that a file states to an indenter, with lengths in metres."""

from typing import Any, NamedTuple

import numpy as np

from viscorough.basics import units
from viscorough.basics.arrays import positive, real_number
from viscorough.basics.types import Array
from viscorough.surfaces.indenter import Indenter

Distance = float | str  # a number in the unit of the heights, or a text with a unit, such as "0.2 um"
# A spacing that the user gives agrees with the spacing in the file if the relative difference is at most this.
_AGREEMENT = 1e-3
NOT_STATED = ""  # unit of a file that states none


class Scan(NamedTuple):
    """Heights of a map or line, with their spacing and units as a file states them. Larger heights are higher.

    heights : map of shape (rows, columns), where x runs along a row and y from row to row, or line of shape (points,).
        Points that were not measured are nan
    unit : unit of the heights, as the file spells it; "1" if the file states that the unit of length is not known, and
        NOT_STATED if it states nothing
    spacing : (dx, dy), the distance between neighbouring columns and the distance between neighbouring rows; None if
        the file states no distance
    spacing_unit : unit of the spacing and of the positions, like `unit`
    positions : (x of the columns, y of the rows) in the unit of the spacing; None if the file does not state them
    down : True if the file states that larger numbers are lower; the heights are then the negative numbers
    counts : True if the numbers may be counts of a detector, so that only a scale makes heights of them
    """

    heights: np.ndarray
    unit: str = NOT_STATED
    spacing: tuple[float, float] | None = None
    spacing_unit: str = NOT_STATED
    positions: tuple[Array, Array] | None = None
    down: bool = False
    counts: bool = False


def in_metres(indenter: Indenter, unit: str) -> Indenter:
    """Return an indenter whose numbers are in `unit` with its lengths in metres; unchanged if the unit is "1"."""
    if unit == units.UNKNOWN:
        return indenter
    factor = units.metres(unit)
    positions = (indenter.column_positions, indenter.row_positions)
    columns, rows = (None if each is None else each * factor for each in positions)
    heights = indenter.heights if factor == 1 else indenter.heights.astype(float) * factor
    spacings = indenter.spacing * factor, indenter.row_spacing * factor
    return Indenter(heights, *spacings, "m", columns, rows, from_file=indenter.from_file)


def to_indenter(scan: Scan, spacing: Any = None, unit: str | None = None, scale: Any = None) -> tuple[Indenter, str]:
    """Convert a Scan to an Indenter with numbers in the unit of the heights, and return it with this unit.

    `in_metres` then converts the indenter, after its heights are prepared: marks of missing values are in the unit of
    the file.

    spacing : one distance, or (dx, dy). Each is a plain number in the unit of the heights, or a text or Quantity with a
        unit, such as "0.2 um". Needed if the file states no spacing; otherwise it must agree with the file
    unit : unit of the heights. Needed if the file states no unit; otherwise it must agree with the file
    scale : factor of the heights, see `read_heights`

    Raises ValueError if file and arguments contradict each other, if spacing or unit is missing, for a unit that is not
    a unit of length, and for heights that Indenter refuses.
    """
    if scan.counts and scale is None:
        text = "its numbers are whole, without a scale, as counts of a detector are; argument scale, such as"
        raise ValueError(f"{text} '5 nm', states the height of 1 count, and 1 that the numbers are heights")
    if scale is not None:
        scan = _scaled(scan, scale)
    length_unit = _unit_of_heights(scan, unit)
    in_file = _stated_spacing(scan, length_unit, is_given=spacing is not None)
    if spacing is None and in_file is None:
        raise ValueError("the distance between neighbouring points is not stated; argument spacing is needed")
    own = in_file if spacing is None else _given_spacing(spacing, length_unit, is_line=scan.heights.ndim == 1)
    assert own is not None
    if in_file is not None:
        _check_agreement(own, in_file, length_unit)
    if (
        in_file is None
        and scan.spacing is not None
        and abs(own[1] / own[0] * scan.spacing[0] / scan.spacing[1] - 1) > (_AGREEMENT)
    ):
        text = f"in the file, rows are {scan.spacing[1] / scan.spacing[0]:g} times as far apart as columns"
        raise ValueError(f"argument spacing: {text}; distances of this ratio are needed")
    dx, dy = own if in_file is None else in_file
    places = _places(scan, length_unit) if scan.heights.ndim == 2 and in_file is not None else (None, None)
    return Indenter(scan.heights, dx, dy, units.UNKNOWN, *places, from_file=True), length_unit


def _scaled(scan: Scan, scale: Any) -> Scan:
    """Multiply the heights of a Scan by a scale. If the scale has a unit, the heights get this unit."""
    quantity = _quantity("argument scale", scale)
    number, unit = quantity.number, quantity.unit
    if unit and units.is_length(scan.unit):
        text = f"heights are in {scan.unit} in the file; a plain number is needed"
        raise ValueError(f"argument scale {scale}: {text}")
    number = positive("argument scale", number)
    if scan.heights.dtype.kind not in "iuf":
        return scan  # Indenter refuses heights that are no numbers
    return scan._replace(heights=scan.heights * number, unit=unit or scan.unit)


def _check_agreement(given: tuple[float, float], in_file: tuple[float, float], length_unit: str) -> None:
    """Raise ValueError if the spacing that the user gives contradicts the spacing in the file."""
    for name, distance, stated in zip(("columns", "rows"), given, in_file, strict=True):
        if abs(distance - stated) > _AGREEMENT * abs(stated):
            unit = "" if length_unit == units.UNKNOWN else f" {length_unit}"
            text = f"{distance:g}{unit} contradicts the file, in which {name} are {stated:g}{unit} apart"
            raise ValueError(f"argument spacing {text}; leave it out")


def _places(scan: Scan, length_unit: str) -> tuple[Array | None, Array | None]:
    """Return the positions of columns and rows in the unit of the heights.

    Positions are None if the file states none, or if they rise and are 0 at the centre, as without a statement.
    """
    if scan.positions is None:
        return None, None
    has_unit = length_unit != units.UNKNOWN and _is_known(scan.spacing_unit)
    factor = units.factor(units.length_unit(scan.spacing_unit), length_unit) if has_unit else 1.0
    x, y = (factor * positions for positions in scan.positions)
    centred = all(each[0] < each[-1] and abs(each[0] + each[-1]) <= 1e-12 * np.ptp(each) for each in (x, y))
    return (None, None) if centred else (x, y)


def _given_spacing(spacing: Any, length_unit: str, *, is_line: bool) -> tuple[float, float]:
    """Convert a spacing that the user gives to (dx, dy) in the unit of the heights."""
    pair = spacing if isinstance(spacing, tuple | list | np.ndarray) else (spacing, spacing)
    name = "argument spacing"
    if len(pair) != 2 or (is_line and pair is spacing):
        needed = (
            "one distance is needed for a line" if is_line else "one distance, or two of columns and rows, is needed"
        )
        raise ValueError(f"{name} {spacing!r}: {needed}")
    dx, dy = (_quantity(name, distance) for distance in pair)
    for distance in (dx, dy):
        if distance.unit and length_unit == units.UNKNOWN:
            raise ValueError(f"{name} {distance}: needs a plain number, since the unit of heights is not known")
    return positive(name, dx.to(length_unit)), positive(name, dy.to(length_unit))


def _quantity(name: str, value: Any) -> units.Quantity:
    """Convert a number, or a text with or without a unit, to a Quantity."""
    if isinstance(value, str):
        value = units.quantity(value)
    return value if isinstance(value, units.Quantity) else units.Quantity(real_number(name, value))


def _is_known(unit: str) -> bool:
    """Return True if a file states this unit, and it is not "1"."""
    return unit.strip() not in (NOT_STATED, units.UNKNOWN)


def _unit_of_heights(scan: Scan, given: str | None) -> str:
    """Return the unit of the heights from the file or from the argument `given`; "1" if neither states it.

    Raises ValueError if file and argument state different units, and for a unit that is not a unit of length.
    """
    try:
        stated = units.length_unit(scan.unit) if _is_known(scan.unit) else None
    except ValueError as error:
        text = f"argument scale, such as '5 nm', states the height of 1 {scan.unit.strip()[:60]}"
        raise ValueError(f"heights: {error}; {text}") from error
    given = None if given is None or given == units.UNKNOWN else units.length_unit(given)
    if stated and given and units.metres(stated) != units.metres(given):
        text = f"{given} contradicts the file, in which heights are in {stated}; leave it out"
        raise ValueError(f"argument unit {text}")
    return stated or given or units.UNKNOWN


def _stated_spacing(scan: Scan, length_unit: str, *, is_given: bool) -> tuple[float, float] | None:
    """Return the spacing (dx, dy) that the file states, in the unit of the heights; None if none is stated.

    is_given : True if the user gives a spacing. If only the heights in the file have a unit, the user's spacing then
        states the unit of the coordinates
    """
    if scan.spacing is None:
        return None
    if not _is_known(scan.spacing_unit):
        if not _is_known(scan.unit):
            return scan.spacing
        if is_given:
            return None
        text = f"heights are in {length_unit}, coordinates in no stated unit"
        raise ValueError(f"{text}; argument spacing is needed")
    unit = units.length_unit(scan.spacing_unit)
    if length_unit == units.UNKNOWN:
        raise ValueError(f"coordinates are in {unit}, heights in no stated unit; argument unit is needed")
    factor = units.factor(unit, length_unit)
    dx, dy = (float(f"{factor * distance:.14g}") for distance in scan.spacing)
    return dx, dy
