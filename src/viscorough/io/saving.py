"""Write results to files in the formats that the command line uses, and read loading curves from such files."""

from typing import Any

from viscorough.basics.types import FilePath
from viscorough.io import netcdf, tables
from viscorough.io.contact_files import contacts_to_content
from viscorough.io.curves import curve_from_content, curve_to_content
from viscorough.io.heights import surface_to_content
from viscorough.io.motion_files import estimate_to_content, motion_to_content
from viscorough.io.refusals import path_named
from viscorough.io.suffixes import RESULTS, check_suffix
from viscorough.law.estimate import Estimate
from viscorough.results.contact_maps import Contact
from viscorough.results.loading_curve import LoadingCurve
from viscorough.results.motion import Motion
from viscorough.surfaces.indenter import Indenter

Result = Indenter | LoadingCurve | Contact | Motion | Estimate
WRITERS: dict[str, Any] = {".nc": netcdf.write, ".csv": tables.write}


def save(result: Result, path: FilePath) -> None:
    """Write a result to a file, in a format that the command line uses, too.

    The file is written as a whole or not at all.

    Parameters
    ----------
    result : Indenter, LoadingCurve, Contact, Motion or Estimate
        Result of the library. `read_heights` reads heights again, and `load_curve` a curve.
    path : path
        File to write or replace. The suffix .nc selects NetCDF; .csv selects a table and suits a curve, motion,
        estimate or line.

    Raises
    ------
    ValueError
        For a path that cannot be written, and for a suffix that does not suit the result.
    OSError
        If writing fails.

    Examples
    --------
    >>> import viscorough
    >>> disc = viscorough.self_affine_disc(0.7, 17, rms=0.01, seed=1)
    >>> import os, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     viscorough.save(disc, f"{folder}/disc.nc")
    ...     viscorough.save(viscorough.indent(disc), f"{folder}/curve.csv")
    ...     sorted(os.listdir(folder))
    ['curve.csv', 'disc.nc']
    """
    write_content(to_content(result), path)


def load_curve(path: FilePath) -> LoadingCurve:
    """Read a loading curve from a file that `save` or the command viscorough indent wrote.

    Parameters
    ----------
    path : path
        NetCDF file (.nc).

    Returns
    -------
    LoadingCurve

    Raises
    ------
    ValueError
        For a file that is missing or damaged, or that holds no loading curve. The message has one line.

    Examples
    --------
    >>> import viscorough
    >>> disc = viscorough.self_affine_disc(0.7, 17, rms=0.01, seed=1)
    >>> curve = viscorough.indent(disc)
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     viscorough.save(curve, f"{folder}/curve.nc")
    ...     loaded = viscorough.load_curve(f"{folder}/curve.nc")
    >>> bool((loaded.force == curve.force).all())
    True
    """
    content = netcdf.read(path)
    with path_named(path):
        return curve_from_content(content)


def to_content(result: Result) -> netcdf.Content:
    """Convert a result to the content of the file that `save` writes. Raises TypeError for other types of objects."""
    if isinstance(result, LoadingCurve):
        return curve_to_content(result)
    if isinstance(result, Motion):
        return motion_to_content(result)
    if isinstance(result, Contact):
        return contacts_to_content([result])
    if isinstance(result, Indenter):
        return surface_to_content(result)
    if isinstance(result, Estimate):
        return estimate_to_content(result)
    raise TypeError(
        f"{type(result).__name__} is no result; an Indenter, LoadingCurve, Contact, Motion or Estimate is needed"
    )


def write_content(content: netcdf.Content, path: FilePath) -> None:
    """Write variables and attributes as NetCDF, or as a table for .csv. Raises the errors of `save`."""
    WRITERS[check_suffix(path, RESULTS)](path, *content)
