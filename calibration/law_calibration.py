"""Calibrate the penetration law by loading curves of discs up to complete contact.

The law of g, the interface's part of vt/h (viscorough.law.calibrated_law), has five constants for each Hurst exponent
and grid. Two conditions are exact: its integrals over ln X and over X equal the means over the discs, which follow from
linear solutions (contact.complete_contact). The remaining freedom is used to fit the mean of g. Other discs measure
the deviation of the law from g, and the range of its validity. Means over discs are arithmetic.

Some properties of a disc are known exactly, without its curve: both integrals, and the distribution of its heights.
They serve as control variates: by linear regression, the curves of the other discs are adjusted to the mean properties
of the discs of the fit. This removes a good part of the chance difference between the two samples. The table also has
the deviation without this adjustment.
"""

import numpy as np
from scipy.integrate import simpson
from scipy.optimize import least_squares

from viscorough.contact.complete_contact import complete_contact
from viscorough.contact.loading_path import indent
from viscorough.law.calibrated_law import CONSTANTS, LARGEST_DEVIATION, interface_depth, interface_velocity
from viscorough.surfaces.self_affine import self_affine_disc
from viscorough_study.ensembles.averages import abscissa
from viscorough_study.fits.interface import run_around
from viscorough_study.fits.intervals import described, mean_with_interval, resampled_means, three_columns, with_interval

X = abscissa(1e-6, 1e3, 10)
TOLERANCE = 1e-5  # tolerance of the curves: at X = 30 few elements are left, and g is small
# The law is fitted from this X on, up to the X at which the relative standard error of the mean of g exceeds the second
# number. Deviations count in units of the standard error, or of the third number if that is larger.
FIT_LOW, LARGEST_ERROR, LEAST_ERROR = 10**-2.7, 0.1, 0.02
# Quantiles of the heights among the control variates.
_QUANTILES = (0.5, 0.9, 0.99, 1.0)
# Weight of the two integrals in the fit, so large that they are exact to 1e-6; abscissae of their quadrature in ln X.
_EXACT, _LOG_X = 1e5, np.linspace(np.log(1e-9), np.log(3e3), 1501)
_START = (0.6, 0.3, 3.0, 1.0, 40.0)

COLUMNS = {
    "hurst": ("Hurst exponent H", "1"),
    "across": ("elements across the discs", "1"),
    "discs": ("discs to which the law is fitted", "1"),
    "unused": ("other discs, on which it is tested", "1"),
    **{key: value for name, text in CONSTANTS.items() for key, value in described(name, text).items()},
    **described("mean_gap", "∫ g dX/X of the law: the mean over its discs"),
    **described("energy", "∫ g dX of the law: the mean over its discs"),
    "x_low": ("lower end of the range of X in which the law of g is within 5 % of the mean over other discs", "1"),
    "x_high": ("upper end of this range", "1"),
    "deviation": ("largest relative deviation of g there", "1"),
    "unadjusted": ("the same without control variates", "1"),
    "standard_error": ("largest relative standard error of the mean of g over other discs there", "1"),
    "velocity_error": ("largest relative distance of vt/h there from an end of the 95 % interval of its mean", "1"),
    "depth_error": ("largest relative distance of u/h there from an end of the 95 % interval of its mean", "1"),
    "geometric_velocity": ("largest relative distance of the geometric mean of vt/h there, below the arithmetic", "1"),
    "geometric_depth": ("the same of u/h", "1"),
}


def complete_curve(hurst, across, seed, x=X):
    """Return g and the interface's part of u/h of a disc at x, shape (2, abscissae), and its control variates.

    hurst, across, seed : arguments of self_affine_disc

    The control variates are both exact integrals, and quantiles, skewness and kurtosis of the heights.
    """
    disc = self_affine_disc(hurst, across, seed=seed)
    heights, diameter, end = disc.heights[~np.isnan(disc.heights)], across * disc.spacing, complete_contact(disc)
    rms = heights.std()
    scaled = (heights - heights.mean()) / rms
    force = 4 * rms * diameter * x
    before = force[force < end.force]
    depth, stiffness = indent(disc, tolerance=TOLERANCE, forces=before).at_force(before)
    parts = np.zeros((2, x.size))
    parts[:, : before.size] = before * (1 / stiffness - 1 / end.stiffness), depth - before / end.stiffness
    parts[1, before.size :] = end.mean_gap
    integrals = end.mean_gap / rms, end.energy / (4 * rms**2 * diameter)
    return parts / rms, [*integrals, *np.quantile(scaled, _QUANTILES), np.mean(scaled**3), np.mean(scaled**4)]


def fit_constants(interface, integrals, error, across):
    """Fit the constants of the law, in the order of `CONSTANTS`.

    interface : mean of g at `X`; integrals : mean of each integral; error : relative standard error of `interface`
    """
    fitted = (X >= FIT_LOW * (1 - 1e-9)) & (error <= LARGEST_ERROR)
    weight = 1 / np.maximum(error[fitted], LEAST_ERROR)

    def residuals(logarithms):
        constants = np.exp(logarithms)
        with np.errstate(divide="ignore"):
            ratio = interface_velocity(X[fitted], *constants, across=across) / interface[fitted]
            exact = np.divide(law_integrals(constants, across), integrals)
            return np.nan_to_num(np.append(weight * np.log(ratio), _EXACT * np.log(exact)), neginf=-_EXACT)

    return np.exp(least_squares(residuals, np.log(_START), x_scale="jac").x)


def law_integrals(constants, across):
    """Return ∫ g dX/X and ∫ g dX of the law."""
    law = interface_velocity(np.exp(_LOG_X), *constants, across=across)
    return [simpson(values, _LOG_X) for values in (law, law * np.exp(_LOG_X))]


def calibrate(fitted, unused, across, *, resamples, seed):
    """Return the columns of `COLUMNS` from "discs" on.

    fitted, unused : (parts of shape (discs, 2, abscissae), controls of shape (discs, variates)) of `complete_curve`
    """
    parts, controls = fitted
    integrals = controls[:, :2]
    error = relative_error(adjusted(parts[:, 0], controls, controls.mean(axis=0)))
    means = resampled_means(np.hstack([parts[:, 0], integrals]), resamples, np.random.default_rng(seed))
    constants = np.array([fit_constants(mean[:-2], mean[-2:], error, across) for mean in means])
    row = {"discs": len(parts), "unused": len(unused[0])}
    for name, samples in zip(CONSTANTS, constants.T, strict=True):
        row |= three_columns(name, with_interval(samples, len(parts)))
    for name, values in zip(("mean_gap", "energy"), integrals.T, strict=True):
        row |= three_columns(name, mean_with_interval(values))
    return row | tested(constants[0], *unused, controls.mean(axis=0), across)


def relative_error(values):
    """Return the relative standard error of the mean, inf if the mean is 0; values : shape (discs, abscissae)"""
    mean = values.mean(axis=0)
    return np.where(mean > 0, values.std(axis=0, ddof=1) / np.sqrt(len(values)) / np.where(mean > 0, mean, 1), np.inf)


def adjusted(values, controls, targets):
    """Return the values adjusted by linear regression from their controls to target controls; first axis : discs"""
    centred = controls - controls.mean(axis=0)
    slopes = np.linalg.lstsq(centred, values.reshape(len(values), -1), rcond=None)[0]
    return values - ((controls - targets) @ slopes).reshape(values.shape)


def tested(constants, parts, controls, targets, across):
    """Return the range of the law and its deviations, by discs not used for the fit: columns from "x_low" on.

    targets : mean controls of the discs of the fit
    """
    law = interface_velocity(X, *constants, across=across), interface_depth(X, *constants, across=across)
    means = adjusted(parts, controls, targets).mean(axis=0)[0], parts.mean(axis=0)[0]
    deviation, unadjusted = (
        np.abs(np.divide(law[0], mean, out=np.full(X.size, np.inf), where=mean > 0) - 1) for mean in means
    )
    within = (deviation <= LARGEST_DEVIATION) & (X >= FIT_LOW * (1 - 1e-9))
    holds = run_around(within, int(np.argmin(np.abs(np.log(X)))))
    x, kept = X[holds], parts[:, :, holds]
    values = adjusted(kept, controls, targets)
    row = {"x_low": x[0], "x_high": x[-1], "deviation": deviation[holds].max(), "unadjusted": unadjusted[holds].max()}
    row["standard_error"] = relative_error(values[:, 0]).max()
    for i, name in enumerate(("velocity", "depth")):
        _, *ends = mean_with_interval(x + values[:, i])
        row[f"{name}_error"] = max(np.abs((x + law[i][holds]) / end - 1).max() for end in ends)
        whole = x + kept[:, i]
        row[f"geometric_{name}"] = (1 - np.exp(np.log(whole).mean(axis=0)) / whole.mean(axis=0)).max()
    return row
