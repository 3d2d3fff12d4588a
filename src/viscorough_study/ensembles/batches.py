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


def batch_of_curves(curves, *, realizations, hurst, rms, spacing, diameter, until_x, cases, settings):
    """Content of a NetCDF file; lengths in m.

    curves : LoadingCurve of every realization; realizations : their numbers
    rms : {convention: rms heights, shape (realizations,)}, conventions of `RMS`
    hurst, spacing, diameter, until_x : Hurst exponent, spacing of the grid, L and the X that its curve was to reach, of
        every realization; one number in the file where all are equal
    cases : name of the ensemble of every realization
    settings : what the curves were made from, for the attribute settings
    """
    content = stack_curves(curves)
    lengths = {f"rms_{name}": (np.asarray(values), RMS[name], "m") for name, values in rms.items()}
    lengths |= {
        "spacing": (_one_if_equal(spacing), "spacing of the grid", "m"),
        "diameter": (_one_if_equal(diameter), "diameter of the indenter", "m"),
        "hurst": (_one_if_equal(hurst), "Hurst exponent", "1"),
        "until_x": (_one_if_equal(until_x), "X that the curve was to reach", "1"),
        "number": (np.asarray(realizations), "number of the realization", "1"),
        "case": (np.asarray(cases, dtype=object), "name of the ensemble", ""),
    }
    for name, (values, text, units) in lengths.items():
        dimensions = ("realization",) if values.ndim else ()
        attributes = {"long_name": text} | ({"units": units} if units else {})
        content.variables[name] = Variable(dimensions, values, attributes)
    return content.with_attributes(settings=json.dumps(settings))


def numbered(ensembles):
    """[(ensemble, number)] of every realization of a batch (viscorough_study.run.cases.ensembles_of_batch)."""
    return [(one, number) for one in ensembles for number in range(*one["numbers"])]


def without_numbers(ensembles):
    """The ensembles of a batch as the settings of a file record them, whichever realizations the batch has."""
    return [{name: value for name, value in one.items() if name != "numbers"} for one in ensembles]


def _one_if_equal(values):
    values = np.asarray(values)
    return values.flat[0] if values.size == 1 or (values == values.flat[0]).all() else values
