"""Claims on the form of the curves: their collapse onto one curve, their three regions, and the depth.

In region (a) a single element is in contact. In region (b) the curves follow a power law. In region (c) they are lines
of slope 1, which the paper explains by almost complete contact.
"""

from itertools import pairwise

import numpy as np
from scipy.special import fdtri

from viscorough import reference
from viscorough_study.fits.conventions import CONTROL
from viscorough_study.fits.intervals import UNDEFINED, interval, mean_with_interval, resampled_means, with_interval
from viscorough_study.fits.power_law import fit_power_law, inner_slopes, log_means
from viscorough_study.verdicts.claim import claim
from viscorough_study.verdicts.evidence import hurst_name, judged

LEFT_REGION = 2.0  # region (a) ends where κ is this multiple of κ of a single element in contact
# Region (c) begins where the local slope of the curves is 1 up to these deviations. The first is an assumption on what
# looks like the slope 1 in Fig. 2; the second shows how the start of region (c) depends on it.
SLOPES_OF_LINE = (0.05, 0.01)
# The local slope is fitted over this many decades of X to either side. A wider fit does not reach the ends of the
# curves, where the slope is nearest to 1.
DECADES_OF_SLOPE = 0.1
# The slope and the prefactor of region (c) are taken over this many decades at the end of the curves.
END_DECADES = 0.25
# The local slopes of a curve that is nearly linear lie within ± this number of their mid-range. It is half the smallest
# distance between the exponents H/(1 + H) of two Hurst exponents of the paper, 0.09.
NEARLY_LINEAR = 0.05


@claim(
    title="for each H, the curves of all forces, viscosities and sizes collapse onto one",
    sentence="vt/h is a function of Ft/(ηhL) and H alone, so the curves of one H, for all combinations of force, "
    "viscosity, size and rms height, “always collapse to a single master curve”",
    where="Eqs. 1 and 2, Fig. 2",
    kind="own",
    quantity="scatter of ln(vt/h) between combinations over that between Hurst exponents",
    criterion="the scatter between combinations of one H, beyond the scatter of their surfaces, is below the "
    "tolerance times the scatter between Hurst exponents",
    tolerance=0.25,
    assumption=True,
    reason="Fig. 2 shows one curve for each H if its combinations lie closer together than a quarter of the distance "
    "to the next H",
    remark="The collapse also follows from the equations, so that this tests the computation rather than the physics.",
    figure="fig2_kinetics",
)
def collapse(evidence, tolerance):
    """Test whether the curves of one Hurst exponent collapse for all combinations of physical parameters.

    A combination consists of force, viscosity, size and rms height. The value is the ratio of two scatters of ln(vt/h)
    at one X: the scatter between combinations, divided by the scatter between Hurst exponents. The X is the geometric
    mean of the ends of region (b) of all Hurst exponents. The least and the largest result for a single Hurst exponent
    are stated as well; they are poorly determined, because a single Hurst exponent has few combinations.

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
    sets = [
        [np.log(ensemble["velocity"].values[:, nearest]) for ensemble in ensembles]
        for ensembles in evidence.combinations.values()
    ]
    between_hursts = np.std([np.mean(np.concatenate(groups)) for groups in sets], ddof=1)
    *values, _ = np.sqrt(excess_variance(sets)) / between_hursts
    single = [np.sqrt(excess_variance([groups])[0]) / between_hursts for groups in sets]
    number = min(sum(np.isfinite(group).sum() for group in groups) for groups in sets)
    context = {"realizations": number, "extremes": (min(single), max(single))}
    yield evidence.case("all H", values, np.nan, (-np.inf, tolerance), **context)


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


@claim(
    title="curves of smooth surfaces (large H) are the first to leave their initial line",
    sentence="the curves separate when the contact area starts to increase, first for surfaces with high Hurst "
    "exponents",
    where="Sec. III, region (b)",
    kind="own",
    quantity="X at which the mean stiffness is twice that of one element, over the same of the next larger H",
    criterion="the ratio is above 1",
    tolerance=0.0,
    reason="first is first by any amount that the interval can tell",
    figure="fig2_kinetics",
    readings=True,
)
def separation(evidence, tolerance):
    """Test whether curves of larger Hurst exponents leave region (a) at smaller X (dimensionless force).

    The claim is tested for each pair of neighbouring Hurst exponents. The tested value is the X at which region (a)
    ends for the smaller exponent, divided by the X at which it ends for the larger exponent. Region (a) ends where the
    geometric mean of κ reaches `LEFT_REGION` times κ of a single element.
    """
    ends, last = {}, np.log(LEFT_REGION * reference.one_element_stiffness(evidence.across))
    for i, (hurst, ensemble) in enumerate(evidence.pooled.items()):
        stiffness = np.log(ensemble["stiffness"].values)
        stiffness = stiffness[:, np.isfinite(stiffness).all(axis=0)]
        # Each ensemble has a different seed, so that the bootstrap samples of the ensembles are independent.
        means = resampled_means(stiffness, evidence.resamples, np.random.default_rng([evidence.seed, i]))
        log_x = np.log(ensemble["x"].values[: means.shape[1]])
        # Values of ln X at the end of region (a), first for the ensemble, then for its resamples. Values are nan for
        # curves that do not reach this end.
        ends[hurst] = np.array([np.interp(last, mean, log_x, left=np.nan, right=np.nan) for mean in means])
    for lower, higher in pairwise(ends):
        ratios = np.exp(ends[lower] - ends[higher])
        realizations = min(evidence.pooled[hurst].sizes["realization"] for hurst in (lower, higher))
        values, counts = with_interval(ratios, realizations), {"realizations": realizations, "cases": len(ends) - 1}
        yield evidence.case(f"H = {lower:g} over H = {higher:g}", values, np.nan, (1 + tolerance, np.inf), **counts)


@claim(
    title="the middle part of the curves is nearly a power of time",
    sentence="with a few contact spots, region (b), the curves are “nearly linear” in double logarithmic axes, so "
    "that a power law is applicable",
    where="Sec. III, region (b); Eq. 9",
    kind="own",
    quantity="half the spread of the local slope d ln(vt/h)/d ln X within region (b)",
    criterion="the local slopes, fitted to data of region (b) alone, lie within ± the tolerance of their mid-range",
    tolerance=NEARLY_LINEAR,
    reason="half the smallest distance between the exponents H/(1 + H) of two Hurst exponents of the paper, 0.09; "
    "with more, the slope of a curve does not tell its H. The bound was set with the curves in view",
    figure="regions",
    readings=True,
    remark="Region (b) is short, and the test does not exclude a bend: the next claim applies it to a control. Slopes "
    "are fitted wholly inside region (b), so that they do not reach its ends.",
)
def power_law(evidence, tolerance):
    """Test whether the slope of ln(vt/h) along ln X is constant in region (b) (viscorough_study.fits.local_slope).

    The claim is tested for each Hurst exponent. It says nothing about a power law beyond region (b), which is too short
    to tell a power law from a bend (see `power_law_control`).
    """
    return _spreads(evidence, evidence.of_discs("local_slope"), (-np.inf, tolerance))


@claim(
    title="this test tells a power law from a bend",
    sentence="the same test rejects surfaces without long waves, whose curves follow no power law: it tells a power "
    "law from a bend",
    where="Sec. III, region (b); Eq. 9",
    kind="beyond",
    quantity="half the spread of the local slope within region (b), of discs without long waves",
    criterion="the local slopes do not lie within ± the tolerance of their mid-range",
    tolerance=NEARLY_LINEAR,
    reason="the tolerance of the claim that region (b) is nearly linear",
    figure="regions",
    remark="At an H at which the control lies within the tolerance as well, region (b) is too short to tell them "
    "apart.",
)
def power_law_control(evidence, tolerance):
    """Test whether the criterion of `power_law` rejects discs without long waves, at each Hurst exponent."""
    table = evidence.tables["local_slope"]
    table = table[table["group"] == CONTROL]
    if table.empty:
        yield judged("no control", UNDEFINED, np.nan, None)
    yield from _spreads(evidence, table, (tolerance, np.inf))


def _spreads(evidence, table, allowed):
    """Test whether half the spread of the local slopes lies in the allowed range; yield a case for each row."""
    for row in table.to_dict("records"):
        context = {"realizations": row["realizations"], "cases": len(table)}
        name, note = hurst_name(row["hurst"]), f"a straight line misses by {100 * row['line_residual']:.1f} %"
        yield evidence.case(name, interval(row, "half_spread"), np.nan, allowed, note=note, **context)


@claim(
    title="depth and force start together on the power law",
    sentence="u/h = X^(1 − α)/(ζ(1 − α)), which assumes that depth and force vanish together on the power law",
    where="Eq. 6",
    kind="own",
    quantity="(1 − α)κu/(hX) at the centre of region (b)",
    criterion="(1 − α)κu/(hX) is 1 within the tolerance at the centre of region (b)",
    tolerance=0.1,
    reason="the prefactor enters Eq. 6; the paper states no precision, and ≈ in Eqs. 4 and 11 is read as within a "
    "tenth",
    figure="fig3_master_curve",
    readings=True,
)
def depth(evidence, tolerance):
    """Test whether (1 − α)κu/(hX) is 1 at the centre of region (b), as it is if the stiffness κ is a power law κ ∝ X^α.

    The claim is tested for each Hurst exponent. The depth is u/h = ∫dX/κ, where κ is constant below the first abscissa.
    """
    bootstrap = {"average": evidence.conventions["average"], "resamples": evidence.resamples, "seed": evidence.seed}
    for hurst, ensemble in evidence.pooled.items():
        if (window := evidence.regions[hurst]) is None:
            yield judged(hurst_name(hurst), UNDEFINED, 1.0, None)
            continue
        x, softness = ensemble["x"].values, 1 / ensemble["stiffness"].values
        betas, _ = fit_power_law(x, ensemble["velocity"].values, window, **bootstrap)
        end = int(np.argmin(np.abs(np.log(x / np.sqrt(np.prod(window)))))) + 1
        depths = x[0] * softness[:, 0] + np.trapezoid(softness[:, :end], x[:end], axis=1)
        ratios = (depths / (x[end - 1] * softness[:, end - 1]))[:, None]
        # With the seed of the fit, the same realizations are drawn as for `betas`. The interval of the product
        # therefore includes the scatter of both factors.
        random = np.random.default_rng(evidence.seed)
        products = betas * np.exp(log_means(ratios, "arithmetic", evidence.resamples, random))[:, 0]
        number = ensemble.sizes["realization"]
        counts = {"realizations": number, "cases": len(evidence.pooled)}
        ends = (1 - tolerance, 1 + tolerance)
        yield evidence.case(hurst_name(hurst), with_interval(products, number), 1.0, ends, **counts)


@claim(
    title="in the end all curves become one line",
    sentence="at large indentation depths all curves collapse to one line of slope 1",
    where="Sec. III, region (c)",
    kind="own",
    quantity="at the end of the curves, Xh/(vt) (prefactor) and d ln(vt/h)/d ln X (slope)",
    criterion="slope and Xh/(vt) at the end of the curves are 1 within the tolerance",
    tolerance=0.05,
    assumption=True,
    reason="5 % is 0.02 decades, less than the width of a line in Fig. 2, where all curves become one line. It was "
    "0.03 at first; the verdict is the same",
    figure="regions",
)
def last_region(evidence, tolerance):
    """Test whether curves in region (c) are the line of slope 1 that a flat punch has, for each Hurst exponent.

    The tested values are κ at the largest X that all curves reach, which is expected to be κ of complete contact, and
    the mean slope over the last `END_DECADES` decades up to this X.
    """
    paper_slope = evidence.paper_value("regions", "slope_last")
    for hurst, ensemble in evidence.whole.items():
        x, stiffness = ensemble["x"].values, ensemble["stiffness"].values
        reached = _reached_by_all(ensemble)
        reached = reached[x[reached] >= x[reached].max(initial=0.0) / 10**END_DECADES]
        if reached.size < 2:
            for name in ("prefactor", "slope"):
                yield judged(f"{hurst_name(hurst)}, {name}", UNDEFINED, np.nan, None)
            continue
        end, last = reached[[0, -1]]
        velocity = ensemble["velocity"].values[:, end : last + 1]
        slopes = np.polyfit(np.log(x[end : last + 1]), np.log(velocity).T, 1)[0]
        complete = reference.COMPLETE_CONTACT_STIFFNESS
        for name, samples, expected in (("prefactor", stiffness[:, last], complete), ("slope", slopes, paper_slope)):
            ends, counts = (expected - tolerance, expected + tolerance), {"cases": 2 * len(evidence.whole)}
            yield _mean_case(evidence, f"{hurst_name(hurst)}, {name}", samples, expected, ends, **counts)


@claim(
    title="on this final line, region (c), contact is almost complete",
    sentence="region (c), where all curves have the slope 1, corresponds to an “almost complete” contact",
    where="Sec. III, region (c)",
    kind="own",
    quantity="share of the elements in contact where region (c) begins",
    criterion="from the X on where the local slope of the mean curve is 1 within 0.05, and where it is 1 within 0.01, "
    "the share of the elements in contact is 1 within the tolerance",
    tolerance=0.1,
    assumption=True,
    reason="almost complete says at least nine tenths. Which deviation from the slope 1 is visible in Fig. 2 is "
    "assumed, so that two are tested",
    figure="regions",
    remark="These are the shares where region (c) begins; more elements touch later, and the shares at the end of the "
    "curves are stated as well. The rough interface and the body "
    "behind it act as two springs in series, and the body decides the slope long before all elements touch.",
)
def complete_contact(evidence, tolerance):
    """Test whether the contact is almost complete where region (c) begins, by the mean contact fraction.

    Region (c) begins at the X from which on the slope of ln(vt/h) along ln X is 1 within a deviation. The claim is
    tested for each of `SLOPES_OF_LINE` and each Hurst exponent. A case whose curve does not reach this slope is
    undecided.
    """
    for deviation in SLOPES_OF_LINE:
        for hurst, ensemble in evidence.whole.items():
            name = f"{hurst_name(hurst)}, slope 1 within {deviation:g}"
            if (first := start_of_line(ensemble, deviation)) is None:
                yield judged(name, UNDEFINED, np.nan, None)
                continue
            shares, x = ensemble["contact_count"].values / ensemble["elements"].item(), ensemble["x"].values
            last = _reached_by_all(ensemble)[-1]
            note = f"from X = {x[first]:.3g} on; {shares[:, last].mean():.2f} at X = {x[last]:.3g}"
            more = {"cases": len(SLOPES_OF_LINE) * len(evidence.whole), "note": note}
            yield _mean_case(evidence, name, shares[:, first], np.nan, (1 - tolerance, np.inf), **more)


def start_of_line(ensemble, deviation):
    """Return the index of the X from which on the slope of ln(vt/h) along ln X is 1 within a deviation.

    ensemble : ensemble dataset (ensembles.averages) with a single definition of the rms height, of whose geometric mean
        the slope is taken, where all curves are defined
    Returns None for a curve that does not reach this slope.
    """
    x, defined = ensemble["x"].values, _reached_by_all(ensemble)
    log_x, mean = np.log(x[defined]), np.log(ensemble["velocity_geometric"].values[defined])
    inner, (slopes,) = inner_slopes(log_x, mean[None], DECADES_OF_SLOPE * np.log(10))
    below = np.flatnonzero(slopes < 1 - deviation)
    if not below.size or below[-1] + 1 == slopes.size:
        return None
    return int(np.argmin(np.abs(np.log(x) - inner[below[-1] + 1])))


def _reached_by_all(ensemble):
    """Return the indices of the abscissae that all curves reach."""
    return np.flatnonzero(ensemble["fraction_defined"].values == 1)


def _mean_case(evidence, name, samples, expected, allowed, **more):
    """Judge whether the mean of a quantity over the realizations of an ensemble is in the allowed range.

    name, expected : see `Evidence.case`; samples : quantity for each realization. The least and the largest sample are
        stated as well
    allowed : (low, high); more : arguments `cases` and `note` of `Evidence.case`
    """
    more |= {"realizations": samples.size, "extremes": (samples.min(), samples.max())}
    return evidence.case(name, mean_with_interval(samples), expected, allowed, **more)
