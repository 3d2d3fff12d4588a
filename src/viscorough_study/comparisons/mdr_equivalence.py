"""Compare the mean curves of MDR lines with the mean curves of discs of the same Hurst exponent H.

The factor λ of C1D = λ q C2D (Eq. 13) relates the spectrum of a line of the MDR to the spectrum of the discs. The
comparison has three results: λ as a function of X, the error of vt/h with a constant λ, and the difference of the
exponents β of lines and discs. All curves are means over ensembles. The best single λ of a Hurst exponent minimizes the
largest error of vt/h in region (b) of the discs, so no other λ(H) does better there.

The scatter of the surfaces always enlarges the largest error and the range of λ(X). Claims are therefore judged by
straight lines, which are fitted to ln λ and to the error of ln(vt/h) as functions of ln X. The rise of a straight line
can be positive or negative, so scatter does not bias its interval.
"""

import numpy as np
import pandas as pd

from viscorough_study.ensembles.pool import ensembles, select
from viscorough_study.fits.intervals import described, three_columns, with_interval
from viscorough_study.fits.mdr_lambda import match_lines
from viscorough_study.fits.power_law import fit_power_law, in_window, named_windows
from viscorough_study.run.names import WINDOWS

# Use an X only if at least this fraction of the discs has a value there, which means all discs, within rounding.
FRACTION_KEPT = 1 - 1e-9
REALIZATIONS = ("realizations: the smaller of the numbers of discs and lines", "1")

LAMBDA_COLUMNS = {
    "hurst": ("Hurst exponent H", "1"),
    "x": ("dimensionless force F/(4GhL) or time Ft/(4ηhL)", "1"),
    "in_region": ("1 in region (b) of the discs, else 0", "1"),
    **described("lambda", "λ of the line that has the velocity of the discs at this X (Eq. 13)"),
    **described("velocity_ratio", "vt/h of the lines with the best single λ over that of the discs"),
}
SUMMARY_COLUMNS = {
    "hurst": ("Hurst exponent H", "1"),
    **described("drift", "λ at the upper over λ at the lower end of region (b), by a power law through λ(X)"),
    **described("error_trend", "error of ln(vt/h) at the upper end of region (b) with this λ, by a power law"),
    **described("error_whole", "largest error of ln(vt/h) from the start of region (b) to the end of the curve"),
    "realizations": REALIZATIONS,
}
EXPONENT_COLUMNS = {
    "hurst": ("Hurst exponent H", "1"),
    "window": (
        "own region: region (b) of each; same X: that of the discs; same κ: scaling.stiffness_range",
        None,
    ),
    **described("difference", "β of the lines minus β of the discs"),
    "realizations": REALIZATIONS,
}
TABLES = {"mdr_lambda": LAMBDA_COLUMNS, "mdr_summary": SUMMARY_COLUMNS, "mdr_exponents": EXPONENT_COLUMNS}


def mdr_tables(discs, lines, *, seed, fit, conventions):
    """Compare the base discs, which all figures use, with the MDR lines; return the tables of `compare_ensembles`.

    discs, lines : pools of the loading curves of discs and lines (ensembles.pool)
    fit : number of bootstrap resamples, and settings of region (b)
    conventions : {"average": kind of mean over discs or lines, "rms_convention": where h of the discs is measured}
    """
    lines = lines.isel(realization=np.flatnonzero(np.isin(lines["hurst"], discs["hurst"])))
    discs = ensembles(select(discs, group="base"), "hurst", rms_convention=conventions["rms_convention"])
    lines = ensembles(lines, "hurst", rms_convention="line")
    return compare_ensembles(discs, lines, average=conventions["average"], seed=seed, **fit)


def compare_ensembles(discs, lines, *, resamples, seed, average, **limits):
    """Compare discs with MDR lines; return three tables, {name: table}, with the names and columns in `TABLES`.

    discs, lines : {H: ensemble (ensembles.averages)}, with a single rms height h per surface, and the same abscissae X
        in all ensembles. Only Hurst exponents that discs and lines share are compared
    average, resamples, seed : arguments of the bootstrap, see viscorough_study.fits.power_law.fit_power_law
    limits : arguments of viscorough_study.fits.power_law.named_windows
    If the discs of a Hurst exponent have no region (b), the table of λ has no rows for this exponent, and the values of
    the summary are nan. So is `error_whole` if not all discs reach this region. A difference of exponents is nan if the
    window does not exist for the discs or for the lines.
    """
    bootstrap, rows = {"average": average, "resamples": resamples, "seed": seed}, {name: [] for name in TABLES}
    for hurst in sorted(set(discs) & set(lines)):
        pair = discs[hurst], lines[hurst]
        windows = [named_windows(ensemble, **limits) for ensemble in pair]
        number = min(ensemble.sizes["realization"] for ensemble in pair)
        lambdas, summary = _lambda_rows(*pair, windows[0]["default"], number, **bootstrap)
        made = lambdas, [summary], _exponent_rows(*pair, windows, number, **bootstrap)
        labels = {"hurst": hurst, "realizations": number}
        for name, members in zip(TABLES, made, strict=True):
            rows[name] += [labels | row for row in members]
    return {name: pd.DataFrame(rows[name], columns=list(columns)) for name, columns in TABLES.items()}


def _lambda_rows(discs, lines, window, number, **bootstrap):
    """Compare discs with lines of one Hurst exponent; return the rows of mdr_lambda and the row of mdr_summary.

    The table mdr_lambda has one row for each X.
    window : region (b) of the discs as (X_low, X_high); None if the discs have no region (b)
    number : number of discs or number of lines, whichever is smaller
    """
    if window is None:
        return [], {}
    x = discs["x"].values
    match = match_lines(x, discs["velocity"].values, lines["velocity"].values, **bootstrap)
    best, region = match.best_stretch(window), in_window(x, window)
    chosen = (x >= window[0] / 10) & (discs["fraction_defined"].values >= FRACTION_KEPT)
    chosen[chosen] = np.isfinite(match.deviation(best, chosen)[0])
    lambdas, errors, rows = match.lambda_at(x[chosen]), match.deviation(best, chosen), []
    for i, abscissa in enumerate(x[chosen]):
        row = {"x": abscissa, "in_region": int(in_window(abscissa, window))}
        row |= three_columns("lambda", with_interval(lambdas[:, i], number))
        rows.append(row | three_columns("velocity_ratio", with_interval(np.exp(errors[:, i]), number)))
    drift = np.exp(2 * _rise(x[region], match.stretch_at(x[region])))
    trend = _rise(x[region], match.deviation(best, region)) / 2
    beyond = x[chosen] >= window[0]
    # Not all discs may reach region (b), or the lines may end before it.
    whole = np.abs(errors[:, beyond]).max(axis=1) if beyond.any() else np.full(len(errors), np.nan)
    summary = three_columns("drift", with_interval(drift, number))
    summary |= three_columns("error_trend", with_interval(trend, number))
    return rows, summary | three_columns("error_whole", with_interval(whole, number))


def _rise(x, values):
    """Fit values by a straight line in ln X (least squares), and return its rise from the first to the last X.

    values : shape (samples, X)
    Returns an array of shape (samples,).
    """
    offset = np.log(x) - np.log(x).mean()
    return values @ offset / (offset @ offset) * np.ptp(offset)


def _exponent_rows(discs, lines, windows, number, *, seed, **bootstrap):
    """Compare the exponents β of lines and discs in each of the `WINDOWS`; return rows of the table mdr_exponents.

    Discs and lines have the same Hurst exponent. A row has β of the lines minus β of the discs, fitted in one window
    (range of X). If a window does not exist for the discs or for the lines, its row contains only the name of the
    window.

    windows : windows of the discs, and windows of the lines, each as returned by `named_windows`
    number : number of discs or number of lines, whichever is smaller; it determines the width of the interval
    """
    regions, kappa = ([rules[rule] for rules in windows] for rule in ("default", "kappa"))
    # Different seeds make the bootstrap samples of discs and lines independent.
    rows, seeds = [], np.random.SeedSequence(seed).spawn(2)
    for name, pair in zip(WINDOWS, (regions, [regions[0], regions[0]], kappa), strict=True):
        rows.append({"window": name})
        if None not in pair:
            (first, _), (second, _) = (
                fit_power_law(ensemble["x"].values, ensemble["velocity"].values, window, **bootstrap, seed=own)
                for ensemble, window, own in zip((discs, lines), pair, seeds, strict=True)
            )
            rows[-1] |= three_columns("difference", with_interval(second - first, number))
    return rows
