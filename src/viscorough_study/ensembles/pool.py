"""Collect the loading curves of all realizations in one dataset, the pool, and select ensembles from the pool.

All curves are interpolated to common abscissae X. The pool has the dimensions rms_convention, realization and abscissa.
Hurst exponent, group, ensemble and number of elements are coordinates of the dimension realization.
The pool contains no lengths, since the curves are dimensionless, and no averages, since averages depend on the selected
realizations.
"""

import json

import numpy as np
import xarray as xr

from viscorough_study.ensembles.averages import DIMENSIONS, ROUNDING, on_abscissae, with_averages
from viscorough_study.ensembles.curve_files import distinct

VARIABLES = {
    "stiffness": "dimensionless stiffness κ = k/(4GL)",
    "contact_count": "elements in contact",
}
REALIZATION_COORDINATES = {
    "hurst": ("Hurst exponent", "1"),
    "group": ("group of ensembles", ""),
    "ensemble": ("name of the ensemble", ""),
    "elements": ("elements of the indenter", "1"),
    "until_x": ("X that the curve was to reach", "1"),
}


def aggregate_curves(batches, conventions, x):
    """Join batches of loading curves into a pool, with the realizations sorted by ensemble and number.

    The pool does not depend on how the realizations are divided into batches.

    batches : iterable of (name of a group of ensembles, result of ensembles.curve_files.read_curves); only one batch at
        a time is in memory
    conventions : definitions of the rms height h in the pool, keys of ensembles.realization.RMS
    x : abscissae X, shape (abscissae,)
    """
    stiffness, count, labels, numbers, settings = [], [], [], [], []
    for group, (members, described) in batches:
        realizations, curves = zip(*members, strict=True)
        rms = {name: [realization.rms[name] for realization in realizations] for name in conventions}
        on_x = on_abscissae(curves, rms, [realization.diameter for realization in realizations], x)
        # Drop the part of a curve beyond its intended end. Only some surfaces have such a part, so a mean over these
        # parts would be biased.
        beyond = np.array([realization.until_x for realization in realizations])[:, None] * (1 + ROUNDING) < x
        for parts, part in zip((stiffness, count), on_x, strict=True):
            parts.append(np.where(beyond, np.nan, part))
        for realization, curve in members:
            labels.append((realization.hurst, group, realization.ensemble, curve.elements, realization.until_x))
            numbers.append(realization.number)
        settings += described
    pool = xr.Dataset(coords={"x": ("abscissa", x), "rms_convention": list(conventions)})
    for (name, text), parts in zip(VARIABLES.items(), (stiffness, count), strict=True):
        pool[name] = (DIMENSIONS, np.concatenate(parts, axis=1), {"long_name": text, "units": "1"})
        parts.clear()
    for (name, (text, units)), values in zip(REALIZATION_COORDINATES.items(), zip(*labels, strict=True), strict=True):
        attributes = {"long_name": text} | ({"units": units} if units else {})
        pool = pool.assign_coords({name: ("realization", np.array(values), attributes)})
    pool["x"].attrs = {"long_name": "dimensionless force F/(4GhL) or time Ft/(4ηhL)", "units": "1"}
    pool["rms_convention"].attrs = {"long_name": "where the rms height h is measured"}
    pool = pool.assign_attrs(title="Loading curves on common abscissae", settings=json.dumps(distinct(settings)))
    ranks = {key: rank for rank, key in enumerate(dict.fromkeys(label[1:3] for label in labels))}
    return pool.isel(realization=np.lexsort((numbers, [ranks[label[1:3]] for label in labels])))


def select(pool, **coordinates):
    """Return the realizations of a pool whose coordinates have the given values, such as group="base"."""
    chosen = np.logical_and.reduce([pool[name].values == value for name, value in coordinates.items()])
    return pool.isel(realization=np.flatnonzero(chosen))


def ensembles(pool, *names, rms_convention=None):
    """Split a pool into ensembles; return {value of a coordinate: ensemble of the realizations with this value}.

    names : names of coordinates; for several names, the keys of the result are tuples of their values
    rms_convention : keep only the curves with this definition of the rms height h, and drop the dimension
        rms_convention. By default all definitions of the pool are kept.

    The ensembles are in the order of the pool, and contain averages over their realizations (ensembles.averages). The
    coordinates hurst, elements, ensemble and until_x become scalars if they are equal for all realizations.
    """
    result, pool = {}, pool if rms_convention is None else pool.sel(rms_convention=rms_convention)
    for values in dict.fromkeys(zip(*(pool[name].values.tolist() for name in names), strict=True)):
        ensemble = with_averages(select(pool, **dict(zip(names, values, strict=True))))
        for name in ("hurst", "elements", "ensemble", "until_x"):
            # measured surfaces have hurst = nan; np.unique counts all nan as one value
            same = np.unique(ensemble[name].values)
            ensemble = ensemble.assign_coords({name: same[0]}) if same.size == 1 else ensemble
        result[values if len(names) > 1 else values[0]] = ensemble
    return result


def by_hurst(pool, group):
    """Return the ensembles of a group as a list, one for each Hurst exponent."""
    return list(ensembles(select(pool, group=group), "hurst").values())


def elements_across(elements):
    """Return the number of elements across a disc that has `elements` elements in all.

    A disc with n elements across consists of the elements whose centres lie within (n − 1)/2 of its centre, in units of
    the spacing. These are about π (n − 1)²/4 elements.
    """
    return round(1 + np.sqrt(4 * elements / np.pi))
