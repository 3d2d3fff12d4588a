"""Lines compared with discs of one Hurst exponent: λ over X, residual errors of a single λ, exponents in equal windows.

Both are means over ensembles. The "single λ" minimizes the largest error of vt/h over region (b) of the discs, so no
other λ(H) does better there. The largest error and the range of λ(X) grow with the scatter of the surfaces; the claims
are therefore judged by straight lines through ln λ and ln(vt/h) over ln X, whose ends have either sign and whose
intervals are free of this bias.
"""

import numpy as np
import pandas as pd

from viscorough_study.ensembles.pool import ensembles, select
from viscorough_study.fits.intervals import described, described_ends, percentile_interval, three_columns
from viscorough_study.fits.mdr_lambda import match_lines
from viscorough_study.fits.power_law import find_region, fit_power_law, in_window, named_windows

FRACTION_KEPT = 1 - 1e-9  # fraction of realizations that must be defined at an X of the whole curve

LAMBDA_COLUMNS = {
    "hurst": ("Hurst exponent H", "1"),
    "x": ("dimensionless force F/(4GhL) or time Ft/(4ηhL)", "1"),
    "in_region": ("1 in region (b) of the discs, else 0", "1"),
    **described("lambda", "λ of the line that has the velocity of the discs at this X (Eq. 13)"),
    **described("velocity_ratio", "vt/h of the lines with the best single λ over that of the discs"),
}
SUMMARY_COLUMNS = {
    "hurst": ("Hurst exponent H", "1"),
    **described_ends("x", "of region (b) of the discs in X"),
    **described("drift", "λ at the upper over λ at the lower end of region (b), by a power law through λ(X)"),
    **described("lambda_best", "λ that minimizes the largest error of vt/h over region (b)"),
    "error_region": ("largest error of ln(vt/h) over region (b) with this λ", "1"),
    **described("error_trend", "error of ln(vt/h) at the upper end of region (b) with this λ, by a power law"),
    **described("error_whole", "largest error of ln(vt/h) from the start of region (b) to the end of the curve"),
    "discs": ("number of discs", "1"),
    "lines": ("number of lines", "1"),
}
WINDOWS = ("own region", "same X", "same κ")
EXPONENT_COLUMNS = {
    "hurst": ("Hurst exponent H", "1"),
    "window": (
        "own region: region (b) of each; same X: that of the discs; same κ: scaling.stiffness_range",
        None,
    ),
    "x_low_discs": ("lower end of the window of the discs in X", "1"),
    "x_high_discs": ("upper end of the window of the discs in X", "1"),
    "x_low_lines": ("lower end of the window of the lines in X", "1"),
    "x_high_lines": ("upper end of the window of the lines in X", "1"),
    **described("beta_discs", "exponent β of the discs"),
    **described("beta_lines", "exponent β of the lines"),
    **described("difference", "β of the lines minus β of the discs"),
}
TABLES = {"mdr_lambda": LAMBDA_COLUMNS, "mdr_summary": SUMMARY_COLUMNS, "mdr_exponents": EXPONENT_COLUMNS}


def mdr_tables(discs, lines, *, seed, fit, conventions):
    """Tables of `compare_ensembles`, of pools of base discs and lines.

    fit : settings of region (b); conventions : average, and rms convention of the discs
    """
    lines = lines.isel(realization=np.flatnonzero(np.isin(lines["hurst"], discs["hurst"])))
    discs = ensembles(select(discs, group="base"), "hurst", rms_convention=conventions["rms_convention"])
    lines = ensembles(lines, "hurst", rms_convention="line")
    return compare_ensembles(discs, lines, average=conventions["average"], seed=seed, **fit)


def compare_ensembles(discs, lines, *, average, stiffness_range, resamples, seed, **limits):
    """The three tables of discs and lines, {name in `TABLES`: table with its columns}.

    discs, lines : {H: ensemble (ensembles.averages) in one rms convention}, of equal abscissae; Hurst exponents that
        both have are compared
    average, resamples, seed : of the bootstrap, as in viscorough_study.fits.power_law.fit_power_law
    stiffness_range, limits : arguments of viscorough_study.fits.power_law.named_windows
    Without a region (b) there are no rows of λ, and the values of the other tables are nan.
    """
    bootstrap, rows = {"average": average, "resamples": resamples, "seed": seed}, {name: [] for name in TABLES}
    for hurst in sorted(set(discs) & set(lines)):
        pair = discs[hurst], lines[hurst]
        lambdas, summary = _lambda_rows(*pair, limits, **bootstrap)
        made = lambdas, [summary], _exponent_rows(*pair, stiffness_range, limits, **bootstrap)
        for name, members in zip(TABLES, made, strict=True):
            rows[name] += [{"hurst": hurst} | row for row in members]
    return {name: pd.DataFrame(rows[name], columns=list(columns)) for name, columns in TABLES.items()}


def _lambda_rows(discs, lines, limits, **bootstrap):
    """Rows of λ over X and the row of the summary, of one Hurst exponent."""
    x = discs["x"].values
    number = {"discs": discs.sizes["realization"], "lines": lines.sizes["realization"]}
    window = find_region(discs, **limits)
    if window is None:
        return [], number
    match = match_lines(x, discs["velocity"].values, lines["velocity"].values, **bootstrap)
    best = match.best_stretch(window)
    chosen = (x >= window[0] / 10) & (discs["fraction_defined"].values >= FRACTION_KEPT)
    ratio = np.exp(match.deviation(best, chosen))
    chosen[chosen] = np.isfinite(ratio[0])
    return _abscissa_rows(match, best, window, chosen), number | _summary(match, best, window, chosen)


def _abscissa_rows(match, best, window, chosen):
    """Rows of the chosen abscissae."""
    x = match.x[chosen]
    lambdas, ratio = match.lambda_at(x), np.exp(match.deviation(best, chosen))
    rows = []
    for i, abscissa in enumerate(x):
        row = {"x": abscissa, "in_region": int(in_window(abscissa, window))}
        row |= three_columns("lambda", match.with_interval(lambdas[:, i]))
        rows.append(row | three_columns("velocity_ratio", match.with_interval(ratio[:, i])))
    return rows


def _summary(match, best, window, chosen):
    """Columns of the summary."""
    region, whole = in_window(match.x, window), chosen & (match.x >= window[0])
    stretch = match.stretch_at(match.x[region])
    error, whole_error = (match.deviation(best, part) for part in (region, whole))
    return {
        "x_low": window[0],
        "x_high": window[1],
        **three_columns("drift", match.with_interval(np.exp(2 * _rise(match.x[region], stretch)))),
        **three_columns("lambda_best", match.with_interval(np.pi * np.exp(2 * best))),
        "error_region": np.abs(error[0]).max(),
        **three_columns("error_trend", match.with_interval(_rise(match.x[region], error) / 2)),
        **three_columns("error_whole", match.with_interval(np.abs(whole_error).max(axis=1))),
    }


def _rise(x, values):
    """Rise of the least-squares line in ln X from the first to the last X; values : shape (samples, X)."""
    offset = np.log(x) - np.log(x).mean()
    return values @ offset / (offset @ offset) * np.ptp(offset)


def _exponent_rows(discs, lines, stiffness_range, limits, *, seed, **bootstrap):
    """Rows of the exponents of one Hurst exponent; those without a window have nan."""
    windows = [named_windows(ensemble, stiffness_range=stiffness_range, **limits) for ensemble in (discs, lines)]
    regions, kappa = ([rules[rule] for rules in windows] for rule in ("default", "kappa"))
    pairs = dict(zip(WINDOWS, (regions, [regions[0], regions[0]], kappa), strict=True))
    return [{"window": name} | _fits(discs, lines, pair, seed, bootstrap) for name, pair in pairs.items()]


def _fits(discs, lines, windows, seed, bootstrap):
    """Columns of the fits of discs and lines in their windows; {} if one of them has none."""
    if None in windows:
        return {}
    fits, columns = [], {}
    # Separate seeds make the bootstrap samples of discs and lines independent.
    names = zip(("discs", "lines"), (discs, lines), windows, np.random.SeedSequence(seed).spawn(2), strict=True)
    for name, ensemble, window, sample_seed in names:
        fit = fit_power_law(ensemble["x"].values, ensemble["velocity"].values, window, **bootstrap, seed=sample_seed)
        columns |= {f"x_low_{name}": window[0], f"x_high_{name}": window[1]}
        columns |= three_columns(f"beta_{name}", (fit.beta, *fit.beta_interval))
        fits.append(fit)
    samples, number = fits[1].beta_samples - fits[0].beta_samples, min(fit.realizations for fit in fits)
    value = fits[1].beta - fits[0].beta
    return columns | three_columns("difference", (value, *percentile_interval(samples, number)))
