"""Criteria of claims on the form of the curves: their collapse, and the regions (a), (b) and (c)."""

import numpy as np
from scipy import stats

from viscorough import reference
from viscorough_study.evidence import NO_INTERVAL, UNDEFINED, equivalence, hurst_name, judged, mean_with_interval

ROUNDING = 1e-9  # relative difference up to which numbers of decades count as equal
POWER_LAWS_LOST_MAX = 0.05  # share of synthetic power laws that may fail the test for one
ONE_ELEMENT = 1 + 1e-9  # elements in contact, interpolated in the logarithm, up to which a single one touches


def collapse(evidence, tolerance):
    """Scatter of ln(vt/h) over combinations, over that between Hurst exponents, at one X in all regions (b).

    The scatter of combinations is the component of variance between them (`excess_variance`), without the scatter that
    the means of their few realizations would have anyway.
    """
    windows = [window for window in evidence.regions.values() if window is not None]
    if len(windows) < 2 or len(windows) < len(evidence.regions):
        return [judged(hurst_name(hurst), UNDEFINED, np.nan, None) for hurst in evidence.regions]
    x = next(iter(evidence.pooled.values()))["x"].values
    at = int(np.argmin(np.abs(np.log(x) - np.mean(np.log(windows)))))
    logarithms = {
        hurst: [np.log(ensemble["velocity"].values[:, at]) for ensemble in ensembles]
        for hurst, ensembles in evidence.combinations.items()
    }
    between_hursts = np.std([np.mean(np.concatenate(groups)) for groups in logarithms.values()], ddof=1)
    cases = []
    for hurst, groups in logarithms.items():
        *values, _ = np.sqrt(excess_variance(groups)) / between_hursts
        cases.append(judged(hurst_name(hurst), values, np.nan, equivalence(values[1:], 0, tolerance)))
    return cases


def excess_variance(groups):
    """Component of variance between groups, from a one-way analysis of variance with random effects.

    groups : samples of each group, shape (realizations,), nan where undefined

    With n realizations per group, MS_between/MS_within over 1 + n σ_b²/σ_w² has the F distribution, so that
    σ_b² = (MS_between/MS_within/F_p − 1) σ_w²/n at its quantiles F_p, or 0 where that is negative. With MS_within for
    σ_w² the interval is exact for the ratio of the two variances.
    Returns the median, the two ends of the 95 % interval, and σ_w²/n, the variance that the means of the groups have by
    the scatter within them; nan for too few groups or realizations.
    """
    groups = [group[np.isfinite(group)] for group in groups]
    size = np.mean([group.size for group in groups])
    freedom = len(groups) - 1, sum(group.size - 1 for group in groups)
    if min(freedom) < 1:
        return np.full(4, np.nan)
    within = sum(group.size * group.var() for group in groups) / freedom[1]
    ratio = size * np.var([group.mean() for group in groups], ddof=1) / within
    excess = np.maximum(ratio / stats.f.ppf([0.5, 0.975, 0.025], *freedom) - 1, 0.0)
    return np.append(excess, 1.0) * within / size


def first_region(evidence, tolerance):
    """κ while one element touches, over π/(K₀₀ n)."""
    cases = []
    for hurst, ensemble in evidence.pooled.items():
        alone = ensemble["contact_count"].values <= ONE_ELEMENT
        ratio = ensemble["stiffness"].values[alone] / reference.one_element_stiffness(evidence.across)
        if not ratio.size:
            cases.append(judged(hurst_name(hurst), UNDEFINED, 1.0, None))
            continue
        met, extremes = bool(np.all(np.abs(ratio - 1) <= tolerance)), (ratio.min(), ratio.max())
        cases.append(judged(hurst_name(hurst), (np.median(ratio), *NO_INTERVAL), 1.0, met, extremes=extremes))
    return cases


def last_region(evidence, tolerance):
    """Xh/(vt), which is κ, and the slope of ln(vt/h) over ln X, where curves end."""
    slope_said, cases = evidence.said("regions", "slope_last"), []
    for hurst, ensemble in evidence.pooled.items():
        x, stiffness = ensemble["x"].values, ensemble["stiffness"].values
        last = np.flatnonzero(ensemble["fraction_defined"].values == 1)[-1]
        end = np.flatnonzero(x >= x[last] / 10 ** evidence.rules["end_decades"])[0]
        velocity = ensemble["velocity"].values[:, end : last + 1]
        slopes = np.polyfit(np.log(x[end : last + 1]), np.log(velocity).T, 1)[0]
        complete = reference.COMPLETE_CONTACT_STIFFNESS
        for name, samples, said in (("prefactor", stiffness[:, last], complete), ("slope", slopes, slope_said)):
            values, extremes = mean_with_interval(samples), (samples.min(), samples.max())
            met = equivalence(values[1:], said - tolerance, said + tolerance)
            cases.append(judged(f"{hurst_name(hurst)}, {name}", values, said, met, extremes=extremes))
    return cases


def power_law(evidence, tolerance):
    """Decades over which the local slope is constant within the tolerance (viscorough_study.plateau).

    Scatter shortens plateaus, so a curve fails only where power laws with that scatter do not.
    """
    plateaus, cases = evidence.tables["plateaus"], []
    for row in plateaus[plateaus["case_group"] == "base"].itertuples():
        values = row.decades, row.decades_low, row.decades_high
        met = equivalence(values[1:], evidence.rules["decades_min"] * (1 - ROUNDING), np.inf)
        met = None if met is False and row.power_law_fails > POWER_LAWS_LOST_MAX else met
        cases.append(judged(f"{hurst_name(row.hurst)}, decades", values, np.nan, met))
    return cases


JUDGES = {
    "collapse": collapse,
    "first_region": first_region,
    "last_region": last_region,
    "power_law": power_law,
}
