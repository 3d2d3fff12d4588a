"""Rigid indenters: height maps and lines, with the spacing of their points."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Indenter:
    """A rigid indenter: heights on a square grid, or along a line, of equal spacing.

    heights : a map of shape (rows, columns), nan outside the indenter, or a line of shape (points,); larger is higher,
        and the highest point touches first [length]
    spacing : distance between neighbouring points [length]

    Raises ValueError if the heights are not real numbers in one or two dimensions, are infinite, have no
    element or, on a line, have a nan; or if the spacing is not a positive number.
    """

    heights: np.ndarray
    spacing: float

    def __post_init__(self):
        heights = np.asarray(self.heights)
        if heights.dtype.kind not in "fiu":
            raise ValueError(f"indenter heights: must be real numbers, not {heights.dtype}")
        if heights.ndim not in (1, 2):
            raise ValueError(f"indenter heights: must have one or two dimensions, not {heights.ndim}")
        if heights.dtype.kind != "f":
            heights = heights.astype(float)
        if heights.size == 0 or np.isnan(highest := np.fmax.reduce(heights, axis=None)):
            raise ValueError("indenter heights: must have at least one element that is not nan")
        if np.isinf(highest) or np.isinf(np.fmin.reduce(heights, axis=None)):
            raise ValueError("indenter heights: must be finite (nan: outside the indenter), some are infinite")
        if heights.ndim == 1 and np.isnan(heights.min()):
            raise ValueError("indenter heights: must not be nan on a line")
        object.__setattr__(self, "heights", heights)
        object.__setattr__(self, "spacing", positive("indenter spacing", self.spacing))

    @property
    def elements(self):
        """Number of elements: points that are not nan."""
        return int(np.count_nonzero(~np.isnan(self.heights)))

    @property
    def rms_slope(self):
        """Root mean square of the slope |∇h| [1], from differences between neighbours; 0 for a single element."""
        squares = 0.0
        for axis in range(self.heights.ndim):
            difference = np.diff(self.heights, axis=axis) / self.spacing
            if np.isfinite(difference).any():
                squares += np.nanmean(difference**2)
        return float(np.sqrt(squares))

    @property
    def initial_gap(self):
        """Initial gap [length]: depth below the highest element; shape and precision are those of the heights."""
        return np.fmax.reduce(self.heights, axis=None) - self.heights


def positive(name, value):
    """The value as a float. Raises ValueError with the name unless it is finite and above 0."""
    try:
        number = float(value)
    except (TypeError, ValueError):
        raise ValueError(f"{name}: must be a positive number, not {value!r}") from None
    if not (np.isfinite(number) and number > 0):
        raise ValueError(f"{name}: must be positive and finite, not {number}")
    return number
