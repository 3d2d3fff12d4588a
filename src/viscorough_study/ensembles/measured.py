"""Measured surfaces as indenters in metres, and their lengths."""

import numpy as np

from viscorough.io.heights import read_heights


def measured_indenter(file, *, spacing, unit, preparation):
    """Return the prepared Indenter of a scan, in metres.

    spacing : [] for the spacing in the file, [of both directions] or [between columns, between rows]
    unit : unit of the heights, None for the unit in the file; preparation : further arguments of read_heights
    Raises ValueError if the unit of length is unknown.
    """
    spacing = spacing[0] if len(spacing) == 1 else spacing or None
    indenter = read_heights(file, spacing, unit=unit, **preparation)
    if indenter.length_unit == "1":
        raise ValueError(f"{file}: states no unit of length; measured.unit in the settings is needed")
    return indenter.to("m")


def lengths(indenter):
    """Return {column: value} of an indenter: spacings, rms height and slope, diameter of the circle of equal area."""
    area = indenter.elements * indenter.spacing * indenter.row_spacing
    return {
        "elements": indenter.elements,
        "spacing": indenter.spacing,
        "row_spacing": indenter.row_spacing,
        "rms": float(np.nanstd(indenter.heights, dtype=float)),
        "rms_slope": indenter.rms_slope,
        "diameter": 2 * np.sqrt(area / np.pi),
    }
