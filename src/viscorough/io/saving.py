"""Results as files that the command line reads and writes."""

from viscorough.contact_maps import Contact
from viscorough.estimates import Estimate
from viscorough.indenter import Indenter
from viscorough.io import netcdf, tables
from viscorough.io.contacts import contacts_to_content
from viscorough.io.curves import curve_from_content, curve_to_content
from viscorough.io.heights import surface_to_content
from viscorough.io.media import identified_to_content, save_identified
from viscorough.io.motion import estimate_to_content, motion_to_content
from viscorough.io.suffixes import RESULTS, check_suffix
from viscorough.loading_curve import LoadingCurve
from viscorough.types import FilePath
from viscorough.viscous.identification import IdentifiedMedium
from viscorough.viscous.motion import Motion

Result = Indenter | LoadingCurve | Contact | Motion | Estimate | IdentifiedMedium
WRITERS = {".nc": netcdf.write, ".csv": tables.write}


def save(result: Result, path: FilePath) -> None:
    """Write a result as the file that the command line writes and reads; atomically. The same as `result.save(path)`.

    Parameters
    ----------
    result : Indenter, LoadingCurve, Contact, Motion, Estimate or IdentifiedMedium
        Heights are read by `read_heights`, a curve by `load_curve`, a medium by `read_medium`.
    path : path
        File to write or replace: NetCDF (.nc), or a table (.csv) of a curve, motion, estimate or line. A medium is YAML
        (.yaml); its creep table, in the same folder, has the suffix .csv. Other suffixes are refused.

    Raises
    ------
    ValueError
        For a path that cannot be written, and a suffix that does not suit the result.
    OSError
        If writing fails.

    Examples
    --------
    >>> import viscorough
    >>> disc = viscorough.self_affine_disc(0.7, 17, rms=0.01, seed=1)
    >>> import os, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     viscorough.save(disc, f"{folder}/disc.nc")
    ...     viscorough.indent(disc).save(f"{folder}/curve.csv")
    ...     sorted(os.listdir(folder))
    ['curve.csv', 'disc.nc']
    """
    if isinstance(result, IdentifiedMedium):
        save_identified(result, path)
    else:
        write_content(to_content(result), path)


def load_curve(path: FilePath) -> LoadingCurve:
    """Read the loading curve in a file of `save` or of the command viscorough indent.

    Parameters
    ----------
    path : path
        A NetCDF file.

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
    ...     curve.save(f"{folder}/curve.nc")
    ...     loaded = viscorough.load_curve(f"{folder}/curve.nc")
    >>> bool((loaded.force == curve.force).all())
    True
    """
    return curve_from_content(netcdf.read(path))


def to_content(result: Result) -> netcdf.Content:
    """A result as the Content of its file."""
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
    if isinstance(result, IdentifiedMedium):
        return identified_to_content(result)
    raise TypeError(
        f"{type(result).__name__} is no result; an Indenter, LoadingCurve, Contact, Motion, Estimate or "
        "IdentifiedMedium is needed"
    )


def write_content(content: netcdf.Content, path: FilePath) -> None:
    """Write a Content as NetCDF, or as a table if the name ends in .csv; errors as `save`."""
    WRITERS[check_suffix(path, RESULTS)](content, path)
