"""Ensembles: realizations of one surface on common abscissae, their averages and their spread.

The abscissa is X = F/(4GhL), which for the viscous problem is Ft/(4ηhL) (paper, Eqs. 2 and 3). If all realizations have
the same F, η, L and nominal h, fixed X means fixed time, and vt/h is the velocity times a constant: averages at fixed X
and at fixed t are then the same. They differ if h is measured on each realization, since X and vt/h are then in units
of the h of that realization. An ensemble contains several such rms conventions.
"""

import warnings

import numpy as np
import xarray as xr

ROUNDING = 1e-9  # relative difference below which abscissae and ends of ranges count as equal


def abscissa(low, high, per_decade):
    """Logarithmic grid of X: the multiples of 1/per_decade decades in [low, high], shape (abscissae,) [1].

    Grids of the same per_decade share their points, independent of their ends. Raises ValueError for an empty grid.
    """
    if not (0 < low <= high < np.inf):
        raise ValueError(f"abscissa: low and high must be 0 < low <= high < inf, not {low} and {high}")
    first = np.ceil(per_decade * np.log10(low) - ROUNDING)
    last = np.floor(per_decade * np.log10(high) + ROUNDING)
    if last < first:
        raise ValueError(f"abscissa: no multiple of 1/{per_decade} decade lies between {low} and {high}")
    return 10.0 ** (np.arange(first, last + 1) / per_decade)


def on_abscissae(curves, rms, diameter, x):
    """κ and the elements in contact on common abscissae, each of shape (rms conventions, realizations, abscissae).

    curves : list of LoadingCurve
    rms : {convention: rms heights h, shape (realizations,) or a number for all} [length]
    diameter : L, shape (realizations,) or a number for all [length]; x : X, shape (abscissae,) [1], strictly increasing

    κ = k/(4GL) at F/G = 4hLX (Eq. 3); nan beyond the last level of a curve. Between levels ln(count) is linear in
    ln F, and below the first level the count is that of the first level.
    Raises ValueError for rms heights out of range.
    """
    diameters = np.broadcast_to(diameter, len(curves))
    heights = np.empty((len(rms), len(curves)))
    for row, (name, values) in zip(heights, rms.items(), strict=True):
        if np.shape(values) not in ((), row.shape) or not np.all(np.isfinite(values) & (np.asarray(values) > 0)):
            raise ValueError(f"on_abscissae: rms[{name!r}] must be {len(curves)} positive numbers, or one for all")
        row[:] = values

    stiffness = np.empty((*heights.shape, len(x)))
    count = np.empty_like(stiffness)
    for i, (curve, length) in enumerate(zip(curves, diameters, strict=True)):
        force = 4 * length * heights[:, i, None] * np.asarray(x)
        stiffness[:, i] = curve.at_force(force)[1] / (4 * length)
        count[:, i] = np.exp(np.interp(np.log(force), np.log(curve.force), np.log(curve.contact_count)))
    count[np.isnan(stiffness)] = np.nan
    return stiffness, count


def ensemble_dataset(conventions, x, stiffness, count, coords):
    """Ensemble dataset: vt/h = X/κ (velocity), κ (stiffness), elements in contact, and averages over the realizations.

    Averages are means and medians, by their names; velocity_spread, the standard deviation of ln(vt/h);
    realizations_defined, the number of curves that reach an abscissa; and fraction_defined, this number over that of
    the curves intended to reach it.

    conventions : names of the rms conventions; x : X, shape (abscissae,)
    stiffness, count : κ and elements in contact, shape (conventions, realizations, abscissae), nan where undefined
    coords : hurst, case, diameter, elements, and until_x, the X up to which curves were computed, if it is limited
    """
    coords = {"until_x": np.inf} | coords
    velocity, until_x = x / stiffness, coords["until_x"]
    until_x = until_x[1] if isinstance(until_x, tuple) else until_x  # of every realization
    dimensions = ("rms_convention", "realization", "abscissa")
    variables = {"velocity": velocity, "stiffness": stiffness, "contact_count": count}
    variables = {name: (dimensions, values) for name, values in variables.items()}
    variables |= {
        name: (("rms_convention", "abscissa"), values)
        for name, values in _averages(x, velocity, count, until_x).items()
    }
    return xr.Dataset(variables, {"x": ("abscissa", x), "rms_convention": conventions, **coords})


def _averages(x, velocity, count, until_x):
    """Averages over the defined realizations, each of shape (rms conventions, abscissae)."""
    defined = np.isfinite(velocity)
    number = defined.sum(axis=1)
    expected = np.broadcast_to(np.reshape(until_x, (-1, 1)) * (1 + ROUNDING) >= x, velocity.shape[1:]).sum(axis=0)

    def mean(values):
        return np.where(defined, values, 0).sum(axis=1) / number

    log_velocity = np.log(velocity)
    with warnings.catch_warnings(), np.errstate(invalid="ignore", divide="ignore"):
        warnings.simplefilter("ignore", RuntimeWarning)  # of nanmedian where no realization is defined
        geometric = mean(log_velocity)
        squares = mean((log_velocity - geometric[:, None]) ** 2) * number
        return {
            "velocity_arithmetic": mean(velocity),
            "velocity_geometric": np.exp(geometric),
            "velocity_spread": np.sqrt(squares / (number - 1)),
            "stiffness_geometric": x / np.exp(geometric),
            "contact_count_median": np.nanmedian(count, axis=1),
            "realizations_defined": number,
            "fraction_defined": np.where(expected > 0, number / np.maximum(expected, 1), 0.0),
        }
