"""Read measured surfaces as indenters in metres, and measure their lengths."""

import numpy as np

from viscorough.io.heights import read_heights


def measured_indenter(file, *, spacing, unit, preparation):
    """Read and prepare a scan; return an Indenter in metres.

    spacing : distances between neighbouring heights: [] if the file states them, [distance in both directions], or
        [distance between columns, distance between rows]
    unit : unit of the heights; None if the file states it
    preparation : further arguments of read_heights, which prepare the heights
    Raises ValueError if neither the file nor `unit` states a unit of length.
    """
    spacing = spacing[0] if len(spacing) == 1 else spacing or None
    indenter = read_heights(file, spacing, unit=unit, **preparation)
    if indenter.length_unit == "1":
        raise ValueError(f"{file}: states no unit of length; measured.unit in the settings is needed")
    return indenter


def lengths(indenter):
    """Return the number of elements, both spacings, rms height, rms slope and diameter of an indenter, as a dict.

    The diameter is the diameter of the circle whose area equals the area of all elements. The keys are column names of
    the table of scans (comparisons.measured).
    """
    area = indenter.elements * indenter.spacing * indenter.row_spacing
    return {
        "elements": indenter.elements,
        "spacing": indenter.spacing,
        "row_spacing": indenter.row_spacing,
        "rms": float(np.nanstd(indenter.heights, dtype=float)),
        "rms_slope": indenter.rms_slope,
        "diameter": 2 * np.sqrt(area / np.pi),
    }
