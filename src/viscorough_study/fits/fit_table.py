"""Fit the power law vt/h = X^β/ζ to the mean curve of every ensemble of discs or lines, and make a table of the fits.

A line is a one-dimensional profile for the method of dimensionality reduction. The table also has the factor λ in the
spectrum C1D = λ q C2D of a line (paper, Eq. 13). It is chosen so that lines have the velocity of the discs.

The paper does not state where the rms height h is measured, which mean is taken over the realizations, and in which
range of X (window) the law is fitted. Each row of the table is a fit of one ensemble with one choice of these three
conventions (`FITTED` of fits.conventions). The table has ζ of the law without the factor 1/Γ(2 − α). The functions of
fits.conventions select rows and convert ζ to the law with this factor.
"""

import logging

import numpy as np
import pandas as pd

from viscorough import reference
from viscorough.law.calibrated_law import COLUMNS as CALIBRATION
from viscorough_study.ensembles.pool import ensembles, select
from viscorough_study.fits.conventions import (
    FITTED,
    GAMMA,
    READINGS,
    fits,
    interval_columns,
    reading_of,
    source_values,
    zeta_scale,
)
from viscorough_study.fits.intervals import described, described_ends, three_columns, with_interval
from viscorough_study.fits.mdr_lambda import match_lines
from viscorough_study.fits.power_law import fit_power_law, in_window, log_means, named_windows
from viscorough_study.run.names import SHOWN

# {column: (long_name, units)}, in the order of the table. Columns of text have the units None.
COLUMNS = {
    "source": ("discs (boundary elements) or lines (method of dimensionality reduction)", None),
    "reading": ("reading of the surfaces: A (period L, h of the disc), B (longer period, h of the square)", None),
    "group": ("base, longer_period or name of the variant of the surfaces", None),
    "hurst": ("Hurst exponent H", "1"),
    "rms_convention": ("where the rms height h is measured", None),
    "average": ("mean over the realizations at fixed X", None),
    "window_rule": ("rule of the window of the fit", None),
    **described_ends("x", "of the window in X = F/(4GhL) = Ft/(4ηhL)"),
    "decades": ("decades of X in the window, 0 where there is none", "1"),
    "realizations": ("realizations in the ensemble", "1"),
    **described("beta", "exponent β of vt/h in X (Eqs. 9 and 10)", ends="of the 95 % interval of β"),
    **described("zeta", "prefactor ζ without Γ (Eq. 3)", ends="of the 95 % interval of ζ without Γ"),
    "zeta_low_with_gamma": ("lower end of the 95 % interval of ζ with the factor 1/Γ(1 + β) (Eq. 9)", "1"),
    "zeta_high_with_gamma": ("upper end of the 95 % interval of ζ with the factor", "1"),
    "residual": ("root mean square of ln(vt/h) less the fitted law", "1"),
    **described("zeta_fixed", "prefactor ζ without Γ of the law with β = H/(1 + H)", ends="of its 95 % interval"),
    "residual_fixed": ("root mean square of ln(vt/h) less the law with β = H/(1 + H)", "1"),
    **described("lambda", "λ in C1D = λ q C2D, line matched to surface (Eq. 13)", ends="of the 95 % interval of λ"),
}


def scaling_table(discs, lines, *, seed, **fit):
    """Fit power laws to the mean curve of every ensemble of discs and of lines, and find the factor λ (see the module).

    There is an ensemble of discs for each reading of the surfaces (fits.conventions.READINGS) and each Hurst exponent,
    and one of lines for each Hurst exponent. The fits are to geometric means, in region (b). λ is found for the discs
    of reading A, from the lines with the same Hurst exponent. fits.sensitivities has the fits in all other conventions.

    discs, lines : pools (viscorough_study.ensembles.pool)
    seed, fit : further arguments of `fit_rows`
    Returns a pandas.DataFrame with the columns of `COLUMNS`.
    """
    lines, rows = ensembles(lines, "hurst"), []
    shown = {"averages": (SHOWN["average"],), "rules": (SHOWN["window_rule"],), "seed": seed}
    for reading, columns in READINGS.items():
        group = columns["group"]
        for hurst, ensemble in ensembles(select(discs, group=group), "hurst").items():
            logging.info("discs, reading %s, H = %g", reading, hurst)
            labels = {"source": "discs", "group": group, "lines": lines[hurst] if group == "base" else None}
            rows += fit_rows(ensemble.sel(rms_convention=[columns["rms_convention"]]), **labels, **shown, **fit)
    for hurst, ensemble in lines.items():
        logging.info("lines, H = %g", hurst)
        rows += fit_rows(ensemble, source="lines", group="base", **shown, **fit)
    return pd.DataFrame(rows, columns=list(COLUMNS))


def fit_rows(ensemble, *, source, group, lines=None, averages=FITTED["average"], rules=None, resamples, seed, **limits):
    """Fit one ensemble with every definition of the rms height, kind of mean, and window (range of X) of the fit.

    Return a list of rows of the table, each a dict with the keys of `COLUMNS`. If a window does not exist for the
    ensemble, for example because it has no region (b), the values of the fit in this window are nan.

    ensemble : ensemble dataset (ensembles.averages)
    source, group : entries of the columns of these names
    lines : ensemble dataset of lines with the same Hurst exponent and abscissae, from which λ (see the module) is
        found, or None. λ is nan for `lines` = None, and if the lines do not reach the stiffness that the discs have at
        the centre of the window
    averages, rules : kinds of mean, and names of windows, that are fitted; all if not given
    resamples, seed : number of resamples and seed of the bootstrap
    limits : arguments of viscorough_study.fits.power_law.named_windows, which finds the windows
    Raises ValueError if a window has fewer than three abscissae.
    """
    rows = []
    for rms_convention in ensemble["rms_convention"].values.tolist():
        selected = ensemble.sel(rms_convention=rms_convention)
        ensemble_columns = {"source": source, "group": group, "hurst": ensemble["hurst"].item()}
        ensemble_columns |= {"rms_convention": rms_convention, "realizations": selected.sizes["realization"]}
        ensemble_columns["reading"] = reading_of(group, rms_convention)
        windows = named_windows(selected, **limits)
        for average in averages:
            bootstrap = {"average": average, "resamples": resamples, "seed": seed}
            match = None
            if lines is not None and any(windows.values()):
                velocities = (ensemble["velocity"].values for ensemble in (selected, lines.isel(rms_convention=0)))
                match = match_lines(selected["x"].values, *velocities, **bootstrap)
            for rule, window in windows.items():
                if rules and rule not in rules:
                    continue
                fitted = _fit(selected, match, window, **bootstrap) if window else {}
                row = {"decades": 0.0, **ensemble_columns, "average": average, "window_rule": rule, **fitted}
                rows.append({name: row.get(name, np.nan) for name in COLUMNS})
    return rows


def _fit(ensemble, match, window, **options):
    """Fit β and ζ of an ensemble with a single definition of the rms height in one window; return {column: value}.

    match : LineMatch of the ensemble and of the lines from which λ (see the module) is found, or None
    window : (X_low, X_high)
    options : average, resamples and seed of the fit
    """
    x, velocity = ensemble["x"].values, ensemble["velocity"].values
    betas, zetas = fit_power_law(x, velocity, window, **options)
    columns = {"x_low": window[0], "x_high": window[1], "decades": np.log10(window[1] / window[0])}
    columns |= three_columns("beta", with_interval(betas, len(velocity))) | {"zeta": zetas[0]}
    for gamma in GAMMA:
        _, *ends = with_interval(zeta_scale(betas, gamma) * zetas, len(velocity))
        columns |= dict(zip(interval_columns(gamma), ends, strict=True))
    columns |= _paper_exponent(ensemble, betas, zetas, window, options["average"])
    if match is not None:
        columns |= three_columns("lambda", match.lambda_in(window))
    return columns


def _paper_exponent(ensemble, betas, zetas, window, average):
    """Fit ζ of the law with β = H/(1 + H), and compare both laws with the mean curve; return {column: value}.

    betas, zetas : β and ζ of the fit with a free exponent, for the ensemble and for its resamples. Both fits have the
        same mean of ln(vt/h) over the window, so ζ at another exponent follows from ζ of the free fit
    """
    x, velocity = ensemble["x"].values, ensemble["velocity"].values
    inside, expected = in_window(x, window), reference.exponent_beta(ensemble["hurst"].item())
    log_x = np.log(x[inside])
    (mean,) = log_means(velocity[:, inside], average, 0, np.random.default_rng(0))
    fixed = zetas * np.exp((expected - betas) * log_x.mean())
    laws = {"residual": (betas[0], zetas[0]), "residual_fixed": (expected, fixed[0])}
    residuals = {
        name: np.sqrt(np.mean((mean - beta * log_x + np.log(zeta)) ** 2)) for name, (beta, zeta) in laws.items()
    }
    return residuals | three_columns("zeta_fixed", with_interval(fixed, len(velocity)))


def calibrated(scaling, law, *, conventions, **fit):
    """Select the fits that calibrate the penetration law: a table with the columns of viscorough.law.calibrated_law.

    scaling : table of `scaling_table`
    law : pool (viscorough_study.ensembles.pool) of discs of Hurst exponents that `scaling` lacks
    conventions : {convention: value} of the selected fits, for example {"average": "geometric"}
    fit : further arguments of `fit_rows`
    """
    rows = [fits(scaling, conventions | source_values(source), group="base") for source in ("discs", "lines")]
    for hurst, ensemble in ensembles(law, "hurst").items():
        if hurst not in rows[0]["hurst"].values:
            further = pd.DataFrame(fit_rows(ensemble, source="discs", group="base", **fit))
            rows.append(fits(further, conventions, source="discs"))
    return pd.concat(rows)[list(CALIBRATION)].sort_values(["source", "hurst"], ignore_index=True)
