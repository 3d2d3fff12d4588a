"""Define the class Indenter: a height map, or the heights along a line, with the spacing of the points."""

import math
import sys
from dataclasses import dataclass
from typing import Any

import numpy as np

from viscorough.basics.arrays import positive, real_numbers, shown
from viscorough.basics.summaries import with_unit
from viscorough.basics.types import Array

# Largest ratio of the longer to the shorter side of an element.
LARGEST_ASPECT = 5


@dataclass(frozen=True, eq=False)
class Indenter:
    """Rigid indenter: heights at the points of a rectangular grid, or of a line with equal spacing.

    Parameters
    ----------
    heights : array
        Map of shape (rows, columns), nan outside the indenter, or line of shape (points,) [length]. The point with the
        largest height touches first. Single precision is kept; all other numbers become double precision. An array of
        these types is not copied, so that it must not be changed.
    spacing : float
        Distance dx between neighbouring columns of a map, or between neighbouring points of a line [length]. It may
        also be a pair (dx, dy).
    row_spacing : float
        Distance dy between neighbouring rows of a map, from a fifth of dx to five times dx; by default dx [length].
    length_unit : str
        "m" if numbers are in SI units, "1" if they are in consistent units that are not known, the default.
    column_positions, row_positions : array, optional
        Coordinates x of the columns and y of the rows of a map, as the file of the map states them, rising or falling
        [length]. Output files have the same coordinates. By default they rise, and are 0 at the centre of the map.
    from_file : bool, optional
        True for heights that were read from a file. `indent` and `contact_at` then warn if the border of the map
        carries much of the force, as in a scan of a larger surface.

    Raises
    ------
    ValueError
        For heights that are not real numbers in one or two dimensions, contain infinite numbers, or are all nan. For a
        line with nan. For heights whose difference is too large for double precision.
        For positions that are not one for each column or row. For spacings that are not positive or differ by more than
        a factor of five, and for a line whose row_spacing differs from its spacing. For another unit than "m" or "1".

    Examples
    --------
    >>> import numpy as np
    >>> import viscorough
    >>> indenter = viscorough.Indenter(np.array([[0.0, 1.0], [np.nan, 0.5]]), 2.0)
    >>> indenter.elements, indenter.row_spacing
    (3, 2.0)
    """

    heights: np.ndarray
    spacing: float
    row_spacing: float = None  # type: ignore[assignment]  # __post_init__ replaces None by the spacing
    length_unit: str = "1"
    column_positions: np.ndarray | None = None
    row_positions: np.ndarray | None = None
    from_file: bool = False

    def __post_init__(self) -> None:
        if self.length_unit not in ("m", "1"):
            needed = "allowed are 'm', with all numbers in SI units, and '1', with consistent units"
            raise ValueError(f"indenter length_unit: {shown(self.length_unit)}; {needed}")
        heights = self.heights
        if not isinstance(heights, np.ndarray) or np.ma.isMaskedArray(heights) or heights.dtype.kind not in "iuf":
            heights = real_numbers("indenter heights", heights)
        if heights.ndim not in (1, 2):
            raise ValueError(f"indenter heights: must have one or two dimensions, not {heights.ndim}")
        # Store heights in single or double precision, row by row, and in the byte order of this machine.
        precision = np.float32 if heights.dtype == np.float32 else np.float64
        with np.errstate(over="ignore"):  # numbers that are too large become infinite, which is checked below
            heights = np.ascontiguousarray(heights, dtype=precision)
        if heights.size == 0 or np.isnan(highest := np.fmax.reduce(heights, axis=None)):
            raise ValueError("indenter heights: must have at least one element that is not nan")
        if not math.isfinite(float(highest) - float(np.fmin.reduce(heights, axis=None))):
            raise ValueError(
                "indenter heights: must be finite (nan: outside), also their differences; some are infinite"
            )
        if heights.ndim == 1 and np.isnan(heights.min()):
            raise ValueError("indenter heights: must not be nan on a line")
        object.__setattr__(self, "heights", heights)
        spacing, row_spacing = _spacings(self.spacing, self.row_spacing)
        if heights.ndim == 1 and row_spacing != spacing:
            raise ValueError("indenter row_spacing: a line has no rows, only one spacing is allowed")
        object.__setattr__(self, "spacing", spacing)
        object.__setattr__(self, "row_spacing", row_spacing)
        for name, points in zip(("column_positions", "row_positions"), heights.shape[::-1], strict=False):
            if (positions := getattr(self, name)) is not None:
                positions = real_numbers(f"indenter {name}", positions)
                if positions.shape != (points,) or not np.isfinite(positions).all():
                    raise ValueError(f"indenter {name}: shape {positions.shape}; {points} finite numbers are needed")
                object.__setattr__(self, name, positions)

    def __repr__(self) -> str:
        """Return a summary: map or line, numbers of points and elements, spacings, and range of the heights."""
        points, unit = " x ".join(map(str, self.heights.shape)), self.length_unit
        difference = np.nanmax(self.heights) - np.nanmin(self.heights)
        text = f"Indenter: {'map' if self.heights.ndim == 2 else 'line'} of {points} points, {self.elements} elements\n"
        text += f"spacing {with_unit(self.spacing, unit)}\n"
        if self.aspect != 1:
            text += f"row spacing {with_unit(self.row_spacing, unit)}\n"
        return f"{text}highest over lowest point {with_unit(difference, unit)}"

    @property
    def aspect(self) -> float:
        """Return the ratio dy/dx of the sides of an element; 1 for squares."""
        return self.row_spacing / self.spacing

    @property
    def element_side(self) -> float:
        """Return the side d = √(dx dy) of the square that has the area of an element [length]."""
        return self.spacing * math.sqrt(self.aspect)

    @property
    def elements(self) -> int:
        """Return the number of elements, which are the points that are not nan."""
        return int(np.count_nonzero(~np.isnan(self.heights)))

    @property
    def rms_slope(self) -> float:
        """Return the dimensionless rms slope √⟨(∇h)²⟩ of the heights h, from the differences of neighbouring heights.

        The slope of a single element is 0.
        """
        slopes = [0.0]
        with np.errstate(over="ignore", under="ignore"):  # slopes that are too large become infinite
            for axis, spacing in enumerate((self.row_spacing, self.spacing)[-self.heights.ndim :]):
                slope = np.abs(np.diff(self.heights.astype(float), axis=axis)) / spacing
                largest = np.fmax.reduce(slope, axis=None, initial=0.0)
                # Divide slopes by the largest slope before squaring: the square of a slope below 1e-162 would be 0.
                relative = slope / largest if 0 < largest < np.inf else np.ones(1)
                slopes.append(largest * np.sqrt(np.nanmean(relative**2)))
        return float(np.hypot.reduce(slopes))

    @property
    def initial_gap(self) -> Array:
        """Return the depth of each element below the highest element, in the shape of the heights [length]."""
        return np.subtract(np.fmax.reduce(self.heights, axis=None), self.heights, dtype=float)


def _spacings(spacing: Any, row_spacing: Any) -> tuple[float, float]:
    """Check the spacings of an Indenter, and return (dx, dy)."""
    if row_spacing is None and np.shape(spacing) == (2,):
        spacing, row_spacing = spacing
    spacing = positive("indenter spacing", spacing)
    row_spacing = spacing if row_spacing is None else positive("indenter row_spacing", row_spacing)
    if min(spacing, row_spacing) < sys.float_info.min:
        raise ValueError(f"indenter spacing: {spacing:g} is too small to represent; a smaller unit of length is needed")
    largest = LARGEST_ASPECT * (1 + 1e-9)  # rounding of computed spacings may slightly change their ratio
    if not 1 / largest <= row_spacing / spacing <= largest:
        raise ValueError(
            f"indenter spacing: {spacing:g} between columns and {row_spacing:g} between rows differ by more than "
            f"a factor of {LARGEST_ASPECT}, which is the largest allowed; resample the map"
        )
    return spacing, row_spacing


def check_indenter(caller: str, indenter: object, dimensions: int) -> None:
    """Raise TypeError unless `indenter` is an Indenter, and ValueError if its heights have the wrong dimensions.

    caller : name of the function that the user called; messages start with it
    dimensions : allowed number of dimensions of the heights: 2 for a map, 1 for a line
    """
    if not isinstance(indenter, Indenter):
        text = "an Indenter is needed, as viscorough.Indenter(heights, spacing) or viscorough.read_heights makes it"
        raise TypeError(f"{caller}: {type(indenter).__name__}; {text}")
    if indenter.heights.ndim != dimensions:
        needed = {1: "one-dimensional (maps are for indent)", 2: "two-dimensional (lines are for reduce)"}[dimensions]
        raise ValueError(f"{caller}: the indenter's heights must be {needed}")
