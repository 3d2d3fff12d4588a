"""Pools: all realizations of many cases on common abscissae in one dataset, and ensembles taken out of it.

The dataset has the dimensions rms_convention, realization and abscissa. Hurst exponent, group, case, diameter and
number of elements are coordinates of the realizations. It holds no averages, which depend on what is taken out.
"""

import json

import numpy as np
import xarray as xr

from viscorough.io.curves import unstack_curves
from viscorough_study.ensembles.averages import ROUNDING, ensemble_dataset, on_abscissae

DIMENSIONS = ("rms_convention", "realization", "abscissa")
VARIABLES = {
    "stiffness": "dimensionless stiffness κ = k/(4GL)",
    "contact_count": "elements in contact",
}
OF_REALIZATIONS = {
    "hurst": ("Hurst exponent", "1"),
    "group": ("group of cases", ""),
    "case": ("name of the case", ""),
    "diameter": ("diameter of the indenter", "m"),
    "elements": ("elements of the indenter", "1"),
    "until_x": ("X that the curve was to reach", "1"),
}


def pool_batches(batches, conventions, x):
    """The pool of all batches, sorted by case and number of the realization, whichever batch each of them was in.

    batches : iterable of (group, Content of ensembles.batches.batch_of_curves); one at a time need be in memory
    conventions : of the rms heights; x : X, shape (abscissae,) [1]
    """
    stiffness, count, settings, numbers = [], [], {}, []
    about = {name: [] for name in OF_REALIZATIONS}
    for group, batch in batches:
        curves, values = unstack_curves(batch), {name: variable.values for name, variable in batch.variables.items()}
        rms = {name: values[f"rms_{name}"] for name in conventions}
        # Which of the shorter curves reach further by chance depends on the surface: a mean over them would be biased.
        beyond = np.broadcast_to(values["until_x"], len(curves))[:, None] * (1 + ROUNDING) < x
        for parts, part in zip((stiffness, count), on_abscissae(curves, rms, values["diameter"], x), strict=True):
            parts.append(np.where(beyond, np.nan, part))
        of_batch = {name: values[name] for name in ("hurst", "case", "diameter", "until_x")}
        of_batch |= {"group": group, "elements": [curve.elements for curve in curves]}
        for name, value in of_batch.items():
            about[name] += np.broadcast_to(value, len(curves)).tolist()
        numbers += values["number"].tolist()
        made_from = json.loads(batch.attributes["settings"])
        known = settings.setdefault(values["case"][0], made_from).get("ensembles", [])
        known += [one for one in made_from.get("ensembles", []) if one not in known]
    pool = xr.Dataset(coords={"x": ("abscissa", x), "rms_convention": list(conventions)})
    for (name, text), parts in zip(VARIABLES.items(), (stiffness, count), strict=True):
        pool[name] = (DIMENSIONS, np.concatenate(parts, axis=1), {"long_name": text, "units": "1"})
        parts.clear()
    for name, (text, units) in OF_REALIZATIONS.items():
        attributes = {"long_name": text} | ({"units": units} if units else {})
        pool = pool.assign_coords({name: ("realization", about[name], attributes)})
    pool["x"].attrs = {"long_name": "dimensionless force F/(4GhL) or time Ft/(4ηhL)", "units": "1"}
    pool["rms_convention"].attrs = {"long_name": "where the rms height h is measured"}
    pool = pool.assign_attrs(title="Loading curves on common abscissae", settings=json.dumps(settings))
    cases = {name: rank for rank, name in enumerate(dict.fromkeys(zip(about["group"], about["case"], strict=True)))}
    ranks = [cases[pair] for pair in zip(about["group"], about["case"], strict=True)]
    return pool.isel(realization=np.lexsort((numbers, ranks)))


def select(pool, **wanted):
    """The realizations whose coordinates have these values, such as group="base"."""
    chosen = np.logical_and.reduce([pool[name].values == value for name, value in wanted.items()])
    return pool.isel(realization=np.flatnonzero(chosen))


def ensembles(pool, *names):
    """{value of a coordinate, or values of several: ensemble of its realizations}, in the order of the pool.

    The ensembles have averages over their realizations (ensembles.averages). Their case and diameter are
    numbers where all realizations agree, else coordinates of the realizations.
    Raises ValueError unless all realizations of an ensemble have one Hurst exponent.
    """
    found = {}
    for values in dict.fromkeys(zip(*(pool[name].values.tolist() for name in names), strict=True)):
        key = values if len(names) > 1 else values[0]
        found[key] = _ensemble(select(pool, **dict(zip(names, values, strict=True))), key)
    return found


def _ensemble(part, about):
    coords = {}
    for name in ("hurst", "elements", "case", "diameter", "until_x"):
        values = part[name].values
        same = np.unique(values).size == 1  # nan, of measured surfaces, is equal to nan
        if not same and name == "hurst":
            raise ValueError(f"{about}: the realizations differ in {name}, it must be the same in all")
        coords[name] = values[0] if same else ("realization", values)
    arrays = (part[name].values for name in ("x", *VARIABLES))
    return ensemble_dataset(part["rms_convention"].values.tolist(), *arrays, coords)


def elements_across(elements):
    """Elements across the disc that has so many elements.

    With n across, the disc holds those whose centres lie within (n − 1)/2 of its centre, about π (n − 1)²/4 of them.
    """
    return round(1 + np.sqrt(4 * elements / np.pi))
