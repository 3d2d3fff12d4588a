"""Pool all realizations of many cases on common abscissae in one dataset, and select ensembles from it.

The dataset has the dimensions rms_convention, realization and abscissa. Hurst exponent, group, case and number of
elements are coordinates of the realizations. It holds no lengths, since the curves are dimensionless, and no averages,
which depend on the selection.
"""

import json

import numpy as np
import pandas as pd
import xarray as xr

from viscorough.io.curves import unstack_curves
from viscorough_study.ensembles.averages import DIMENSIONS, ROUNDING, on_abscissae, with_averages

VARIABLES = {
    "stiffness": "dimensionless stiffness κ = k/(4GL)",
    "contact_count": "elements in contact",
}
REALIZATION_COORDINATES = {
    "hurst": ("Hurst exponent", "1"),
    "group": ("group of cases", ""),
    "case": ("name of the case", ""),
    "elements": ("elements of the indenter", "1"),
    "until_x": ("X that the curve was to reach", "1"),
}


def pool_batches(batches, conventions, x):
    """Pool all batches, sorted by case and number of the realization, irrespective of the batches.

    batches : iterable of (group, Content of ensembles.batches.batch_of_curves); only one at a time is in memory
    conventions : conventions of the rms heights; x : X, shape (abscissae,) [1]
    """
    stiffness, count, realizations, settings = [], [], [], {}
    for group, batch in batches:
        curves, values = unstack_curves(batch), {name: variable.values for name, variable in batch.variables.items()}
        rms = {name: values[f"rms_{name}"] for name in conventions}
        stored = {name: values[name] for name in ("hurst", "case", "until_x", "number")}
        realizations.append(pd.DataFrame(stored | {"group": group, "elements": [curve.elements for curve in curves]}))
        # Whether a shorter curve happens to reach further depends on its surface, so a mean over such curves would be
        # biased.
        beyond = realizations[-1]["until_x"].to_numpy()[:, None] * (1 + ROUNDING) < x
        for parts, part in zip((stiffness, count), on_abscissae(curves, rms, values["diameter"], x), strict=True):
            parts.append(np.where(beyond, np.nan, part))
        made_from = json.loads(batch.attributes["settings"])
        names = settings.setdefault(values["case"][0], made_from).get("ensembles", [])
        names += [ensemble for ensemble in made_from.get("ensembles", []) if ensemble not in names]
    pool = xr.Dataset(coords={"x": ("abscissa", x), "rms_convention": list(conventions)})
    for (name, text), parts in zip(VARIABLES.items(), (stiffness, count), strict=True):
        pool[name] = (DIMENSIONS, np.concatenate(parts, axis=1), {"long_name": text, "units": "1"})
        parts.clear()
    table = pd.concat(realizations)
    for name, (text, units) in REALIZATION_COORDINATES.items():
        attributes = {"long_name": text} | ({"units": units} if units else {})
        pool = pool.assign_coords({name: ("realization", table[name].to_numpy(), attributes)})
    pool["x"].attrs = {"long_name": "dimensionless force F/(4GhL) or time Ft/(4ηhL)", "units": "1"}
    pool["rms_convention"].attrs = {"long_name": "where the rms height h is measured"}
    pool = pool.assign_attrs(title="Loading curves on common abscissae", settings=json.dumps(settings))
    cases = table.groupby(["group", "case"], sort=False).ngroup()
    return pool.isel(realization=np.lexsort((table["number"], cases)))


def select(pool, **coordinates):
    """Return the realizations whose coordinates have these values, such as group="base"."""
    chosen = np.logical_and.reduce([pool[name].values == value for name, value in coordinates.items()])
    return pool.isel(realization=np.flatnonzero(chosen))


def ensembles(pool, *names, rms_convention=None):
    """Return {value of a coordinate, or values of several: ensemble of its realizations}, in the order of the pool.

    rms_convention : the only convention to keep, without its dimension; by default all conventions of the pool

    The ensembles have averages over their realizations (ensembles.averages). Their case is a scalar if all realizations
    agree, otherwise a coordinate of the realizations.
    """
    result, pool = {}, pool if rms_convention is None else pool.sel(rms_convention=rms_convention)
    for values in dict.fromkeys(zip(*(pool[name].values.tolist() for name in names), strict=True)):
        ensemble = with_averages(select(pool, **dict(zip(names, values, strict=True))))
        for name in ("hurst", "elements", "case", "until_x"):
            same = np.unique(ensemble[name].values)  # nan, for measured surfaces, is equal to nan
            ensemble = ensemble.assign_coords({name: same[0]}) if same.size == 1 else ensemble
        result[values if len(names) > 1 else values[0]] = ensemble
    return result


def elements_across(elements):
    """Return the elements across a disc of this number of elements.

    A disc with n across has the elements whose centres lie within (n − 1)/2 of its centre, about π (n − 1)²/4 of them.
    """
    return round(1 + np.sqrt(4 * elements / np.pi))
