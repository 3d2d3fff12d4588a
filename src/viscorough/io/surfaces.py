"""Surfaces in NetCDF files: heights with the coordinates of their points and the unit of length."""

from pathlib import Path

from viscorough.indenter import Indenter
from viscorough.io.atomic import path_named
from viscorough.io.heights import netcdf_scan, npy_array
from viscorough.io.netcdf import Content, Variable, centred_axes, opened
from viscorough.io.scan import Distance, Scan, to_indenter
from viscorough.types import FilePath


def surface_to_content(indenter: Indenter) -> Content:
    """An Indenter as the Content of a file: `heights` over (y, x), or over x for a line, and these coordinates.

    Coordinates count from the centre of the map, or of the line.
    """
    axes = {"x": indenter.spacing} if indenter.heights.ndim == 1 else {"y": indenter.row_spacing, "x": indenter.spacing}
    unit = indenter.length_unit
    variables = {"heights": Variable(tuple(axes), indenter.heights, {"long_name": "height", "units": unit})}
    variables |= centred_axes(indenter.heights.shape, axes, unit)
    return Content(variables, {"title": "Heights of a rigid indenter; larger is higher and touches first"})


def read_line(path: FilePath, spacing: Distance | str | None = None, unit: str | None = None) -> Indenter:
    """Read the heights of a line as an Indenter, for the method of dimensionality reduction (mdr.reduce).

    Parameters
    ----------
    path : path
        .npy of shape (points,), or .nc with a variable `heights` of one dimension, or only one such variable.
    spacing : number or text, optional
        Distance between neighbouring points, in the unit of the heights, or a text as "0.2 um"; by default that of the
        coordinate in a NetCDF file.
    unit : str, optional
        Unit of length of the heights, where the file states none, such as "um".

    Raises
    ------
    ValueError
        In one line, with the file and what is wrong.

    Examples
    --------
    >>> import tempfile
    >>> import numpy as np
    >>> import viscorough
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     np.save(f"{folder}/line.npy", np.random.default_rng(1).normal(size=64))
    ...     line = viscorough.read_line(f"{folder}/line.npy", 0.5)
    >>> line.heights.shape
    (64,)
    """
    with path_named(path):
        scan = Scan(npy_array(path)) if Path(path).suffix == ".npy" else netcdf_scan(path, None, dimensions=1)
        return to_indenter(scan, None if spacing is None else (spacing, spacing), unit, dimensions=1)


def dimensions_of_heights(path: FilePath) -> int:
    """Number of dimensions of the heights in a .npy or NetCDF file: 1 for a line; 2 where there are no such heights."""
    if Path(path).suffix == ".npy":
        return npy_array(path).ndim
    if Path(path).suffix != ".nc":
        return 2
    with opened(path) as file:
        maps = [name for name, each in file.variables.items() if each.ndim == 2]
        return file["heights"].ndim if "heights" in file.variables else 2 if maps else 1
