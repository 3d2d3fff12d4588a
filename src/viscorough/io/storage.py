"""Files: CF NetCDF datasets that appear whole or not at all; loading curves, tables and height maps in them.

Lengths have the unit of the caller's choice, and a CF reader needs one that it can parse: `length_unit` is
"m" in the workflow; where the unit is not known it is "1", the numbers being multiples of whatever unit the
heights have.
"""

import glob
import os
import platform
import re
import uuid
from contextlib import contextmanager
from importlib.metadata import version
from pathlib import Path

import numpy as np
import psutil
import xarray as xr

from viscorough.indenter import Indenter
from viscorough.loading_curve import LoadingCurve

COMPRESSED_FROM = 4096  # values; below, chunks cost more than compression saves

COMMENT = (
    "Rigid indenter on an incompressible half-space, no friction, no adhesion. Depth is from first contact, "
    "force is F/G, stiffness is d(F/G)/du. With viscosity for G and impulse for F it is the viscous solution."
)
# variable over levels: (long_name, power of the length unit)
OVER_LEVELS = {
    "depth": ("depth of indentation u", 1),
    "force": ("normal force over shear modulus F/G", 2),
    "stiffness": ("tangent stiffness over shear modulus k/G", 1),
    "contact_count": ("number of elements in contact", 0),
    "contact_fraction": ("share of the indenter's elements in contact", 0),
    "residual": ("largest gap in contact or penetration that was left, over depth", 0),
}
STORED = [name for name in OVER_LEVELS if name != "contact_fraction"]  # fields of LoadingCurve, not derived
PER_CURVE = {
    "elements": (int, "number of elements of the indenter"),
    "operator_applications": (int, "applications of the half-space operator on the grid"),
    "tolerance": (float, "relative accuracy asked for"),
    "method": (str, "how the curve was obtained"),
}


def _reason(error):
    return " ".join(str(getattr(error, "strerror", None) or error).split())


# ---- writing


def check_output(path):
    """The path with links resolved, so that a link's target is replaced and not the link.

    Raises ValueError unless the folder exists and is writable and nothing but a regular file is in the place.
    """
    target, folder = Path(os.path.realpath(path)), Path(path).parent
    if not target.parent.is_dir():
        raise ValueError(f"{path}: there is no folder {folder}; an existing folder is needed")
    if not os.access(target.parent, os.W_OK | os.X_OK):
        raise ValueError(f"{path}: the folder {folder} is not writable; a writable folder is needed")
    if target.exists() and not target.is_file():
        raise ValueError(f"{path}: is not a regular file; a new file or one to be replaced is needed")
    return target


@contextmanager
def whole_or_not_at_all(path):
    """Give a temporary name beside `path`; what is written there becomes `path` on success, else vanishes.

    What a killed process of this machine has left of an earlier attempt vanishes, too.
    """
    target = check_output(path)
    stem = f".{target.name[:60]}.{platform.node()}"
    temporary = target.with_name(f"{stem}.{os.getpid()}.{uuid.uuid4().hex[:8]}.part")
    for left in target.parent.glob(f"{glob.escape(stem)}.*.part"):
        process = left.name.removeprefix(stem).split(".")[1]
        if process.isdecimal() and not psutil.pid_exists(int(process)):
            left.unlink(missing_ok=True)
    try:
        yield temporary
        with open(temporary, "rb") as file:
            os.fsync(file.fileno())  # a full or remote disk may report its failure only here
        os.replace(temporary, target)
    except (OSError, RuntimeError) as error:  # the NetCDF library raises RuntimeError where the disk is full
        raise OSError(f"{path}: not written ({_reason(error)}); room on a writable disk is needed") from error
    finally:
        temporary.unlink(missing_ok=True)


def write_dataset(ds, path):
    """Write a dataset as CF-1.11 NetCDF, whole or not at all.

    Every data variable needs `long_name`, and `units` unless it holds text. Adds the attributes Conventions
    and source ("viscorough <version>"), compresses large floats; nothing depends on when or where the file is
    written. Raises ValueError for missing attributes and for a path where no file can appear, OSError if
    writing fails.
    """
    for name, variable in ds.data_vars.items():
        needed = ("long_name", "units") if variable.dtype.kind in "biufc" else ("long_name",)
        if missing := [attribute for attribute in needed if not variable.attrs.get(attribute)]:
            raise ValueError(f"{path}: variable {name} lacks {' and '.join(missing)}; all need both")
    ds = ds.drop_encoding().assign_attrs(Conventions="CF-1.11", source=f"viscorough {version('viscorough')}")
    encoding = {}
    for name, variable in ds.variables.items():
        if variable.dtype.kind in "fi":
            large = variable.size >= COMPRESSED_FROM
            encoding[name] = {"zlib": True, "complevel": 4, "shuffle": True} if large else {}
            if name in ds.coords:
                encoding[name]["_FillValue"] = None  # in CF no value of a coordinate may be missing
    with whole_or_not_at_all(path) as temporary:
        ds.to_netcdf(temporary, engine="netcdf4", encoding=encoding)


# ---- reading


@contextmanager
def _opened(path):
    """The dataset in a file, read as it is used; whatever is wrong with the file is a one-line ValueError."""
    try:
        open(path, "rb").close()  # the system's own words, where the NetCDF library has vaguer ones
        with xr.open_dataset(path, engine="netcdf4", decode_times=False, decode_timedelta=False) as ds:
            yield ds
    except (OSError, RuntimeError, ValueError, LookupError, TypeError, AttributeError) as error:
        raise ValueError(f"{path}: not readable ({_reason(error)}); a whole NetCDF file is needed") from error


def read_dataset(path):
    """Read a NetCDF file into memory and close it; a one-line ValueError if it is missing or damaged."""
    with _opened(path) as ds:
        return ds.load().drop_encoding()


def _height_variable(path):
    """The NetCDF variable of the heights, in memory: the one named so, else the only two-dimensional one."""
    with _opened(path) as ds:
        maps = [name for name, variable in ds.data_vars.items() if variable.ndim == 2]
        names = ["heights"] if "heights" in ds.data_vars else maps
        variable = ds[names[0]].load() if len(names) == 1 else None
    if variable is None:
        found = f"two-dimensional variables {', '.join(maps)}" if maps else "no two-dimensional variable"
        raise ValueError(f"{path}: {found}; exactly one, or one named heights, is needed")
    return variable


def _npy_array(path):
    try:
        with open(path, "rb") as file:
            return np.lib.format.read_array(file, allow_pickle=False)
    except MemoryError:
        raise
    except Exception as error:  # numpy parses the header as Python, where damage shows as any kind of error
        raise ValueError(f"{path}: not readable ({_reason(error)}); a .npy file of numbers is needed") from error


def read_heights(path, spacing):
    """Read a map of heights (larger = higher peak, touches first; nan = outside the indenter) as an Indenter.

    path : .npy of shape (rows, columns), or .nc with one two-dimensional variable or one named `heights`
    spacing : of neighbouring points, in the unit of the heights

    Heights are taken in double precision. Raises a one-line ValueError that names the file and what is wrong.
    """
    if Path(path).suffix not in (".npy", ".nc"):
        raise ValueError(f"{path}: unknown kind of file; heights are read from .npy and .nc")
    heights = _npy_array(path) if Path(path).suffix == ".npy" else _height_variable(path).values
    if heights.dtype.kind not in "iuf":
        raise ValueError(f"{path}: heights are of type {heights.dtype}; real numbers are needed")
    if heights.ndim != 2:
        raise ValueError(f"{path}: heights have the shape {heights.shape}; a two-dimensional map is needed")
    try:
        # also brings foreign byte orders and half precision to what compiled loops take
        return Indenter(np.ascontiguousarray(heights, dtype=float), spacing)
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from error


def length_unit_of(path):
    """Unit that the heights in a .nc file state; "1" if none, and for .npy files."""
    unit = _height_variable(path).attrs.get("units") if Path(path).suffix == ".nc" else None
    return unit if isinstance(unit, str) and unit.strip() else "1"


# ---- loading curves, and what becomes of them in time


def _check(curve):
    """Raise ValueError for what is no curve: overflow or a damaged file must not pass for a result."""
    if curve.depth.size == 0:
        raise ValueError("loading curve: there is no level; at least one is needed")
    for name in ("depth", "force"):
        values = getattr(curve, name)
        if not (np.isfinite(values).all() and (np.diff(values, prepend=0) > 0).all()):
            raise ValueError(f"loading curve: {name} must be finite, positive and increase from level to level")
    if not (np.isfinite(curve.stiffness).all() and (curve.stiffness > 0).all()):
        raise ValueError("loading curve: stiffness must be finite and positive")


def _attributes(name, length_unit):
    long_name, power = OVER_LEVELS[name]
    if power == 0 or length_unit == "1":
        units = "1"
    elif power == 1:
        units = length_unit
    else:  # UDUNITS: m2, but (1e-6 m)2
        units = f"{length_unit if re.fullmatch('[A-Za-z]+', length_unit) else f'({length_unit})'}{power}"
    return {"long_name": long_name, "units": units}


def curve_to_dataset(curve, length_unit="m"):
    """One LoadingCurve as a Dataset: variables OVER_LEVELS on the dimension `level`, attributes PER_CURVE.

    length_unit : of the curve, as UDUNITS spells it; "1" if it is not known

    Raises ValueError unless depth and force increase and all numbers are positive and finite.
    """
    _check(curve)
    ds = xr.Dataset(attrs={"title": "Loading curve of a rigid indenter", "comment": COMMENT})
    for name in OVER_LEVELS:
        ds[name] = ("level", getattr(curve, name), _attributes(name, length_unit))
    return ds.assign_attrs({name: getattr(curve, name) for name in PER_CURVE})


def curve_from_dataset(ds):
    """The LoadingCurve of a Dataset made by curve_to_dataset. Raises ValueError if it does not hold one."""
    for name in STORED:
        if name not in ds.variables or ds[name].dims != ("level",) or ds[name].dtype.kind not in "iuf":
            raise ValueError(f"no numbers {name}(level); a loading curve of viscorough indent is needed")
    for name in PER_CURVE:
        if name not in ds.attrs:
            raise ValueError(f"no attribute {name}; a loading curve of viscorough indent is needed")
    about = {name: convert(ds.attrs[name]) for name, (convert, _) in PER_CURVE.items()}
    curve = LoadingCurve(**{name: ds[name].values for name in STORED}, **about)
    _check(curve)
    return curve


def with_motion(ds, time, velocity):
    """A dataset that has depth(level), with time and velocity added."""
    unit = ds["depth"].attrs.get("units", "1")
    unit = "s-1" if unit == "1" else f"{unit} s-1"
    return ds.assign(
        time=("level", time, {"long_name": "time since the force was applied", "units": "s"}),
        velocity=("level", velocity, {"long_name": "velocity of penetration du/dt", "units": unit}),
    )


def read_force_history(path):
    """Times and forces in a file, two columns of numbers: .csv (a line of names may come first) or .npy.

    Raises a one-line ValueError that names the file and what is wrong; what a history is, viscous.impulses checks.
    """
    if Path(path).suffix not in (".npy", ".csv"):
        raise ValueError(f"{path}: unknown kind of file; a force history is read from .csv and .npy")
    if Path(path).suffix == ".npy":
        table = _npy_array(path)
    else:
        try:
            lines = Path(path).read_text(encoding="utf-8").splitlines()
            first = 1 if lines and any(letter.isalpha() for letter in lines[0].lower().replace("e", "")) else 0
            table = np.loadtxt(lines[first:], delimiter=",", ndmin=2)
        except (OSError, ValueError) as error:
            raise ValueError(
                f"{path}: not readable ({_reason(error)}); two columns, time and force, are needed"
            ) from error
    if table.ndim != 2 or table.shape[1] != 2 or table.shape[0] < 2 or table.dtype.kind not in "iuf":
        raise ValueError(f"{path}: has the shape {table.shape}; two columns, time and force, and two rows are needed")
    return table[:, 0].astype(float), table[:, 1].astype(float)


def march_under_history(march, times, force, impulse, viscosity, length_unit="m"):
    """A direct integration read at the times of a force history (viscous.impulses), as a Dataset over levels.

    march : marching.Events, or stepping.Steps that end at every impulse/viscosity above zero
    """
    reached = impulse / viscosity
    if hasattr(march, "event_at"):
        if reached[-1] > march.impulse[-1] * (1 + 1e-10) and march.contact_count[-1] < march.elements:
            raise ValueError(
                f"impulse: {impulse[-1]:.6g} is beyond the contact fraction at which events end; "
                f"allowed: up to {march.impulse[-1] * viscosity:.6g}"
            )
        i, depth = march.event_at(reached), march.depth_at(reached)
    else:
        i = np.searchsorted(march.impulse, reached * (1 - 1e-12))
        depth = np.where(reached > 0, march.depth[i], 0.0)
    ds = xr.Dataset(
        attrs={"title": "Penetration of a rigid indenter under a force history, integrated directly in time"}
    )
    ds["depth"] = ("level", depth, _attributes("depth", length_unit))
    ds["contact_count"] = ("level", march.contact_count[i], _attributes("contact_count", length_unit))
    ds["force"] = ("level", force, {"long_name": "force F at that time", "units": "1"})
    return with_motion(ds, times, force / (viscosity * march.resistance[i]))


def march_to_dataset(march, force_per_viscosity, length_unit="m"):
    """A direct integration (marching.Events or stepping.Steps) under constant force as a Dataset over levels."""
    ds = xr.Dataset(attrs={"title": "Penetration of a rigid indenter, integrated directly in time"})
    for name in ("depth", "contact_count"):
        ds[name] = ("level", getattr(march, name), _attributes(name, length_unit))
    about = {"long_name": "largest overlap of indenter and surface, over depth", "units": "1"}
    ds["overlap"] = ("level", getattr(march, "overlap", np.zeros_like(march.depth)), about)
    return with_motion(ds, march.impulse / force_per_viscosity, force_per_viscosity / march.resistance)


def stack_curves(curves, length_unit="m"):
    """LoadingCurves as one Dataset (realization, level), nan beyond each curve's last level.

    Per realization: `levels`, the number of levels, and PER_CURVE. Raises ValueError for an empty list and
    for what curve_to_dataset refuses.
    """
    if not curves:
        raise ValueError("stack_curves: there is no curve; at least one is needed")
    for curve in curves:
        _check(curve)
    levels = np.array([curve.depth.size for curve in curves])
    ds = xr.Dataset(attrs={"title": "Loading curves of rigid indenters", "comment": COMMENT})
    for name in OVER_LEVELS:
        padded = np.full((len(curves), levels.max()), np.nan)
        for row, curve in zip(padded, curves, strict=True):
            row[: curve.depth.size] = getattr(curve, name)
        ds[name] = (("realization", "level"), padded, _attributes(name, length_unit))
    ds["levels"] = ("realization", levels, {"long_name": "number of levels of the curve", "units": "1"})
    for name, (kind, long_name) in PER_CURVE.items():
        values = np.array([getattr(curve, name) for curve in curves], dtype=object if kind is str else kind)
        ds[name] = ("realization", values, {"long_name": long_name} | ({} if kind is str else {"units": "1"}))
    return ds


def unstack_curves(ds):
    """The LoadingCurves of a Dataset made by stack_curves, in order."""
    curves = []
    for index in range(ds.sizes["realization"]):
        one = ds.isel(realization=index)
        values = {name: one[name].values[: int(one["levels"])] for name in STORED}
        values["contact_count"] = values["contact_count"].astype(int)  # floats only for the sake of nan
        about = {name: convert(one[name].item()) for name, (convert, _) in PER_CURVE.items()}
        curves.append(LoadingCurve(**values, **about))
    return curves
