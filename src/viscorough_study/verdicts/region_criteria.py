"""Judge claims on the form of the curves: their collapse onto one curve, and their three regions.

In region (a) a single element is in contact. In region (b) the curves follow a power law. In region (c) they are lines
of slope 1, which the paper explains by almost complete contact.
"""

from itertools import pairwise

import numpy as np
from scipy.special import fdtri

from viscorough import reference
from viscorough_study.fits.intervals import UNDEFINED, interval, mean_with_interval, resampled_means, with_interval
from viscorough_study.fits.plateau import inner_slopes
from viscorough_study.verdicts.evidence import exact, hurst_name, judged

ROUNDING = 1e-9  # relative difference up to which two numbers of decades count as equal
LEFT_REGION = 2.0  # region (a) ends where κ is this multiple of κ of a single element in contact
# Region (c) begins where the local slope of the curves is 1 up to these deviations. The first is an assumption on what
# looks like the slope 1 in Fig. 2; the second shows how the start of region (c) depends on it.
SLOPES_OF_LINE = (0.05, 0.01)
# The local slope is fitted over this many decades of X to either side. A wider fit does not reach the ends of the
# curves, where the slope is nearest to 1.
DECADES_OF_SLOPE = 0.1
# A failure in `power_law_decades` counts only if at most this fraction of synthetic power laws fail as well.
POWER_LAWS_LOST_MAX = 0.05
# Largest contact count that still means a single element. Logarithmic interpolation of counts causes rounding errors.
ONE_ELEMENT = 1 + 1e-9


def collapse(evidence, tolerance):
    """Test whether the curves of one Hurst exponent collapse for all combinations of physical parameters.

    A combination consists of force, viscosity, size and rms height. The value is the ratio of two scatters of ln(vt/h)
    at one X: the scatter between combinations, divided by the scatter between Hurst exponents. The X is the geometric
    mean of the ends of region (b) of all Hurst exponents.

    The scatter between combinations excludes the sampling scatter of their means (`excess_variance`). It is pooled over
    all Hurst exponents, because few combinations determine it poorly. From the nine combinations of one Hurst exponent,
    the upper end of its interval would be twice as large as from the 36 combinations of four Hurst exponents.
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
    """Judge how much a quantity depends on force, viscosity, diameter and rms height; return one verdict for all H.

    The tested value is the standard deviation of the quantity between combinations of these four parameters. Only
    combinations with the same Hurst exponent are compared, and the variances of all Hurst exponents are pooled.

    sets : for every Hurst exponent, a list with the samples of each combination (see `excess_variance`)
    expected : value of the paper, or nan; tolerance : largest standard deviation allowed
    unit : divisor of the standard deviation
    The least and the largest result for a single Hurst exponent are stated as well. They are poorly determined, because
    a single Hurst exponent has few combinations.
    """
    *values, _ = np.sqrt(excess_variance(sets)) / unit
    single = [np.sqrt(excess_variance([groups])[0]) / unit for groups in sets]
    number = min(sum(np.isfinite(group).sum() for group in groups) for groups in sets)
    extremes = min(single), max(single)
    return evidence.case("all H", values, expected, (-np.inf, tolerance), realizations=number, extremes=extremes)


def excess_variance(sets):
    """Return the component of variance between groups, by one-way analysis of variance with random effects.

    sets : list of sets; a set is a list of groups; a group is an array of samples, shape (realizations,), nan if
        undefined. Groups are compared only within a set, so the means of the sets may differ.

    Let σ_b² be the variance between groups, σ_w² the variance within groups, and n the number of realizations per
    group. MS_between and MS_within are the mean squares of the analysis of variance. The quotient of
    MS_between/MS_within and 1 + n σ_b²/σ_w² has the F distribution. Its quantiles F_p therefore give
    σ_b² = (MS_between/MS_within/F_p − 1) σ_w²/n, or 0 if this is negative. With MS_within for σ_w² the interval is
    exact for the ratio of the two variances.

    The upper end of the interval is never smaller than its value for MS_between = MS_within, which is expected for
    groups with sampling scatter only. Means that lie closer together than expected by chance are no evidence of a
    smaller component (power-constrained limit: Cowan, Cranmer, Gross & Vitells, arXiv:1105.3166).

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
    """Test whether the stiffness κ in region (a), with a single element in contact, is π/(K₀₀ n).

    n is the number of elements across; `reference.one_element_stiffness` defines K₀₀. The claim is tested for each
    Hurst exponent. The tested value is the median of κ, divided by π/(K₀₀ n).
    """
    for hurst, ensemble in evidence.pooled.items():
        alone = ensemble["contact_count"].values <= ONE_ELEMENT
        ratio = ensemble["stiffness"].values[alone] / reference.one_element_stiffness(evidence.across)
        value = np.median(ratio) if ratio.size else np.nan
        yield exact(hurst_name(hurst), value, 1.0, np.all(np.abs(ratio - 1) <= tolerance), ratio)


def last_region(evidence, tolerance):
    """Test whether the curves end on the line vt/h = X in region (c); yield two verdicts for each Hurst exponent.

    Two means over the curves are tested: κ = Xh/(vt) at the largest X of the curves, and the slope of ln(vt/h) along
    ln X in the last part of the curves. Both are undecided if all curves have fewer than two X of this part in common.
    """
    paper_slope = evidence.paper_value("regions", "slope_last")
    for hurst, ensemble in evidence.whole.items():
        x, stiffness = ensemble["x"].values, ensemble["stiffness"].values
        reached = _reached_by_all(ensemble)
        reached = reached[x[reached] >= x[reached].max(initial=0.0) / 10 ** evidence.rules["end_decades"]]
        if reached.size < 2:
            for name in ("prefactor", "slope"):
                yield judged(f"{hurst_name(hurst)}, {name}", UNDEFINED, np.nan, None)
            continue
        end, last = reached[[0, -1]]
        velocity = ensemble["velocity"].values[:, end : last + 1]
        slopes = np.polyfit(np.log(x[end : last + 1]), np.log(velocity).T, 1)[0]
        complete = reference.COMPLETE_CONTACT_STIFFNESS
        for name, samples, expected in (("prefactor", stiffness[:, last], complete), ("slope", slopes, paper_slope)):
            ends, counts = (expected - tolerance, expected + tolerance), {"cases": 2 * len(evidence.pooled)}
            yield _mean_case(evidence, f"{hurst_name(hurst)}, {name}", samples, expected, ends, **counts)


def _reached_by_all(ensemble):
    """Return the indices of the abscissae that all curves reach."""
    return np.flatnonzero(ensemble["fraction_defined"].values == 1)


def _mean_case(evidence, name, samples, expected, allowed, **counts):
    """Return a verdict: whether the mean of a quantity over the realizations of an ensemble is in the allowed range.

    name : name of the verdict, which contains the Hurst exponent; expected : value of the paper, or nan
    samples : quantity for each realization. The least and the largest sample are stated as well
    allowed : (low, high); counts : argument `cases` of `Evidence.case`
    """
    counts |= {"realizations": samples.size, "extremes": (samples.min(), samples.max())}
    return evidence.case(name, mean_with_interval(samples), expected, allowed, **counts)


def power_law(evidence, tolerance):
    """Test whether the slope of ln(vt/h) along ln X is constant in region (b), for the discs that all figures use.

    The claim is tested for each Hurst exponent. The tested value is half the difference of the largest and the smallest
    slope (viscorough_study.fits.plateau).
    """
    plateaus = evidence.tables["plateaus"].query("case_group == 'base'")
    for row in plateaus.to_dict("records"):
        context = {"realizations": row["realizations"], "cases": len(plateaus)}
        yield evidence.case(
            hurst_name(row["hurst"]), interval(row, "half_spread"), 0.0, (-np.inf, tolerance), **context
        )


def power_law_decades(evidence, tolerance):
    """Test whether the slope of ln(vt/h) along ln X is constant over enough decades of X (see fits.plateau).

    The claim is tested for each Hurst exponent. The tested value is the number of decades of X in which the slope is
    constant within a tolerance. It must be at least `decades_min` of the settings.

    Scatter of the curves shortens the range of constant slope. A curve therefore fails only if synthetic power laws
    with the same scatter pass; otherwise it is undecided.
    """
    plateaus, needed = evidence.tables["plateaus"], evidence.rules["decades_min"] * (1 - ROUNDING)
    plateaus = plateaus[plateaus["case_group"] == "base"]
    for row in plateaus.to_dict("records"):
        values = interval(row, "decades")
        met = evidence.within(values, needed, np.inf, realizations=row["realizations"], cases=len(plateaus))
        met = None if met is False and row["power_law_fails"] > POWER_LAWS_LOST_MAX else met
        yield judged(hurst_name(row["hurst"]), values, np.nan, met)


def power_law_control(evidence, tolerance):
    """Test whether the criterion of `power_law` rejects discs without long waves, whose curves follow no power law.

    The claim is tested for each Hurst exponent. The tested value is half the difference of the largest and the smallest
    slope in region (b). The discs are rejected if it is above the tolerance of `power_law`.
    """
    plateaus = evidence.tables["plateaus"].query("case_group != 'base'")
    if plateaus.empty:
        yield judged("no control", UNDEFINED, np.nan, None)
    for row in plateaus.to_dict("records"):
        context = {"realizations": row["realizations"], "cases": len(plateaus)}
        values = interval(row, "half_spread")
        yield evidence.case(hurst_name(row["hurst"]), values, np.nan, (tolerance, np.inf), **context)


def separation(evidence, tolerance):
    """Test whether curves of larger Hurst exponents leave region (a) at smaller X (dimensionless force).

    The claim is tested for each pair of neighbouring Hurst exponents. The tested value is the X at which region (a)
    ends for the smaller exponent, divided by the X at which it ends for the larger exponent. It is above 1 if the curve
    of the larger exponent leaves region (a) first. Region (a) ends where the geometric mean of κ reaches `LEFT_REGION`
    times κ of a single element.
    """
    ends, level = {}, np.log(LEFT_REGION * reference.one_element_stiffness(evidence.across))
    for i, (hurst, ensemble) in enumerate(evidence.pooled.items()):
        stiffness = np.log(ensemble["stiffness"].values)
        stiffness = stiffness[:, np.isfinite(stiffness).all(axis=0)]
        # Each ensemble has a different seed, so that the bootstrap samples of the ensembles are independent.
        means = resampled_means(stiffness, evidence.resamples, np.random.default_rng([evidence.seed, i]))
        log_x = np.log(ensemble["x"].values[: means.shape[1]])
        # Values of ln X at the end of region (a), first for the ensemble, then for its resamples. Values are nan for
        # curves that do not reach this end.
        ends[hurst] = np.array([np.interp(level, mean, log_x, left=np.nan, right=np.nan) for mean in means])
    for lower, higher in pairwise(ends):
        ratios = np.exp(ends[lower] - ends[higher])
        realizations = min(evidence.pooled[hurst].sizes["realization"] for hurst in (lower, higher))
        values, counts = with_interval(ratios, realizations), {"realizations": realizations, "cases": len(ends) - 1}
        yield evidence.case(f"H = {lower:g} over H = {higher:g}", values, np.nan, (1, np.inf), **counts)


def complete_contact(evidence, tolerance):
    """Test whether the contact is almost complete where region (c) begins, by the mean contact fraction.

    Region (c) begins at the X from which on the slope of ln(vt/h) along ln X is 1 within a deviation. The claim is
    tested for each of `SLOPES_OF_LINE` and each Hurst exponent. A case whose curve does not reach this slope is
    undecided.
    """
    for deviation in SLOPES_OF_LINE:
        for hurst, ensemble in evidence.whole.items():
            defined = _reached_by_all(ensemble)
            log_x, mean = np.log(ensemble["x"].values[defined]), np.log(ensemble["velocity_geometric"].values[defined])
            inner, (slopes,) = inner_slopes(log_x, mean[None], DECADES_OF_SLOPE * np.log(10))
            below, name = np.flatnonzero(slopes < 1 - deviation), f"{hurst_name(hurst)}, slope within {deviation:g}"
            if not below.size or below[-1] + 1 == slopes.size:
                yield judged(name, UNDEFINED, 1.0, None)
                continue
            first = int(np.argmin(np.abs(np.log(ensemble["x"].values) - inner[below[-1] + 1])))
            name = f"{name}, from X = {ensemble['x'].values[first]:.3g} on"
            yield _contact_case(evidence, name, ensemble, first, tolerance, len(SLOPES_OF_LINE))


def complete_contact_end(evidence, tolerance):
    """Test whether the contact is almost complete at the largest X that all curves of a Hurst exponent reach."""
    for hurst, ensemble in evidence.whole.items():
        reached = _reached_by_all(ensemble)
        if not reached.size:
            yield judged(hurst_name(hurst), UNDEFINED, 1.0, None)
            continue
        name = f"{hurst_name(hurst)}, at X = {ensemble['x'].values[reached[-1]]:.3g}"
        yield _contact_case(evidence, name, ensemble, reached[-1], tolerance)


def _contact_case(evidence, name, ensemble, abscissa, tolerance, repeats=1):
    """Return a verdict: whether the mean contact fraction of an ensemble at one X is 1 within the tolerance.

    name : name of the verdict, which contains the Hurst exponent; abscissa : index of the X
    repeats : number of verdicts of the claim for each Hurst exponent
    """
    fractions = ensemble["contact_count"].values[:, abscissa] / ensemble["elements"].item()
    return _mean_case(evidence, name, fractions, 1.0, (1 - tolerance, np.inf), cases=repeats * len(evidence.pooled))
