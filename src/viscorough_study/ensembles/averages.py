"""Interpolate the loading curves of an ensemble to common abscissae, and compute their averages and spread.

The abscissa is X = F/(4GhL), which for the viscous problem is Ft/(4ηhL) (paper, Eqs. 2 and 3). If all realizations have
the same F, η, L and nominal h, then fixed X means fixed time, and vt/h is proportional to the velocity at this time.
Averages at fixed X and at fixed t are then equal. They differ if h is measured on each realization, because X and vt/h
then have different units in each realization. An ensemble contains the curves for several definitions of the rms height
h, which are called rms conventions.
"""

import warnings

import numpy as np
import xarray as xr

DIMENSIONS = ("rms_convention", "realization", "abscissa")
# Abscissae, ends of ranges and numbers of decades count as equal up to this relative difference.
ROUNDING = 1e-9


def abscissa(low, high, per_decade):
    """Return logarithmically spaced values of X from low to high, with per_decade points per decade.

    The decimal logarithms of the points are multiples of 1/per_decade. Results with equal per_decade therefore share
    their points, even if their ends differ. Raises ValueError if there is no such point between low and high.
    Returns an array of shape (abscissae,).
    """
    if not (0 < low <= high < np.inf):
        raise ValueError(f"abscissa: low and high must be 0 < low <= high < inf, not {low} and {high}")
    first = np.ceil(per_decade * np.log10(low) - ROUNDING)
    last = np.floor(per_decade * np.log10(high) + ROUNDING)
    if last < first:
        raise ValueError(f"abscissa: no multiple of 1/{per_decade} decade lies between {low} and {high}")
    return 10.0 ** (np.arange(first, last + 1) / per_decade)


def on_abscissae(curves, rms, diameter, x):
    """Return the stiffness κ and the number of elements in contact of every curve at the same values of X.

    curves : list of LoadingCurve, one for each realization
    rms : {rms convention, that is where h is measured: rms height h [length]}; h has the shape (realizations,), or is
        one number for all
    diameter : diameter L [length], of shape (realizations,), or one number for all
    x : values of X, shape (abscissae,), strictly increasing

    Both results have the shape (rms conventions, realizations, abscissae). κ is k/(4GL) at F/G = 4hLX (Eq. 3). Between
    the points of a loading curve, the logarithm of the number of elements is linear in ln F; below the first point the
    number is constant. Both results are nan beyond the last point of a curve.
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
    """Add the velocity vt/h = X/κ and averages over the realizations to the loading curves of an ensemble.

    The variable of an average has the name of its quantity and of the kind of average, as in velocity_geometric. There
    are three further variables:

    - velocity_spread: standard deviation of ln(vt/h);
    - realizations_defined: number of curves that reach an abscissa;
    - fraction_defined: realizations_defined divided by the number of curves that were intended to reach the abscissa.

    curves : dataset with the variables stiffness (κ) and contact_count (number of elements in contact), which are nan
        at abscissae that a curve does not reach. Its dimensions are `DIMENSIONS`, without rms_convention if there is a
        single convention. Its coordinates are x (the X of the abscissae) and until_x (the X that each curve was
        intended to reach).
    """
    velocity = curves["x"] / curves["stiffness"]
    defined, expected = velocity.notnull(), curves["until_x"] * (1 + ROUNDING) >= curves["x"]
    # numpy warns at abscissae for which too few realizations have a value
    with warnings.catch_warnings(action="ignore", category=RuntimeWarning):
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
