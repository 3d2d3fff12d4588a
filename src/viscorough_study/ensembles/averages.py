"""Put realizations of one surface on common abscissae, and take their averages and spread.

The abscissa is X = F/(4GhL), which for the viscous problem is Ft/(4ηhL) (paper, Eqs. 2 and 3). If all realizations have
the same F, η, L and nominal h, fixed X means fixed time, and vt/h is the velocity times a constant: averages at fixed X
and at fixed t are then the same. They differ if h is measured on each realization, because X and vt/h are then in units
of this realization's h. An ensemble contains several such rms conventions.
"""

import warnings

import numpy as np
import xarray as xr

DIMENSIONS = ("rms_convention", "realization", "abscissa")
ROUNDING = 1e-9  # relative difference below which abscissae and ends of ranges count as equal


def abscissa(low, high, per_decade):
    """Return the multiples of 1/per_decade decades in [low, high], a logarithmic grid of X, shape (abscissae,) [1].

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
    """Return κ and the elements in contact on common abscissae, each (rms conventions, realizations, abscissae).

    curves : list of LoadingCurve
    rms : {convention: rms heights h, shape (realizations,) or a number for all} [length]
    diameter : L, shape (realizations,) or a number for all [length]; x : X, shape (abscissae,) [1], strictly increasing

    κ = k/(4GL) at F/G = 4hLX (Eq. 3); nan beyond the last level of a curve. Between levels ln(count) is linear in
    ln F, and below the first level the count is constant.
    """
    diameters = np.broadcast_to(diameter, len(curves))
    heights = np.array([np.broadcast_to(values, len(curves)) for values in rms.values()])
    stiffness = np.empty((*heights.shape, len(x)))
    count = np.empty_like(stiffness)
    for i, (curve, length) in enumerate(zip(curves, diameters, strict=True)):
        force = 4 * length * heights[:, i, None] * np.asarray(x)
        stiffness[:, i] = curve.at_force(force)[1] / (4 * length)
        count[:, i] = np.exp(np.interp(np.log(force), np.log(curve.force), np.log(curve.contact_count)))
    count[np.isnan(stiffness)] = np.nan
    return stiffness, count


def with_averages(curves):
    """Return the ensemble dataset: curves with vt/h = X/κ (velocity), and averages over the realizations.

    Averages are means and medians, by their names; velocity_spread, the standard deviation of ln(vt/h);
    realizations_defined, the number of curves that reach an abscissa; and fraction_defined, this number over the number
    of curves intended to reach it.

    curves : dataset with κ (stiffness) and elements in contact (contact_count), nan where undefined, with the
        dimensions `DIMENSIONS` (a single rms convention has no dimension); its coordinates are x, X, and until_x, the X
        at the end of the computed curves
    """
    velocity = curves["x"] / curves["stiffness"]
    defined, expected = velocity.notnull(), curves["until_x"] * (1 + ROUNDING) >= curves["x"]
    with warnings.catch_warnings(action="ignore", category=RuntimeWarning):  # few realizations may be defined
        geometric = np.exp(np.log(velocity).mean("realization"))
        averaged = curves.assign(
            velocity=velocity,
            velocity_arithmetic=velocity.mean("realization"),
            velocity_geometric=geometric,
            velocity_spread=np.log(velocity).std("realization", ddof=1),
            stiffness_geometric=curves["x"] / geometric,
            contact_count_median=curves["contact_count"].median("realization"),
            realizations_defined=defined.sum("realization"),
            fraction_defined=xr.where(expected, defined, np.nan).mean("realization").fillna(0.0),
        )
    return averaged.transpose(*DIMENSIONS, missing_dims="ignore")
