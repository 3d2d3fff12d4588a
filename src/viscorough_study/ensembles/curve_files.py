"""Write and read NetCDF files of loading curves: the curves of a batch of surfaces, and the labels of the surfaces."""

import json

import numpy as np

from viscorough.io import netcdf
from viscorough.io.curves import PER_CURVE, STORED, stack_curves
from viscorough.results.loading_curve import LoadingCurve
from viscorough_study.ensembles.realization import RMS, Realization


def write_curves(curves, path, **attributes):
    """Write loading curves to a NetCDF file, atomically; lengths are in the unit of length of the curves.

    curves : iterable of (settings of the ensemble as a dict, Realization, LoadingCurve)
    attributes : further global attributes of the file
    A quantity that is equal for all surfaces is stored once. The attribute `settings` lists the settings of the
    ensembles.
    """
    settings, realizations, curves = zip(*curves, strict=True)
    (variables, about), unit = stack_curves(curves), curves[0].length_unit
    ensemble, number, hurst, diameter, spacing, rms, until_x = zip(*realizations, strict=True)
    stored = {f"rms_{name}": (np.array([heights[name] for heights in rms]), RMS[name], unit) for name in rms[0]}
    stored |= {
        "spacing": (_single_if_equal(spacing), "spacing of the grid", unit),
        "diameter": (_single_if_equal(diameter), "diameter of the indenter", unit),
        "hurst": (_single_if_equal(hurst), "Hurst exponent", "1"),
        "until_x": (_single_if_equal(until_x), "X that the curve was to reach", "1"),
        "number": (np.asarray(number), "number of the realization", "1"),
        "ensemble": (np.asarray(ensemble, dtype=object), "name of the ensemble", ""),
    }
    for name, (values, text, units) in stored.items():
        described = {"long_name": text} | ({"units": units} if units else {})
        variables[name] = ("realization",) * values.ndim, values, described
    netcdf.write(path, variables, about | {"settings": json.dumps(distinct(settings)), **attributes})


def read_curves(path):
    """Read a file that write_curves wrote; return the list of (Realization, LoadingCurve), and the settings.

    The settings are those of all ensembles in the file, as a list of dicts. Raises a one-line ValueError if the file is
    missing or damaged.
    """
    variables, attributes = netcdf.read(path)
    values = {name: each for name, (_, each, _) in variables.items()}
    levels, unit = values["levels"].tolist(), variables["depth"][2]["units"]
    shared = ("ensemble", "number", "hurst", "diameter", "spacing", "until_x")
    labels = zip(*(np.broadcast_to(values[name], len(levels)).tolist() for name in shared), strict=True)
    heights = {name: values[f"rms_{name}"].tolist() for name in RMS if f"rms_{name}" in values}
    per_curve = {name: values[name].tolist() for name in PER_CURVE}
    curves = []
    for i, (ensemble, number, hurst, diameter, spacing, until_x) in enumerate(labels):
        rms = {name: every[i] for name, every in heights.items()}
        fields = {name: every[i] for name, every in per_curve.items()}
        fields |= {name: values[name][i, : levels[i]] for name in STORED}
        # counts are stored as floats, since shorter curves are filled up with nan
        fields["contact_count"] = fields["contact_count"].astype(int)
        curve = LoadingCurve(**fields, length_unit=unit)
        curves.append((Realization(ensemble, number, hurst, diameter, spacing, rms, until_x), curve))
    return curves, json.loads(attributes["settings"])


def distinct(values):
    """Return the different values of an iterable, in their order."""
    found = []
    for value in values:
        if value not in found:
            found.append(value)
    return found


def _single_if_equal(values):
    values = np.asarray(values)
    return values.flat[0] if values.size == 1 or (values == values.flat[0]).all() else values
