"""Write and read NetCDF files of surfaces, one surface at a time; each ensemble is a group of the file."""

import json

import netCDF4
import numpy as np

from viscorough.io import netcdf
from viscorough.surfaces.indenter import Indenter
from viscorough_study.ensembles.realization import RMS, Realization


def write_surfaces(ensembles, path, **attributes):
    """Write surfaces to a NetCDF file, atomically; only one surface at a time is in memory.

    ensembles : list of tuples (settings, number, surfaces), one for each ensemble: its settings as a dict, the number
        of realizations, and an iterable of (Realization, Indenter). Surfaces of an ensemble may differ only in number,
        heights and rms heights.
    attributes : further global attributes of the file
    """
    with netcdf.written_with_digest(path) as temporary, netCDF4.Dataset(temporary, "w") as file:
        file.set_fill_off()  # no fill values are needed, since every value is written
        title = {"title": "Heights of rigid indenters; larger is higher"}
        file.setncatts(title | attributes | netcdf.global_attributes())
        for position, (settings, number, surfaces) in enumerate(ensembles):
            group = file.createGroup(f"ensemble_{position}")
            group.createDimension("realization", number)
            realizations = []
            for realization, indenter in surfaces:
                if not realizations:
                    group.setncatts({"title": realization.ensemble, "settings": json.dumps(settings)})
                    heights = _define(group, realization, indenter)
                heights[len(realizations)] = indenter.heights
                realizations.append(realization)
            group["number"][:] = [realization.number for realization in realizations]
            for name in realizations[0].rms:
                group[f"rms_{name}"][:] = [realization.rms[name] for realization in realizations]


def _define(group, realization, indenter):
    """Define the variables of an ensemble in its NetCDF group, and write the values that all realizations share.

    Returns the variable of the heights.
    """

    def variable(name, dimensions, long_name, units=indenter.length_unit, **kind):
        stored = group.createVariable(name, kind.pop("kind", "f8"), dimensions, **kind)
        stored.setncatts({"long_name": long_name, "units": units})
        return stored

    axes = ("y", "rows", indenter.row_spacing), ("x", "columns", indenter.spacing)
    for (name, neighbours, spacing), points in zip(axes, indenter.heights.shape, strict=True):
        group.createDimension(name, points)
        variable(name, name, f"position along {name}")[:] = spacing * (np.arange(points) - (points - 1) / 2)
        variable(f"spacing_{name}", (), f"distance between neighbouring {neighbours}")[:] = spacing
    variable("diameter", (), "diameter of the indenter")[:] = realization.diameter
    variable("hurst", (), "Hurst exponent", "1")[:] = realization.hurst
    variable("number", "realization", "number of the realization", "1", kind="i8")
    for name in realization.rms:
        variable(f"rms_{name}", "realization", RMS[name])
    return variable("heights", ("realization", "y", "x"), "height", kind=indenter.heights.dtype, fill_value=np.nan)


def read_surfaces(path):
    """Yield (settings of the ensemble, Realization, Indenter) for every surface in a file.

    Surfaces are read one at a time. Raises a one-line ValueError if the file is missing or damaged.
    """
    with netcdf.opened(path) as file:
        file.set_auto_mask(False)
        for group in file.groups.values():
            names = ("hurst", "diameter", "spacing_x", "spacing_y")
            hurst, diameter, spacing, row_spacing = (group[name][...].item() for name in names)
            rms = {name: group[f"rms_{name}"][...].tolist() for name in RMS if f"rms_{name}" in group.variables}
            settings, heights = json.loads(group.settings), group["heights"]
            unit = heights.units
            for i, number in enumerate(group["number"][...].tolist()):
                own = {name: every[i] for name, every in rms.items()}
                realization = Realization(group.title, number, hurst, diameter, spacing, own)
                yield settings, realization, Indenter(heights[i], spacing, row_spacing, unit)
