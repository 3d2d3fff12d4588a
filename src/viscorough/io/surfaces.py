"""Surfaces in NetCDF files: heights with the coordinates of their points and the unit of length."""

from pathlib import Path

import numpy as np

from viscorough.indenter import Indenter
from viscorough.io.heights import npy_array
from viscorough.io.netcdf import Content, Variable, attributes_of, opened
from viscorough.io.scan import uniform_spacing
from viscorough.io.unpacking import unpacked


def surface_to_content(indenter):
    """An Indenter as the Content of a file: `heights` over (y, x), or over x for a line, and these coordinates.

    Coordinates count from the centre of the map, or of the line.
    """
    axes = {"x": indenter.spacing} if indenter.heights.ndim == 1 else {"y": indenter.row_spacing, "x": indenter.spacing}
    unit = indenter.length_unit
    variables = {"heights": Variable(tuple(axes), indenter.heights, {"long_name": "height", "units": unit})}
    for (name, spacing), points in zip(axes.items(), indenter.heights.shape, strict=True):
        position = spacing * (np.arange(points) - (points - 1) / 2)
        variables[name] = Variable((name,), position, {"long_name": f"position along {name}", "units": unit})
    return Content(variables, {"title": "Heights of a rigid indenter; larger is higher and touches first"})


def read_line(path, spacing=None):
    """Read the heights of a line as an Indenter, for the method of reduction of dimensionality (mdr.reduce).

    path : .npy of shape (points,), or .nc with a variable `heights` of one dimension, or only one such variable
    spacing : distance between neighbouring points, in the unit of the heights; by default that of the coordinate in a
        NetCDF file, in the same unit as the heights

    Raises a one-line ValueError that names the file and what is wrong.
    """
    heights, unit, stated = (npy_array(path), "1", None) if Path(path).suffix == ".npy" else _from_netcdf(path)
    if heights.dtype.kind not in "iuf" or heights.ndim != 1:
        raise ValueError(f"{path}: heights are of type {heights.dtype} and shape {heights.shape}; a line is needed")
    if spacing is None and stated is None:
        raise ValueError(f"{path}: states no spacing of its points; --spacing is needed")
    if spacing is not None and stated is not None and not np.isclose(spacing, stated, rtol=1e-3, atol=0):
        raise ValueError(f"{path}: its points are {stated:g} apart, not {spacing:g}; the same or no spacing is allowed")
    try:
        return Indenter(heights, stated if spacing is None else spacing, length_unit=unit)
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from error


def dimensions_of_heights(path):
    """Number of dimensions of the heights in a .npy or NetCDF file: 1 for a line; 2 where there are no such heights."""
    if Path(path).suffix == ".npy":
        return npy_array(path).ndim
    if Path(path).suffix != ".nc":
        return 2
    with opened(path) as file:
        return 1 if _line_in(file) else 2


def _line_in(file):
    """Name of the variable with the heights of a line in an open NetCDF file; None if there is none."""
    if "heights" in file.variables:
        return "heights" if file["heights"].ndim == 1 else None
    lines = [name for name, variable in file.variables.items() if variable.ndim == 1 and name not in file.dimensions]
    maps = [name for name, variable in file.variables.items() if variable.ndim == 2]
    return lines[0] if len(lines) == 1 and not maps else None


def _from_netcdf(path):
    """Heights, their unit, and the spacing that the coordinate states; None if there is no coordinate."""
    with opened(path) as file:
        name = _line_in(file)
        if name is None:
            raise ValueError("no line of heights")
        variable = file[name]
        unit = attributes_of(variable).get("units", "1")
        unit = unit if isinstance(unit, str) and unit.strip() else "1"
        (axis,) = variable.dimensions
        if axis not in file.variables:
            return unpacked(variable), unit, None
        coordinate = file[axis]
        if attributes_of(coordinate).get("units", unit) != unit:
            raise ValueError(f"{axis} is not in the unit of the heights, {unit}")
        positions = unpacked(coordinate)
        return unpacked(variable), unit, uniform_spacing(axis, positions) if positions.size > 1 else None
