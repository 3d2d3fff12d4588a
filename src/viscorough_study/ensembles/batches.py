"""Store loading curves in batches: files with the curves of some realizations, and the lengths of their surfaces."""

import json
from typing import NamedTuple

import numpy as np

from viscorough.io.curves import stack_curves
from viscorough.io.netcdf import Variable

RMS = {
    "disc": "rms height over the disc",
    "square": "rms height over the periodic square",
    "ensemble": "rms height over the periodic square on average over all realizations of its spectrum",
    "line": "rms height of the line",
}


class Realization(NamedTuple):
    """Labels, Hurst exponent and lengths of one surface of an ensemble.

    All lengths are in the unit of length of the indenter, which is "m", or "1" if lengths are dimensionless.

    ensemble : name of the ensemble
    number : number of the realization in the ensemble
    hurst : Hurst exponent, nan for a measured surface
    diameter : L, the diameter of a disc, or the length of a line
    spacing : distance between neighbouring columns of a map of heights, or between neighbouring points of a line
    rms : {key of `RMS`, which says where the rms height is measured: rms height}
    """

    ensemble: str
    number: int
    hurst: float
    diameter: float
    spacing: float
    rms: dict


def batch_of_curves(members, settings):
    """Return the loading curves of several surfaces as the Content of a NetCDF file.

    Lengths are in the unit of length of the curves.
    members : for every surface a tuple: LoadingCurve, Realization, and the X up to which the curve was to be computed
    settings : settings of the curves, which are stored in the attribute `settings`
    A quantity that is equal for all surfaces is stored once.
    """
    curves, realizations, until_x = zip(*members, strict=True)
    content, unit = stack_curves(curves), curves[0].length_unit
    ensemble, number, hurst, diameter, spacing, rms = zip(*realizations, strict=True)
    stored = {f"rms_{name}": (np.array([heights[name] for heights in rms]), RMS[name], unit) for name in rms[0]}
    stored |= {
        "spacing": (_single_if_equal(spacing), "spacing of the grid", unit),
        "diameter": (_single_if_equal(diameter), "diameter of the indenter", unit),
        "hurst": (_single_if_equal(hurst), "Hurst exponent", "1"),
        "until_x": (_single_if_equal(until_x), "X that the curve was to reach", "1"),
        "number": (np.asarray(number), "number of the realization", "1"),
        "case": (np.asarray(ensemble, dtype=object), "name of the ensemble", ""),
    }
    for name, (values, text, units) in stored.items():
        attributes = {"long_name": text} | ({"units": units} if units else {})
        content.variables[name] = Variable(("realization",) * values.ndim, values, attributes)
    return content.with_attributes(settings=json.dumps(settings))


def without_numbers(ensembles):
    """Return descriptions of ensembles without the entry `numbers`, the range of realizations in one batch.

    The descriptions are stored in this form, so they do not depend on how the ensembles are divided into batches.
    """
    return [{name: value for name, value in ensemble.items() if name != "numbers"} for ensemble in ensembles]


def _single_if_equal(values):
    values = np.asarray(values)
    return values.flat[0] if values.size == 1 or (values == values.flat[0]).all() else values
