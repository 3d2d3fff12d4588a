"""Compare the paper's laws of the prefactor ζ(H) with the curves: how far they deviate, and by which constant.

The velocity follows vt/h = X^β/ζ, with the reduced force X = F/(4GhL) and the paper's exponent β = H/(1 + H). Each law
of ζ(H) is compared with the mean curves of the discs by the logarithm r of the ratio of vt/h to the law. For Eq. 11,
with the factor 1/Γ(2 − α), this is the ratio of both sides of Eq. 12, as in Fig. 3. There are two ranges of X:

- "region": region (b) of each Hurst exponent. All Hurst exponents have the same weight.
- "common": the X that lie in the regions (b) of all Hurst exponents. Curves are compared at equal X there.

The measures of both ranges are the deviation √⟨r²⟩, the common factor exp⟨r⟩, the residual √⟨(r − ⟨r⟩)²⟩ that remains
after a division by the common factor, the factor c on X that fits best, so that r ≈ β ln c, and the residual that
remains with this factor. In the range "common" there is also the spread between Hurst exponents, √⟨(r − ⟨r⟩_H)²⟩, where
⟨r⟩_H is the mean over the Hurst exponents at one X. The spread is 0 if all curves collapse onto one curve, whatever its
form. Intervals are from bootstrap samples of the realizations. Scatter of the surfaces increases deviations, residuals
and the spread, so they are on average too large.

Eq. 4 is a law of the elastic contact, without the factor 1/Γ(2 − α). The paper compares it with Eq. 11 inside Eq. 9,
where both have this factor.
"""

import numpy as np
import pandas as pd
from scipy.special import gamma as gamma_function

from viscorough import reference
from viscorough_study.ensembles.pool import ensembles, select
from viscorough_study.fits.conventions import READINGS
from viscorough_study.fits.intervals import UNDEFINED, with_interval
from viscorough_study.fits.power_law import in_window, log_means, named_windows

LAWS = {  # {name: (ζ as a function of H, True if the law has the factor 1/Γ(2 − α))}
    "Eq. 4, without Γ": (reference.zeta_elastic, False),
    "Eq. 4, with Γ": (reference.zeta_elastic, True),
    "Eq. 11, with Γ": (reference.zeta_viscous, True),
}
LAST = list(LAWS)[-1]  # name of the law with which the other laws are compared
MEASURES = ("deviation", "common factor", "residual", "factor of X", "residual with factor of X")
COLUMNS = {
    "reading": ("reading of the surfaces: A (period L, h of the disc), B (longer period, h of the square)", ""),
    "hurst_min": ("lowest Hurst exponent allowed", "1"),
    "range": ("range of X: region, or common", ""),
    "law": ("law; of two laws, the measure of the first less that of the second", ""),
    "measure": (f"one of: {'; '.join(MEASURES)}; spread between Hurst exponents", ""),
    "value": ("value of the measure", "1"),
    "low": ("lower end of its 95 % interval", "1"),
    "high": ("upper end of its 95 % interval", "1"),
    "realizations": ("fewest discs of a Hurst exponent", "1"),
}


def zeta_laws_of_pool(discs, *, average, hurst_mins, fit, resamples, seed):
    """Compare the paper's laws of ζ(H) with the discs of both readings; return the table with the columns `COLUMNS`.

    discs : pool of the loading curves of discs (viscorough_study.ensembles.pool)
    average : "arithmetic" or "geometric" mean over the discs
    fit : arguments of fits.power_law.named_windows, whose default window is region (b)
    hurst_mins, resamples, seed : arguments of `zeta_laws`
    """
    tables = []
    for reading, chosen in READINGS.items():
        members = select(discs, group=chosen["group"])
        pooled = dict(sorted(ensembles(members, "hurst", rms_convention=chosen["rms_convention"]).items()))
        windows = {hurst: named_windows(ensemble, **fit)["default"] for hurst, ensemble in pooled.items()}
        tables.append(
            zeta_laws(pooled, windows, hurst_mins, reading=reading, average=average, resamples=resamples, seed=seed)
        )
    return pd.concat(tables, ignore_index=True)


def zeta_laws(ensembles, windows, hurst_mins=(0.0,), *, average, resamples, seed, reading="A"):
    """Compute how well each of the paper's laws of ζ(H) agrees with the curves (see the module).

    Returns a pandas.DataFrame with the columns of `COLUMNS`. It has the measures of every law. For every law except
    Eq. 11 of the paper it also has two differences: the deviation minus the deviation of Eq. 11, and the spread minus
    the spread of Eq. 11.

    ensembles : {H: ensemble dataset (viscorough_study.ensembles.averages)}, where the rms height h is measured in a
        single region of the surface
    windows : {H: ends (X_low, X_high) of region (b), or None}
    hurst_mins : list of Hurst exponents; the laws are compared once for each entry, with the curves of all H that are
        at least this entry
    average : "arithmetic" or "geometric" mean over the realizations
    reading : reading of the surfaces to which the ensembles belong (fits.conventions.READINGS), for the table
    resamples, seed : number of resamples and seed of the bootstrap, which draws the realizations of each Hurst exponent
        independently
    All values are nan if one of the compared Hurst exponents has no region (b). The values for "common" are nan if the
    regions (b) of the Hurst exponents have no X in common.
    """
    rows = []
    for hurst_min in hurst_mins:
        hursts = [hurst for hurst in ensembles if hurst >= hurst_min]
        number = min((ensembles[hurst].sizes["realization"] for hurst in hursts), default=0)
        for name, ranges in _ranges([windows[hurst] for hurst in hursts]).items():
            means = [
                _log_means(ensembles[hurst], window, average, resamples, [seed, i])
                for i, (hurst, window) in enumerate(zip(hursts, ranges, strict=True))
            ]
            measures = {law: _measures(_ratios(means, hursts, *LAWS[law]), hursts, name) for law in LAWS}
            for law in list(LAWS)[:-1]:
                compared = {"deviation", "spread"} & set(measures[law])
                less = {key: measures[law][key] - measures[LAST][key] for key in sorted(compared)}
                measures[difference(law)] = less
            for law, law_measures in measures.items():
                for measure, values in law_measures.items():
                    rows.append((reading, hurst_min, name, law, measure, *with_interval(values, number), number))
    return pd.DataFrame(rows, columns=list(COLUMNS))


def measure_value(table, range_of_x, law, measure, hurst_min=0.0, reading="A"):
    """Look up a measure in the table of `zeta_laws`; return (value, low, high), with the ends of the 95 % interval.

    range_of_x, measure, hurst_min, reading : entries of the columns range, measure, hurst_min and reading
    law : key of `LAWS`, or result of `difference`
    The result is nan if the table has no such row.
    """
    chosen = "reading == @reading and range == @range_of_x and law == @law and measure == @measure"
    rows = table.query(f"{chosen} and hurst_min == @hurst_min")
    return tuple(rows[["value", "low", "high"]].iloc[0].tolist()) if len(rows) else UNDEFINED


def difference(law):
    """Return the entry of the column "law" in rows whose value is the difference of two laws: `law` minus Eq. 11.

    The difference is that of their deviations or of their spreads (see the module).

    A positive difference means that Eq. 11 is nearer to the curves.
    """
    return f"{law} minus {LAST}"


def _ranges(windows):
    """Return {name of a range of X: for each Hurst exponent its ends, or None if the range does not exist}.

    windows : for each Hurst exponent, the ends (X_low, X_high) of region (b), or None
    """
    nowhere = [None] * len(windows)
    if not windows or None in windows:
        return {"region": nowhere, "common": nowhere}
    common = max(low for low, _ in windows), min(high for _, high in windows)
    return {"region": windows, "common": [common] * len(windows) if common[0] < common[1] else nowhere}


def _log_means(ensemble, window, average, resamples, seed):
    """Return X in a window, and ln(vt/h) there of the ensemble and its resamples, shape (resamples + 1, X).

    window : (X_low, X_high), or None, for which all values are nan
    """
    if window is None:
        return np.full(1, np.nan), np.full((resamples + 1, 1), np.nan)
    x, inside = ensemble["x"].values, in_window(ensemble["x"].values, window)
    means = log_means(ensemble["velocity"].values[:, inside], average, resamples, np.random.default_rng(seed))
    return x[inside], means


def _ratios(means, hursts, zeta, gamma):
    """Return r (see the module) for each Hurst exponent, shape (resamples + 1, X).

    means : for each Hurst exponent, the result of `_log_means`
    zeta : the law, a function of H; gamma : True if the law has the factor 1/Γ(2 − α)
    """
    ratios = []
    for (x, mean), hurst in zip(means, hursts, strict=True):
        scale = zeta(hurst) * (gamma_function(2 - reference.exponent_alpha(hurst)) if gamma else 1)
        ratios.append(mean - reference.exponent_beta(hurst) * np.log(x) + np.log(scale))
    return ratios


def _measures(ratios, hursts, range_of_x):
    """Compute the measures from the logarithms r (see the module); return {name: values}.

    ratios : for each Hurst exponent, r, shape (resamples + 1, X); range_of_x : "region" or "common"
    Each array of values has the shape (resamples + 1,). The first value belongs to the ensemble.
    """
    if not ratios:
        return dict.fromkeys((*MEASURES, *["spread"] * (range_of_x == "common")), np.full(2, np.nan))
    exponents = reference.exponent_beta(np.array(hursts))
    means = np.stack([r.mean(axis=1) for r in ratios])
    squares = np.mean([np.mean(r**2, axis=1) for r in ratios], axis=0)
    mean, slope = means.mean(axis=0), exponents @ means / (exponents @ exponents)
    # The mean squares that remain follow from the means, since both factors are least-squares fits.
    remaining = squares - mean**2, squares - np.mean(exponents**2) * slope**2
    residuals = [np.sqrt(np.maximum(square, 0)) for square in remaining]
    values = np.sqrt(squares), np.exp(mean), residuals[0], np.exp(slope), residuals[1]
    measures = dict(zip(MEASURES, values, strict=True))
    if range_of_x == "region":
        return measures
    stacked = np.stack(ratios)  # at equal X of all Hurst exponents
    return measures | {"spread": np.sqrt(np.mean((stacked - stacked.mean(axis=0)) ** 2, axis=(0, 2)))}
