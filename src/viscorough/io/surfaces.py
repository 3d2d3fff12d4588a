"""Surfaces in NetCDF files: heights with the coordinates of their points and the unit of length."""

from viscorough.indenter import Indenter
from viscorough.io.netcdf import Content, Variable, centred_axes


def surface_to_content(indenter: Indenter) -> Content:
    """An Indenter as the Content of a file: `heights` over (y, x), or over x for a line, and these coordinates.

    Coordinates count from the centre of the map, or of the line.
    """
    axes = {"x": indenter.spacing} if indenter.heights.ndim == 1 else {"y": indenter.row_spacing, "x": indenter.spacing}
    unit = indenter.length_unit
    variables = {"heights": Variable(tuple(axes), indenter.heights, {"long_name": "height", "units": unit})}
    variables |= centred_axes(indenter.heights.shape, axes, unit)
    return Content(variables, {"title": "Heights of a rigid indenter; larger is higher and touches first"})
