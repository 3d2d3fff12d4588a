"""Criteria of the paper's claims: for each a quantity with its interval, and whether that meets the criterion.

With other random surfaces the numbers differ, and a verdict must not depend on them: where a quantity has a 95 %
interval, a claim fails if the whole interval lies outside of what the tolerance allows, and it cannot be tested if the
interval is much wider than that.

A criterion is a function of the evidence (viscorough_study.evidence.Evidence) and the tolerance of the claim; it
returns the cases of the claim. `JUDGES` has the criterion of every claim in resources/paper/claims.yaml.
"""

import numpy as np
from scipy import stats

from viscorough import reference
from viscorough.surfaces import cut_disc
from viscorough_study import law_criteria
from viscorough_study.evidence import UNDEFINED, Case, judged
from viscorough_study.law_criteria import hurst_name

ONE_ELEMENT = 1 + 1e-9  # elements in contact, interpolated in the logarithm, up to which a single one touches

# ---- form and regions


def collapse(evidence, tolerance):
    """Scatter of ln(vt/h) over combinations, over that between Hurst exponents, at one X in all regions (b).

    The scatter of combinations is the component of variance between them (`excess_variance`), without the scatter that
    the means of their few realizations would have anyway. Where this alone exceeds the tolerance, the claim cannot be
    tested.
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
        *values, of_few_realizations = np.sqrt(excess_variance(groups)) / between_hursts
        met = bool(values[1] <= tolerance) if of_few_realizations <= tolerance else None
        cases.append(judged(hurst_name(hurst), values, np.nan, met))
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
        values = (np.median(ratio), ratio.min(), ratio.max()) if ratio.size else UNDEFINED
        met = bool(np.all(np.abs(ratio - 1) <= tolerance)) if ratio.size else None
        cases.append(judged(hurst_name(hurst), values, 1.0, met))
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
            values = samples.mean(), samples.min(), samples.max()
            met = bool(abs(values[0] - said) <= tolerance)
            cases.append(judged(f"{hurst_name(hurst)}, {name}", values, said, met))
    return cases


def power_law(evidence, tolerance):
    """Rms deviation of ln(vt/h) from a straight line, and the decades of region (b)."""
    cases = []
    for hurst, fit in evidence.fits("discs").iterrows():
        names = f"{hurst_name(hurst)}, deviation", f"{hurst_name(hurst)}, decades (log₁₀X from, to)"
        deviation, decades = fit["residual"], fit["decades"]
        if np.isfinite(deviation):
            ends = np.log10(fit["x_low"]), np.log10(fit["x_high"])
            cases.append(judged(names[0], (deviation, 0.0, deviation), np.nan, deviation <= tolerance))
        else:
            ends = np.nan, np.nan
            cases.append(judged(names[0], UNDEFINED, np.nan, None))
        cases.append(judged(names[1], (decades, *ends), np.nan, bool(decades >= evidence.rules["decades_min"])))
    return cases


def gamma(evidence, tolerance):
    """Depth of direct integrations in time over the elastic depth, against the factor of Eq. 8."""
    cases = []
    for name, rows in evidence.direct.groupby("case", sort=False):
        ratio, factor = rows["depth_ratio"], rows["with_gamma"].iloc[0]
        met = bool((np.abs(ratio - factor) <= tolerance).all())
        cases.append(judged(name, (ratio.median(), ratio.min(), ratio.max()), factor, met))
    return cases


# ---- reduction of dimensionality


def line_spectrum(evidence, tolerance):
    """λ, which is π if the line needs no correction; reproduced if it differs at some Hurst exponent."""
    fits = evidence.fits("discs")[["lambda", "lambda_low", "lambda_high"]]
    excludes_pi = (fits["lambda_low"] > np.pi) | (fits["lambda_high"] < np.pi)
    differs = (excludes_pi & (np.abs(fits["lambda"] / np.pi - 1) > tolerance)).any()
    return [judged(hurst_name(hurst), values.tolist(), np.pi, differs) for hurst, values in fits.iterrows()]


def bodies_of_revolution(evidence, tolerance):
    """Error of the reduction on the finest grid, with the least and the largest of all grids."""
    rows = evidence.validation[evidence.validation["case"].str.endswith("_reduction")]
    cases = []
    for (case, quantity), grids in rows.groupby(["case", "quantity"], sort=False):
        error = grids.sort_values("elements")["error"]
        # The stiffness of a line is its number of points in contact, so it is exact up to the distance of two points.
        limit = tolerance if quantity == "depth" else 2 / grids["elements"].max()
        values = error.iloc[-1], error.min(), error.max()
        cases.append(judged(f"{case.removesuffix('_reduction')}, {quantity}", values, 0.0, error.iloc[-1] <= limit))
    return cases


# ---- numbers


def elements(evidence, tolerance):
    """Elements of a disc as large as the paper's."""
    across, said = (evidence.said("boundary_elements", name) for name in ("elements_across", "elements"))
    count = np.isfinite(cut_disc(np.zeros((across, across)), across)).sum()
    return [judged(f"{across} across", (count, count, count), said, bool(abs(count - said) <= tolerance))]


def computing_time(evidence, tolerance):
    """Contact events of one indentation to the end of its curve, each of them a contact problem for explicit steps."""
    counts = [ensemble["contact_count"].max("abscissa").values for ensemble in evidence.pooled.values()]
    counts = np.concatenate(counts)
    return [Case("events of an indentation", np.median(counts), counts.min(), counts.max(), np.nan, "not testable")]


JUDGES = {
    "collapse": collapse,
    "first_region": first_region,
    "last_region": last_region,
    "power_law": power_law,
    "beta": law_criteria.beta,
    "beta_lines": law_criteria.beta_lines,
    "coincide": law_criteria.coincide,
    "depth": law_criteria.depth,
    "zeta_elastic": law_criteria.zeta_elastic,
    "zeta_viscous": law_criteria.zeta_viscous,
    "gamma": gamma,
    "master_curve": law_criteria.master_curve,
    "line_spectrum": line_spectrum,
    "bodies_of_revolution": bodies_of_revolution,
    "elements": elements,
    "computing_time": computing_time,
}
