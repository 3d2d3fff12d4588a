"""What claims are judged by: for each a quantity with its interval, and whether that meets the criterion.

Whoever draws other surfaces gets other numbers, and a verdict must not depend on the draw: with a 95 % interval the
claim fails where the whole interval lies outside what the tolerance allows, and cannot be tested where the interval is
much wider than that. Where a claim fails under the conventions shown but holds under others that the paper leaves open,
the verdict says so, and under which.

A judge is a function of the evidence (claims.Evidence) and the tolerance; it returns rows as `_row` makes them.
"""

from itertools import product

import numpy as np
from scipy import stats

from viscorough import reference
from viscorough.surfaces import cut_disc
from viscorough_study.ensembles import combine
from viscorough_study.power_law import fit_power_law

VERDICTS = ("reproduced", "reproduced under a stated convention", "not reproduced", "not testable")
SAID_ABOVE = 0.4  # Hurst exponent above which the paper says that β = H/(1 + H)
WIDE = 2.0  # width of an interval, over that of the allowed range, beyond which it tells nothing
CONVENTIONS = ["rms_convention", "average", "window_rule", "gamma", "diameter_convention"]


def _row(case, value, low, high, expected, met, convention=""):
    """One case; met : whether the criterion is, None where it cannot be said."""
    if met is None or not np.isfinite(value):
        return case, value, low, high, expected, "not testable", ""
    verdict = VERDICTS[0] if met else VERDICTS[1] if convention else VERDICTS[2]
    return case, value, low, high, expected, verdict, "" if met else convention


def _within(low, high, allowed_low, allowed_high):
    """Whether a value with its 95 % interval may lie in a range; None where the interval is too wide to tell."""
    if low > allowed_high or high < allowed_low:
        return False
    return True if high - low <= WIDE * (allowed_high - allowed_low) else None


def _hurst(hurst):
    return f"H = {hurst:g}"


# ---- form and regions


def _collapse(evidence, tolerance):
    """Scatter of ln(vt/h) over combinations, over that between Hurst exponents, at one X in all regions (b).

    That of combinations is without what their few realizations would scatter anyhow: the component of variance between
    them, with its interval from the F distribution (analysis of variance). Where the realizations are so few that their
    means scatter by more than the tolerance, nothing can be told.
    """
    found = {hurst: evidence.pooled(hurst) for hurst in evidence.discs}
    windows = [window for _, window in found.values() if window is not None]
    if len(windows) < 2 or len(windows) < len(found):
        return [_row(_hurst(hurst), np.nan, np.nan, np.nan, np.nan, None) for hurst in found]
    x = next(iter(found.values()))[0]["x"].values
    at = int(np.argmin(np.abs(np.log(x) - np.mean(np.log(windows)))))
    logs = {
        hurst: [
            np.log(each.sel(rms_convention=evidence.shown["rms_convention"])["velocity"].values[:, at])
            for each in ensembles
        ]
        for hurst, ensembles in evidence.discs.items()
    }
    between = np.std([np.mean(np.concatenate(each)) for each in logs.values()], ddof=1)
    rows = []
    for hurst, each in logs.items():
        *ratio, of_realizations = np.sqrt(_excess_variance(each)) / between
        met = bool(ratio[1] <= tolerance) if of_realizations <= tolerance else None
        rows.append(_row(_hurst(hurst), *ratio, np.nan, met))
    return rows


def _excess_variance(groups):
    """Variance between groups beyond what scatter within makes of their means: median, 95 % interval, at least 0.

    And that of their means by the scatter within.
    """
    groups = [each[np.isfinite(each)] for each in groups]
    size = np.mean([each.size for each in groups])
    freedom = len(groups) - 1, sum(each.size - 1 for each in groups)
    if min(freedom) < 1:
        return np.full(4, np.nan)
    within = sum(each.size * each.var() for each in groups) / freedom[1]
    ratio = size * np.var([each.mean() for each in groups], ddof=1) / within
    excess = np.maximum(ratio / stats.f.ppf([0.5, 0.975, 0.025], *freedom) - 1, 0.0)
    return np.append(excess, 1.0) * within / size


def _first_region(evidence, tolerance):
    """κ while one element touches, over π/(K₀₀ n)."""
    rows = []
    for hurst, ensembles in evidence.discs.items():
        mean = combine(ensembles).sel(rms_convention=evidence.shown["rms_convention"])
        alone = mean["contact_count"].values <= 1 + 1e-9
        ratio = mean["stiffness"].values[alone] / reference.one_element_stiffness(evidence.across)
        bounds = (np.median(ratio), ratio.min(), ratio.max()) if ratio.size else (np.nan,) * 3
        met = bool(np.all(np.abs(ratio - 1) <= tolerance)) if ratio.size else None
        rows.append(_row(_hurst(hurst), *bounds, 1.0, met))
    return rows


def _last_region(evidence, tolerance):
    """Xh/(vt), which is κ, and the slope of vt/h where curves end."""
    rows = []
    for hurst, ensembles in evidence.discs.items():
        mean = combine(ensembles).sel(rms_convention=evidence.shown["rms_convention"])
        whole = np.flatnonzero(mean["fraction_defined"].values == 1)
        last = mean["stiffness"].values[:, whole[-1]]
        spread = last.mean(), last.min(), last.max()
        rows.append(_row(f"{_hurst(hurst)}, prefactor", *spread, 1.0, abs(spread[0] - 1) <= tolerance))
        end = mean["x"].values >= mean["x"].values[whole[-1]] / 10**0.25
        end[whole[-1] + 1 :] = False
        log_x = np.log(mean["x"].values[end])
        slopes = np.polyfit(log_x, np.log(mean["velocity"].values[:, end]).T, 1)[0]
        spread = slopes.mean(), slopes.min(), slopes.max()
        rows.append(_row(f"{_hurst(hurst)}, slope", *spread, 1.0, abs(spread[0] - 1) <= tolerance))
    return rows


def _power_law(evidence, tolerance):
    """Deviation of ln(vt/h) from a straight line, and the decades of region (b)."""
    rows = []
    for hurst, fit in evidence.fits("discs").iterrows():
        deviation, decades = fit["residual"], fit["decades"]
        testable = np.isfinite(deviation)
        rows.append(
            _row(f"{_hurst(hurst)}, deviation", deviation, 0.0, deviation, np.nan, deviation <= tolerance)
            if testable
            else _row(f"{_hurst(hurst)}, deviation", np.nan, np.nan, np.nan, np.nan, None)
        )
        span = (decades, np.log10(fit["x_low"]), np.log10(fit["x_high"])) if testable else (0.0, np.nan, np.nan)
        rows.append(_row(f"{_hurst(hurst)}, decades (log₁₀X from, to)", *span, np.nan, bool(decades >= 1)))
    return rows


# ---- exponents and prefactors


def _against_law(evidence, source, column, law, tolerance, *, relative=False, above=-1.0, **conventions):
    """Rows of a fitted quantity against a law, at the Hurst exponents for which it is said.

    conventions : those that the claim fixes. Where it fails under the others as shown, the convention is named under
    which all Hurst exponents meet the law, with the least deviation.
    """

    def deviations(table):
        table = table[table.index > above]
        expected = law(table.index.to_numpy())
        return np.abs(table[column] - expected) / (expected if relative else 1)

    fits = evidence.fits(source, **conventions)
    shown, best, least = deviations(fits), "", tolerance
    open_ones = evidence.scaling[(evidence.scaling["source"] == source) & (evidence.scaling["case_group"] == "base")]
    for name, value in conventions.items():
        open_ones = open_ones[open_ones[name] == value]
    for values, table in open_ones.groupby(CONVENTIONS, sort=False):
        found = deviations(table.set_index("hurst").sort_index())
        if len(found) == len(shown) and found.notna().all() and found.max() <= least:
            named = zip(CONVENTIONS, values, strict=True)
            best, least = ", ".join(f"{name} {value}" for name, value in named), found.max()
    rows = []
    for hurst in shown.index:
        interval = fits.loc[hurst, [column, f"{column}_low", f"{column}_high"]]
        margin = tolerance * (law(hurst) if relative else 1)
        met = _within(*interval[1:], law(hurst) - margin, law(hurst) + margin)
        rows.append(_row(_hurst(hurst), *interval, law(hurst), met, best))
    return rows


def _beta(evidence, tolerance, source="discs"):
    return _against_law(evidence, source, "beta", reference.exponent_beta, tolerance, above=SAID_ABOVE)


def _beta_lines(evidence, tolerance):
    return _beta(evidence, tolerance, "lines")


def _coincide(evidence, tolerance):
    """β of lines less β of discs, under the conventions shown and under those with the least difference."""

    def differences(conventions):
        one, other = (evidence.fits(source, **conventions) for source in ("discs", "lines"))
        return one, other.reindex(one.index), other["beta"].reindex(one.index) - one["beta"]

    discs, lines, shown = differences({})
    best, least = "", tolerance
    names = CONVENTIONS[:3]  # the others change no exponent
    for values in product(*(evidence.scaling[name].unique() for name in names)):
        conventions = dict(zip(names, values, strict=True))
        found = np.abs(differences(conventions)[2])
        if len(found) == len(shown) and found.notna().all() and found.max() <= least:
            best, least = ", ".join(f"{name} {value}" for name, value in conventions.items()), found.max()
    rows = []
    for hurst, difference in shown.items():
        one, other = discs.loc[hurst], lines.loc[hurst]
        below = np.hypot(other["beta"] - other["beta_low"], one["beta_high"] - one["beta"])
        above = np.hypot(other["beta_high"] - other["beta"], one["beta"] - one["beta_low"])
        bounds = difference - below, difference + above
        met = _within(*bounds, -tolerance, tolerance)
        rows.append(_row(_hurst(hurst), difference, *bounds, 0.0, met, best))
    return rows


def _zeta_elastic(evidence, tolerance):
    law = reference.zeta_elastic
    return _against_law(evidence, "discs", "zeta", law, tolerance, relative=True, gamma="without")


def _zeta_viscous(evidence, tolerance):
    """Eq. 11 was found with Eq. 9, which has the factor."""
    law = reference.zeta_viscous
    return _against_law(evidence, "discs", "zeta", law, tolerance, relative=True, gamma="with")


def _at_centre(evidence, tolerance, quantity):
    """Rows of a quantity that should be 1 at the geometric centre of region (b); not testable without a region.

    quantity : function of H, ensemble, fit of region (b) and centre; gives the value and its 95 % interval
    """
    how = {"average": evidence.shown["average"], "resamples": evidence.resamples, "seed": evidence.seed}
    rows = []
    for hurst in evidence.discs:
        mean, window = evidence.pooled(hurst)
        if window is None:
            rows.append(_row(_hurst(hurst), np.nan, np.nan, np.nan, 1.0, None))
            continue
        fit = fit_power_law(mean["x"].values, mean["velocity"].values, window, **how)
        value, *interval = quantity(hurst, mean, fit, np.sqrt(np.prod(window)))
        rows.append(_row(_hurst(hurst), value, *interval, 1.0, _within(*interval, 1 - tolerance, 1 + tolerance)))
    return rows


def _depth(evidence, tolerance):
    """(1 - α)κu/(hX) at the centre, where u/h = ∫dX/κ, κ constant below the first abscissa."""

    def ratio(hurst, mean, fit, centre):
        x, softness = mean["x"].values, 1 / mean["stiffness"].values
        upto = int(np.argmin(np.abs(np.log(x / centre)))) + 1
        depth = x[0] * softness[:, 0] + np.trapezoid(softness[:, :upto], x[:upto], axis=1)
        found = fit.beta * depth / (x[upto - 1] * softness[:, upto - 1])
        error = 1.96 * found.std(ddof=1) / np.sqrt(found.size)
        return found.mean(), found.mean() - error, found.mean() + error

    return _at_centre(evidence, tolerance, ratio)


def _gamma(evidence, tolerance):
    """Depth of direct integrations over the elastic depth at the force GI/η; the factor would be in it."""
    rows = []
    for case, part in evidence.direct.groupby("case", sort=False):
        ratio, expected = part["depth_ratio"], part["with_gamma"].iloc[0]
        met = bool((np.abs(ratio - expected) <= tolerance).all())
        rows.append(_row(case, ratio.median(), ratio.min(), ratio.max(), expected, met))
    return rows


def _master_curve(evidence, tolerance):
    """vt/h over the right side of Eq. 12 as printed, at the centre of region (b)."""

    def ratio(hurst, mean, fit, centre):
        law = reference.rate_law(centre, hurst, gamma=True)
        samples = fit.prefactor_samples * centre**fit.beta_samples / law
        return fit.prefactor * centre**fit.beta / law, *np.quantile(samples, [0.025, 0.975])

    return _at_centre(evidence, tolerance, ratio)


# ---- reduction of dimensionality


def _line_spectrum(evidence, tolerance):
    """λ, which is π if the line needs no correction."""
    fits = evidence.fits("discs")[["lambda", "lambda_low", "lambda_high"]]
    excluded = (fits["lambda_low"] > np.pi) | (fits["lambda_high"] < np.pi)
    differs = excluded & (np.abs(fits["lambda"] / np.pi - 1) > tolerance)
    return [_row(_hurst(hurst), *values, np.pi, differs.any()) for hurst, values in fits.iterrows()]


def _bodies_of_revolution(evidence, tolerance):
    """Largest error of the reduction on the finest grid, and on the coarsest."""
    table = evidence.validation[evidence.validation["case"].str.endswith("_reduction")]
    rows = []
    for (case, quantity), part in table.groupby(["case", "quantity"], sort=False):
        error = part.sort_values("elements")["error"]
        body = case.removesuffix("_reduction")
        bounds = error.iloc[-1], error.min(), error.max()
        # The stiffness counts points, so that it is as exact as the line is fine.
        met = error.iloc[-1] <= (tolerance if quantity == "depth" else 2 / part["elements"].max())
        rows.append(_row(f"{body}, {quantity}", *bounds, 0.0, met))
    return rows


def _elements(evidence, tolerance):
    count = np.isfinite(cut_disc(np.zeros((257, 257)), 257)).sum()
    return [_row("257 across", count, count, count, 51432, abs(count - 51432) <= tolerance)]


def _computing_time(evidence, tolerance):
    """Contact events of one indentation, to the end of the curves: one contact problem each for explicit steps."""
    ensembles = [each.isel(rms_convention=0) for every in evidence.discs.values() for each in every]
    counts = np.concatenate([each["contact_count"].max("abscissa").values for each in ensembles])
    bounds = np.median(counts), counts.min(), counts.max()
    return [("events of an indentation", *bounds, np.nan, "not testable", "")]


JUDGES = {
    "collapse": _collapse,
    "first_region": _first_region,
    "last_region": _last_region,
    "power_law": _power_law,
    "beta": _beta,
    "beta_lines": _beta_lines,
    "coincide": _coincide,
    "depth": _depth,
    "zeta_elastic": _zeta_elastic,
    "zeta_viscous": _zeta_viscous,
    "gamma": _gamma,
    "master_curve": _master_curve,
    "line_spectrum": _line_spectrum,
    "bodies_of_revolution": _bodies_of_revolution,
    "elements": _elements,
    "computing_time": _computing_time,
}
