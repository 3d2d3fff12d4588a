"""Judge claims on the form of the curves: their collapse, and the regions (a), (b) and (c)."""

from itertools import pairwise

import numpy as np
from scipy.special import fdtri

from viscorough import reference
from viscorough_study.fits.intervals import UNDEFINED, interval, mean_with_interval, resampled_means, with_interval
from viscorough_study.fits.plateau import inner_slopes
from viscorough_study.verdicts.evidence import exact, hurst_name, judged

ROUNDING = 1e-9  # numbers of decades count as equal if they differ relatively by at most this
LEFT_REGION = 2.0  # a curve leaves region (a) when κ reaches this multiple of κ of a single element
SLOPE_OF_LINE = 0.05  # a slope that differs from 1 by at most this looks like 1 in Fig. 2
POWER_LAWS_LOST_MAX = 0.05  # largest fraction of synthetic power laws that may fail the test of `power_law_decades`
ONE_ELEMENT = 1 + 1e-9  # largest contact count, interpolated logarithmically, that still means a single element


def collapse(evidence, tolerance):
    """Yield the ratio of the scatter of ln(vt/h) between combinations to its scatter between Hurst exponents, at one X.

    A combination is a combination of force, viscosity, size and rms height. The X lies in the regions (b) of all Hurst
    exponents. The scatter of combinations is the component of variance between combinations (`excess_variance`),
    without the sampling scatter of their means. It is pooled over all Hurst exponents, because few combinations
    determine it poorly: the upper end of its interval from the nine combinations of one Hurst exponent would be twice
    as large as from the 36 combinations of four Hurst exponents.
    """
    windows = [window for window in evidence.regions.values() if window is not None]
    if len(windows) < 2 or len(windows) < len(evidence.regions):
        yield judged("all H", UNDEFINED, np.nan, None)
        return
    x = next(iter(evidence.pooled.values()))["x"].values
    nearest = int(np.argmin(np.abs(np.log(x) - np.mean(np.log(windows)))))
    logarithms = [
        [np.log(ensemble["velocity"].values[:, nearest]) for ensemble in ensembles]
        for ensembles in evidence.combinations.values()
    ]
    between_hursts = np.std([np.mean(np.concatenate(groups)) for groups in logarithms], ddof=1)
    yield combinations_case(evidence, logarithms, np.nan, tolerance, unit=between_hursts)


def combinations_case(evidence, sets, expected, tolerance, unit=1.0):
    """Return the case of the standard deviation of a quantity between combinations of one H, pooled over all H.

    sets : for every Hurst exponent, the samples of each combination (see `excess_variance`)
    unit : divisor of the standard deviation
    The extremes of the case are from single Hurst exponents, whose few combinations determine them poorly.
    """
    *values, _ = np.sqrt(excess_variance(sets)) / unit
    single = [np.sqrt(excess_variance([groups])[0]) / unit for groups in sets]
    number = min(sum(np.isfinite(group).sum() for group in groups) for groups in sets)
    extremes = min(single), max(single)
    return evidence.case("all H", values, expected, (-np.inf, tolerance), realizations=number, extremes=extremes)


def excess_variance(sets):
    """Return the component of variance between groups, by one-way analysis of variance with random effects.

    sets : list of sets; a set is a list of groups; a group holds samples, shape (realizations,), nan if undefined. The
        variance between groups is computed within each set, so the means of the sets may differ.

    Let σ_b² be the variance between groups, σ_w² the variance within groups, and n the number of realizations per
    group. The ratio of MS_between/MS_within to 1 + n σ_b²/σ_w² has the F distribution. Its quantiles F_p therefore give
    σ_b² = (MS_between/MS_within/F_p − 1) σ_w²/n, or 0 if this is negative. With MS_within for σ_w² the interval is
    exact for the ratio of the two variances.

    The upper end is at least the upper end for groups with sampling scatter only, MS_between = MS_within. Means that
    lie closer together than expected by chance are no evidence of a smaller component (power-constrained limit: Cowan,
    Cranmer, Gross & Vitells, arXiv:1105.3166).

    Returns the median of σ_b², the two ends of its 95 % interval, and σ_w²/n, the sampling variance of the mean of a
    group. All are nan for too few groups or realizations.
    """
    sets = [[group[np.isfinite(group)] for group in groups] for groups in sets]
    groups_of_all = [group for groups in sets for group in groups]
    size = np.mean([group.size for group in groups_of_all])
    freedom = len(groups_of_all) - len(sets), sum(group.size - 1 for group in groups_of_all)
    if min(freedom) < 1:
        return np.full(4, np.nan)
    within = sum(group.size * group.var() for group in groups_of_all) / freedom[1]
    between = sum(len(groups) * np.var([group.mean() for group in groups]) for groups in sets) / freedom[0]
    ratio = size * between / within
    ratios = np.array([ratio, ratio, max(ratio, 1.0)])
    excess = np.maximum(ratios / fdtri(*freedom, [0.5, 0.975, 0.025]) - 1, 0.0)
    return np.append(excess, 1.0) * within / size


def first_region(evidence, tolerance):
    """Yield the ratio of κ, while a single element is in contact, to κ = π/(K₀₀ n) of a single element.

    n is the number of elements across; `reference.one_element_stiffness` defines K₀₀.
    """
    for hurst, ensemble in evidence.pooled.items():
        alone = ensemble["contact_count"].values <= ONE_ELEMENT
        ratio = ensemble["stiffness"].values[alone] / reference.one_element_stiffness(evidence.across)
        value = np.median(ratio) if ratio.size else np.nan
        yield exact(hurst_name(hurst), value, 1.0, np.all(np.abs(ratio - 1) <= tolerance), ratio)


def last_region(evidence, tolerance):
    """Yield two cases at the end of the curves of each H: κ, which is Xh/(vt), and the slope of ln(vt/h) along ln X."""
    paper_slope = evidence.paper_value("regions", "slope_last")
    for hurst, ensemble in evidence.whole.items():
        x, stiffness = ensemble["x"].values, ensemble["stiffness"].values
        last = np.flatnonzero(ensemble["fraction_defined"].values == 1)[-1]
        end = np.flatnonzero(x >= x[last] / 10 ** evidence.rules["end_decades"])[0]
        velocity = ensemble["velocity"].values[:, end : last + 1]
        slopes = np.polyfit(np.log(x[end : last + 1]), np.log(velocity).T, 1)[0]
        complete = reference.COMPLETE_CONTACT_STIFFNESS
        for name, samples, expected in (("prefactor", stiffness[:, last], complete), ("slope", slopes, paper_slope)):
            ends, counts = (expected - tolerance, expected + tolerance), {"cases": 2 * len(evidence.pooled)}
            yield _mean_case(evidence, f"{hurst_name(hurst)}, {name}", samples, expected, ends, **counts)


def _mean_case(evidence, name, samples, expected, allowed, **counts):
    """Return the case of the mean of a quantity over realizations, with the least and largest realization as extremes.

    samples : the quantity for each realization; allowed : (low, high); counts : argument `cases` of `Evidence.case`
    """
    counts |= {"realizations": samples.size, "extremes": (samples.min(), samples.max())}
    return evidence.case(name, mean_with_interval(samples), expected, allowed, **counts)


def power_law(evidence, tolerance):
    """Yield half the spread of the local slope within region (b) of base discs (viscorough_study.fits.plateau)."""
    plateaus = evidence.tables["plateaus"].query("case_group == 'base'")
    for row in plateaus.to_dict("records"):
        context = {"realizations": row["realizations"], "cases": len(plateaus)}
        yield evidence.case(
            hurst_name(row["hurst"]), interval(row, "half_spread"), 0.0, (-np.inf, tolerance), **context
        )


def power_law_decades(evidence, tolerance):
    """Yield the number of decades with constant local slope, within the tolerance (viscorough_study.fits.plateau).

    Scatter shortens plateaus. A curve therefore fails only if synthetic power laws with the same scatter pass;
    otherwise it is undecided.
    """
    plateaus, needed = evidence.tables["plateaus"], evidence.rules["decades_min"] * (1 - ROUNDING)
    plateaus = plateaus[plateaus["case_group"] == "base"]
    for row in plateaus.to_dict("records"):
        values = interval(row, "decades")
        met = evidence.within(values, needed, np.inf, realizations=row["realizations"], cases=len(plateaus))
        met = None if met is False and row["power_law_fails"] > POWER_LAWS_LOST_MAX else met
        yield judged(hurst_name(row["hurst"]), values, np.nan, met)


def power_law_control(evidence, tolerance):
    """Yield half the spread of the local slope in region (b) of discs without long waves, hence without a power law.

    The claim is that the test of `power_law` rejects these discs, so their spread must be above the tolerance of this
    test.
    """
    plateaus = evidence.tables["plateaus"].query("case_group != 'base'")
    if plateaus.empty:
        yield judged("no control", UNDEFINED, np.nan, None)
    for row in plateaus.to_dict("records"):
        context = {"realizations": row["realizations"], "cases": len(plateaus)}
        values = interval(row, "half_spread")
        yield evidence.case(hurst_name(row["hurst"]), values, np.nan, (tolerance, np.inf), **context)


def separation(evidence, tolerance):
    """Yield the ratio of the X where region (a) ends for one Hurst exponent to the X for the next larger exponent.

    The ratio is above 1 if the curve of the larger exponent leaves region (a) first. Region (a) ends when the geometric
    mean of κ reaches `LEFT_REGION` times κ of a single element.
    """
    ends, level = {}, np.log(LEFT_REGION * reference.one_element_stiffness(evidence.across))
    for i, (hurst, ensemble) in enumerate(evidence.pooled.items()):
        stiffness = np.log(ensemble["stiffness"].values)
        stiffness = stiffness[:, np.isfinite(stiffness).all(axis=0)]
        # With different seeds, the bootstrap samples of the ensembles are independent.
        means = resampled_means(stiffness, evidence.resamples, np.random.default_rng([evidence.seed, i]))
        log_x = np.log(ensemble["x"].values[: means.shape[1]])
        # ln X where region (a) ends: of the ensemble, then of its resamples; nan if the end is not reached.
        ends[hurst] = np.array([np.interp(level, mean, log_x, left=np.nan, right=np.nan) for mean in means])
    for lower, higher in pairwise(ends):
        ratios = np.exp(ends[lower] - ends[higher])
        realizations = min(evidence.pooled[hurst].sizes["realization"] for hurst in (lower, higher))
        values, counts = with_interval(ratios, realizations), {"realizations": realizations, "cases": len(ends) - 1}
        yield evidence.case(f"H = {lower:g} over H = {higher:g}", values, np.nan, (1, np.inf), **counts)


def complete_contact(evidence, tolerance):
    """Yield the contact fraction at the X where the local slope reaches 1 within `SLOPE_OF_LINE`, and remains there."""
    for hurst, ensemble in evidence.whole.items():
        defined = ensemble["fraction_defined"].values == 1
        log_x, mean = np.log(ensemble["x"].values[defined]), np.log(ensemble["velocity_geometric"].values[defined])
        inner, (slopes,) = inner_slopes(log_x, mean[None], evidence.limits["slope_half_width"] * np.log(10))
        below = np.flatnonzero(slopes < 1 - SLOPE_OF_LINE)
        if not below.size or below[-1] + 1 == slopes.size:
            yield judged(hurst_name(hurst), UNDEFINED, 1.0, None)
            continue
        first = int(np.argmin(np.abs(np.log(ensemble["x"].values) - inner[below[-1] + 1])))
        name = f"{hurst_name(hurst)}, from X = {ensemble['x'].values[first]:.3g} on"
        yield _contact_case(evidence, name, ensemble, first, tolerance)


def complete_contact_end(evidence, tolerance):
    """Yield the contact fraction at the largest X that all curves of a Hurst exponent reach."""
    for hurst, ensemble in evidence.whole.items():
        last = np.flatnonzero(ensemble["fraction_defined"].values == 1)[-1]
        name = f"{hurst_name(hurst)}, at X = {ensemble['x'].values[last]:.3g}"
        yield _contact_case(evidence, name, ensemble, last, tolerance)


def _contact_case(evidence, name, ensemble, abscissa, tolerance):
    """Return the case of the mean contact fraction, which should be 1, at one abscissa.

    abscissa : index of this abscissa
    """
    fractions = ensemble["contact_count"].values[:, abscissa] / ensemble["elements"].item()
    return _mean_case(evidence, name, fractions, 1.0, (1 - tolerance, np.inf), cases=len(evidence.pooled))
