"""The table of plateaus: how long vt/h is a power law of X on discs and on a control, and what the test can tell.

The control has a spectrum without long waves, hence no power law. The test is as good as it fails curves like that and
passes power laws, both with the scatter of the real realizations: shares of synthetic ensembles say how often it does.
"""

import numpy as np

from viscorough_study.plateau import plateau, shares

COLUMNS = {
    "case_group": ("base or name of the control, which has no power law", None),
    "hurst": ("Hurst exponent H", "1"),
    "realizations": ("realizations in the ensemble", "1"),
    "decades": ("decades of X over which the local slope is constant within the tolerance", "1"),
    "decades_low": ("lower end of the 95 % interval of the decades", "1"),
    "decades_high": ("upper end of the 95 % interval of the decades", "1"),
    "slope": ("mean local slope of ln(vt/h) over these decades", "1"),
    "slope_low": ("lower end of its 95 % interval", "1"),
    "slope_high": ("upper end of its 95 % interval", "1"),
    "x_low": ("lower end of these decades in X", "1"),
    "x_high": ("upper end of these decades in X", "1"),
    "draws": ("synthetic ensembles of each kind", "1"),
    "power_law_passes": ("share of synthetic power laws with the scatter of this ensemble that pass the test", "1"),
    "power_law_fails": ("share of them that fail it", "1"),
    "bent_passes": (
        "the same of power laws whose slope changes by twice the range allowed over the decades needed",
        "1",
    ),
    "control_passes": ("the same of ensembles with the mean curve of the control", "1"),
}
RESAMPLES_OF_DRAWS = 100  # bootstrap samples of each synthetic ensemble


def plateau_row(ensemble, control, *, x_range, half_width, tolerance, decades_min, resamples, draws, random):
    """Row of one ensemble, with the keys of `COLUMNS` but for case_group.

    ensemble : ensemble dataset (viscorough_study.ensembles) of one rms convention
    control : that of the control of the same Hurst exponent, None without one
    x_range : X between which the plateau may lie; half_width : of local slopes, in decades, also used beyond x_range
    tolerance : of the local slope; decades_min : length with which an ensemble passes; random : numpy.random.Generator
    Where a realization does not reach all of the abscissae, the results are nan.
    """
    chosen = _near(ensemble["x"].values, x_range, half_width)
    log_x, log_y = np.log(ensemble["x"].values[chosen]), _log_velocity(ensemble, chosen)
    row = {"hurst": ensemble["hurst"].item(), "realizations": len(log_y), "draws": draws}
    if not np.isfinite(log_y).all():
        return dict.fromkeys((name for name in COLUMNS if name != "case_group"), np.nan) | row
    how = {"half_width": half_width * np.log(10), "tolerance": tolerance, "random": random}
    row |= plateau(log_x, log_y, resamples=resamples, **how)
    residuals = log_y - log_y.mean(axis=0)
    bend = 4 * tolerance / (decades_min * np.log(10))  # slope per unit of ln X
    means = {"power_law": 0 * log_x, "bent": bend * (log_x - log_x.mean()) ** 2 / 2}  # a common slope changes nothing
    if control is not None:
        means["control"] = _log_velocity(control, chosen).mean(axis=0)
    of_draws = {"draws": draws, "decades_min": decades_min, "resamples": RESAMPLES_OF_DRAWS}
    found = {name: shares(log_x, mean, residuals, **of_draws, **how) for name, mean in means.items()}
    row |= {f"{name}_passes": found.get(name, (np.nan,))[0] for name in ("power_law", "bent", "control")}
    return row | {"power_law_fails": found["power_law"][1]}


def _near(x, x_range, half_width):
    """Abscissae in the range, and those beside it that local slopes need."""
    margin = 10 ** (half_width * (1 + 1e-9))
    return (x >= x_range[0] / margin) & (x <= x_range[1] * margin)


def _log_velocity(ensemble, chosen):
    return np.log(ensemble["velocity"].values[:, chosen])
