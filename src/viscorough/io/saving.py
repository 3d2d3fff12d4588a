"""Loading curves, motions and surfaces as files that the command line reads and writes."""

from viscorough.indenter import Indenter
from viscorough.io import netcdf, tables
from viscorough.io.curves import curve_from_content, curve_to_content
from viscorough.io.motion import kinetics_to_content
from viscorough.io.netcdf import Content
from viscorough.io.surfaces import surface_to_content
from viscorough.loading_curve import LoadingCurve
from viscorough.types import FilePath
from viscorough.viscous.correspondence import Kinetics


def save_curve(curve: LoadingCurve, path: FilePath) -> None:
    """Write a loading curve as NetCDF, or as a table if the name ends in .csv; atomically.

    Parameters
    ----------
    curve : LoadingCurve
        The curve.
    path : path
        File to write or replace.

    Raises
    ------
    ValueError
        For a path that cannot be written.
    OSError
        If writing fails.

    Examples
    --------
    >>> import viscorough
    >>> disc = viscorough.self_affine_disc(0.7, 17, rms=0.01, seed=1)
    >>> curve = viscorough.indent(disc)
    >>> import os, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     viscorough.save_curve(curve, f"{folder}/curve.csv")
    ...     os.listdir(folder)
    ['curve.csv']
    """
    write_content(curve_to_content(curve), path)


def load_curve(path: FilePath) -> LoadingCurve:
    """Read the loading curve in a file of `save_curve` or of the command viscorough indent.

    Parameters
    ----------
    path : path
        A NetCDF file, or a table (.csv).

    Returns
    -------
    LoadingCurve

    Raises
    ------
    ValueError
        In one line, if the file is missing or damaged or holds no loading curve.

    Examples
    --------
    >>> import viscorough
    >>> disc = viscorough.self_affine_disc(0.7, 17, rms=0.01, seed=1)
    >>> curve = viscorough.indent(disc)
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     viscorough.save_curve(curve, f"{folder}/curve.nc")
    ...     loaded = viscorough.load_curve(f"{folder}/curve.nc")
    >>> bool((loaded.force == curve.force).all())
    True
    """
    content = (tables if tables.is_table(path) else netcdf).read(path)
    try:
        return curve_from_content(content)
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from error


def save_heights(indenter: Indenter, path: FilePath) -> None:
    """Write the heights of an indenter as NetCDF, with its spacing and unit of length, for `read_heights`; atomically.

    Parameters
    ----------
    indenter : Indenter
        A map, or a line.
    path : path
        File to write or replace.

    Raises
    ------
    ValueError
        For a path that cannot be written.
    OSError
        If writing fails.

    Examples
    --------
    >>> import viscorough
    >>> disc = viscorough.self_affine_disc(0.7, 17, rms=0.01, seed=1)
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     viscorough.save_heights(disc, f"{folder}/disc.nc")
    ...     loaded = viscorough.read_heights(f"{folder}/disc.nc")
    >>> loaded.elements == disc.elements
    True
    """
    write_content(surface_to_content(indenter), path)


def save_motion(motion: Kinetics, path: FilePath) -> None:
    """Write penetration over time as NetCDF, or as a table if the name ends in .csv, atomically.

    Parameters
    ----------
    motion : Kinetics
        Time, depth and velocity, as of `kinetics`.
    path : str or os.PathLike
        File to be written.

    Raises
    ------
    ValueError
        For a path that cannot be written.
    OSError
        If writing fails.

    Examples
    --------
    >>> import tempfile
    >>> import viscorough
    >>> curve = viscorough.indent(viscorough.self_affine_disc(0.7, 17, seed=1))
    >>> motion = viscorough.kinetics(curve, force=1e-3, medium=1.0)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     viscorough.save_motion(motion, f"{folder}/motion.csv")
    """
    write_content(kinetics_to_content(motion, None, motion.length_unit), path)


def write_content(content: Content, path: FilePath) -> None:
    """Write a Content as NetCDF, or as a table if the name ends in .csv; errors as of `save_curve`."""
    (tables if tables.is_table(path) else netcdf).write(content, path)
