"""Batches: the loading curves of some realizations of a case, with the lengths that make them dimensionless."""

import json

import numpy as np

from viscorough.io.curves import stack_curves
from viscorough.io.netcdf import Variable

RMS = {
    "disc": "rms height over the disc",
    "square": "rms height over the periodic square",
    "peak": "highest peak above the mean",
    "ensemble": "rms height over the periodic square on average over all realizations of its spectrum",
    "line": "rms height of the line",
}


def batch_of_curves(curves, *, realizations, hurst, rms, spacing, diameter, settings):
    """Content of a NetCDF file; lengths in m.

    curves : LoadingCurve of every realization; realizations : their numbers
    rms : {convention: rms heights, shape (realizations,)}, conventions of `RMS`
    spacing : of the grid; diameter : L; settings : what the curves were made from, for the attribute settings
    """
    content = stack_curves(curves)
    heights = {f"rms_{name}": (values, RMS[name]) for name, values in rms.items()}
    lengths = heights | {
        "spacing": (spacing, "spacing of the grid"),
        "diameter": (diameter, "diameter of the indenter"),
    }
    variables = {
        name: Variable(("realization",) if np.ndim(values) else (), np.asarray(values), _about(text, "m"))
        for name, (values, text) in lengths.items()
    }
    variables["hurst"] = Variable((), np.asarray(hurst), _about("Hurst exponent", "1"))
    variables["realization"] = Variable(("realization",), np.asarray(realizations), _about("number of it", "1"))
    content.variables.update(variables)
    return content.with_attributes(settings=json.dumps(settings))


def _about(text, units):
    return {"long_name": text, "units": units}
