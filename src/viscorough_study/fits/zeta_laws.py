"""Compare the paper's laws of the prefactor ζ(H) with the data: their deviation, and the part that is equal for all H.

The velocity follows vt/h = X^(H/(1+H))/ζ, with the reduced force X = F/(4GhL). Each law of ζ(H) is compared with
two quantities. Each comparison gives the logarithm r of a ratio for each Hurst exponent. The ratios are

- "zeta": the ratio of the measured ζ to ζ of the law. The measured ζ is fitted in region (b), together with β.
- "curve": the ratio of the measured vt/h to X^(H/(1+H))/ζ with ζ of the law, at abscissae that lie in the regions (b)
  of all Hurst exponents. For Eq. 11, with the factor 1/Γ(2 − α), this is the ratio of both sides of Eq. 12, as in
  Fig. 3.

Three numbers (measures) are computed from r. The deviation is √⟨r²⟩. The common factor is exp⟨r⟩. The spread between
Hurst exponents is √⟨(r − ⟨r⟩_H)²⟩, where ⟨r⟩_H is the mean over the Hurst exponents. It is the deviation that remains
if ζ of the law is multiplied by the factor that fits all H best. For "zeta" the spread is the error of the shape of
ζ(H). For "curve" the spread is 0 if all curves collapse onto one curve. Intervals are from bootstrap samples of the
realizations. Scatter of the surfaces increases the deviation and the spread, so both are on average too large.

Eq. 4 is a law of the elastic contact, without the factor 1/Γ(2 − α). The paper compares it with Eq. 11, which has this
factor.
"""

import numpy as np
import pandas as pd

from viscorough import reference
from viscorough_study.ensembles.pool import ensembles, select
from viscorough_study.fits.conventions import zeta_scale
from viscorough_study.fits.intervals import UNDEFINED, with_interval
from viscorough_study.fits.power_law import fit_power_law, in_window, log_means, named_windows

LAWS = {  # {name: (ζ as a function of H, True if the law has the factor 1/Γ(2 − α))}
    "Eq. 4, without Γ": (reference.zeta_elastic, False),
    "Eq. 4, with Γ": (reference.zeta_elastic, True),
    "Eq. 11, with Γ": (reference.zeta_viscous, True),
}
LAST = list(LAWS)[-1]  # name of the law with which the other laws are compared
UNCOMPARED = dict.fromkeys(LAWS, np.full((2, 1, 1), np.nan))  # r (see the module) if there is nothing to compare
COLUMNS = {
    "hurst_min": ("lowest Hurst exponent allowed", "1"),
    "quantity": ("what is compared with the law: zeta, or curve", ""),
    "law": ("law; of two laws, the measure of the first less that of the second", ""),
    "measure": ("deviation, common factor or spread between Hurst exponents", ""),
    "value": ("value of the measure", "1"),
    "low": ("lower end of its 95 % interval", "1"),
    "high": ("upper end of its 95 % interval", "1"),
    "realizations": ("fewest discs of a Hurst exponent", "1"),
}


def zeta_laws_of_pool(discs, *, conventions, hurst_mins, fit, resamples, seed):
    """Compare the paper's laws of ζ(H) with the base discs, which all figures use; return the table of `zeta_laws`.

    discs : pool of the loading curves of discs (viscorough_study.ensembles.pool)
    conventions : {"average": kind of mean over the discs, "rms_convention": where h is measured}
    fit : arguments of fits.power_law.named_windows, whose default window is region (b)
    hurst_mins, resamples, seed : arguments of `zeta_laws`
    """
    base = ensembles(select(discs, group="base"), "hurst", rms_convention=conventions["rms_convention"])
    pooled = dict(sorted(base.items()))
    windows = {hurst: named_windows(members, **fit)["default"] for hurst, members in pooled.items()}
    return zeta_laws(pooled, windows, hurst_mins, average=conventions["average"], resamples=resamples, seed=seed)


def zeta_laws(ensembles, windows, hurst_mins=(0.0,), *, average, resamples, seed):
    """Compute how well each of the paper's laws of ζ(H) agrees with the data, by three measures.

    The data are the measured ζ ("zeta"), and the curves of vt/h as functions of X ("curve"). Let r be the logarithm of
    the ratio of the data to the law. The measures are the deviation √⟨r²⟩, the common factor exp⟨r⟩, and the spread of
    r between Hurst exponents (see the module).

    Returns a pandas.DataFrame with the columns of `COLUMNS`. It has the measures of every law. For every law except
    Eq. 11 of the paper it also has two differences: the deviation minus the deviation of Eq. 11, and the spread minus
    the spread of Eq. 11.

    ensembles : {H: ensemble dataset (viscorough_study.ensembles.averages)}, where the rms height h is measured in a
        single region of the surface
    windows : {H: ends (X_low, X_high) of region (b), or None}
    hurst_mins : list of Hurst exponents; the laws are compared once for each entry, with the data of all H that are at
        least this entry
    average : "arithmetic" or "geometric" mean over the realizations
    resamples, seed : number of resamples and seed of the bootstrap, which draws the realizations of each Hurst exponent
        independently
    All values are nan if one of the compared Hurst exponents has no region (b). The values for "curve" are nan if the
    regions (b) of the Hurst exponents have no X in common.
    """
    bootstrap, rows = {"average": average, "resamples": resamples, "seed": seed}, []
    for hurst_min in hurst_mins:
        chosen = {hurst: ensemble for hurst, ensemble in ensembles.items() if hurst >= hurst_min}
        number = min((ensemble.sizes["realization"] for ensemble in chosen.values()), default=0)
        for quantity, ratios in _ratios(chosen, [windows[hurst] for hurst in chosen], **bootstrap).items():
            measures = {law: _measures(values) for law, values in ratios.items()}
            for law in list(LAWS)[:-1]:
                less = {name: measures[law][name] - measures[LAST][name] for name in ("deviation", "spread")}
                measures[difference(law)] = less
            for law, law_measures in measures.items():
                for measure, values in law_measures.items():
                    rows.append((hurst_min, quantity, law, measure, *with_interval(values, number), number))
    return pd.DataFrame(rows, columns=list(COLUMNS))


def measure_value(table, quantity, law, measure, hurst_min=0.0):
    """Look up a deviation, common factor or spread in the table of `zeta_laws`; return (value, low, high).

    low and high are the ends of the 95 % interval.

    quantity, measure, hurst_min : entries of the columns of these names
    law : key of `LAWS`, or result of `difference`
    The result is nan if the table has no such row.
    """
    rows = table.query("quantity == @quantity and law == @law and measure == @measure and hurst_min == @hurst_min")
    return tuple(rows[["value", "low", "high"]].iloc[0].tolist()) if len(rows) else UNDEFINED


def difference(law):
    """Return the entry of the column "law" in rows whose value is the difference of two laws: `law` minus Eq. 11.

    The difference is that of their deviations or of their spreads (see the module).

    A positive difference means that Eq. 11 is nearer to the data.
    """
    return f"{law} minus {LAST}"


def _measures(logarithms):
    """Compute deviation, common factor and spread from the logarithms r (see the module); return {name: values}.

    logarithms : r, shape (resamples + 1, Hurst exponents, X)
    Each array of values has the shape (resamples + 1,). The first value belongs to the ensemble.
    """
    mean_over_hursts = logarithms.mean(axis=1, keepdims=True)
    return {
        "deviation": np.sqrt(np.mean(logarithms**2, axis=(1, 2))),
        "common factor": np.exp(logarithms.mean(axis=(1, 2))),
        "spread": np.sqrt(np.mean((logarithms - mean_over_hursts) ** 2, axis=(1, 2))),
    }


def _ratios(ensembles, windows, *, average, resamples, seed):
    """Return {quantity: {law: r}}, where r is the logarithm of the ratio of the data to the law (see the module).

    Each array r has the shape (resamples + 1, Hurst exponents, X); for ζ, X has one entry.

    ensembles : {H: ensemble dataset}
    windows : for each ensemble, the ends (X_low, X_high) of region (b), or None
    average, resamples, seed : arguments of fits.power_law.fit_power_law
    All values are nan if an ensemble has no region (b). Values of "curve" are nan if the windows have no X in common.
    """
    if not windows or None in windows:
        return {"zeta": UNCOMPARED, "curve": UNCOMPARED}
    common = max(low for low, _ in windows), min(high for _, high in windows)
    ratios = {quantity: {law: [] for law in LAWS} for quantity in ("zeta", "curve")}
    for i, ((hurst, ensemble), window) in enumerate(zip(ensembles.items(), windows, strict=True)):
        x, velocity = ensemble["x"].values, ensemble["velocity"].values
        betas, zetas = fit_power_law(x, velocity, window, average=average, resamples=resamples, seed=[seed, i])
        inside, generator = in_window(x, common), np.random.default_rng([seed, i])
        means = log_means(velocity[:, inside], average, resamples, generator)
        for law, (function, gamma) in LAWS.items():
            zeta, scale = function(hurst), zeta_scale(betas, "with" if gamma else "without")
            curve = reference.velocity_law(x[inside], zeta, reference.exponent_alpha(hurst), gamma=gamma)
            ratios["zeta"][law].append(np.log(zetas * scale / zeta)[:, None])
            ratios["curve"][law].append(means - np.log(curve))
    stacked = {name: {law: np.stack(rows, axis=1) for law, rows in by_law.items()} for name, by_law in ratios.items()}
    return stacked if common[0] < common[1] else stacked | {"curve": UNCOMPARED}
