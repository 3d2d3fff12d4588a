"""Criteria of claims that fitted exponents and prefactors follow a law of the paper.

Where a claim fails in the conventions of the figures but holds in others that the paper leaves open, the verdict says
so, and names the conventions with the smallest deviation.
"""

from functools import partial
from itertools import product

import numpy as np

from viscorough import reference
from viscorough_study.conventions import FITTED, NAMES, in_every_reading, left_open
from viscorough_study.evidence import judged
from viscorough_study.power_law import fit_power_law


def hurst_name(hurst):
    """Name of the case of a Hurst exponent."""
    return f"H = {hurst:g}"


def law_cases(evidence, tolerance, *, source, column, law, relative=False, above=-1.0, **fixed):
    """Cases of a fitted quantity against a law, one for each Hurst exponent above the given one.

    source : "discs" or "lines"; column : of the table of fits; law : function of H
    tolerance : of the deviation, relative to the law or absolute; fixed : conventions that the claim itself fixes
    """
    fits = evidence.fits(source, **fixed)
    fits = fits[fits.index > above]
    deviation = partial(_deviations, column=column, law=law, relative=relative, above=above)
    convention = _nearest_convention(evidence.scaling, source, fixed, deviation, fits.index, tolerance)
    cases = []
    for hurst, fit in fits.iterrows():
        values = fit[[column, f"{column}_low", f"{column}_high"]].tolist()
        margin = tolerance * (law(hurst) if relative else 1)
        met = evidence.may_lie_within(values[1:], law(hurst) - margin, law(hurst) + margin)
        cases.append(judged(hurst_name(hurst), values, law(hurst), met, convention))
    return cases


def _deviations(fits, *, column, law, relative, above):
    """|value − law|, or that over the law, for each Hurst exponent of fits by H."""
    fits = fits[fits.index > above]
    expected = law(fits.index.to_numpy())
    return np.abs(fits[column] - expected) / (expected if relative else 1)


def _nearest_convention(scaling, source, fixed, deviation, hursts, tolerance):
    """Conventions in words for which every Hurst exponent meets the law, with the smallest deviation; "" if none."""
    fits = left_open(in_every_reading(scaling[(scaling["source"] == source) & (scaling["case_group"] == "base")]))
    for name, value in fixed.items():
        fits = fits[fits[name] == value]
    nearest, smallest = "", tolerance
    for values, group in fits.groupby(NAMES, sort=False):
        deviations = deviation(group.set_index("hurst").sort_index())
        if _meets_everywhere(deviations, hursts, smallest):
            nearest, smallest = _in_words(dict(zip(NAMES, values, strict=True))), deviations.max()
    return nearest


def _meets_everywhere(deviations, hursts, limit):
    """Whether there is a deviation for each Hurst exponent and none exceeds the limit."""
    return len(deviations) == len(hursts) and deviations.notna().all() and deviations.max() <= limit


def _in_words(conventions):
    return ", ".join(f"{name} {value}" for name, value in conventions.items())


# ---- exponents


def beta(evidence, tolerance, source="discs"):
    """β against H/(1 + H), at the Hurst exponents above which the paper says that it holds."""
    above = evidence.said("agreement", "beta_hurst_min")
    law = reference.exponent_beta
    return law_cases(evidence, tolerance, source=source, column="beta", law=law, above=above)


def beta_lines(evidence, tolerance):
    """β of lines against H/(1 + H)."""
    return beta(evidence, tolerance, "lines")


def coincide(evidence, tolerance):
    """β of lines minus β of discs, with the conventions in which the difference is smallest."""
    discs, lines = _discs_and_lines(evidence, {})
    differences = lines["beta"] - discs["beta"]
    convention = _nearest_to_coincidence(evidence, differences.index, tolerance)
    cases = []
    for hurst, difference in differences.items():
        disc, line = discs.loc[hurst], lines.loc[hurst]
        below = np.hypot(line["beta"] - line["beta_low"], disc["beta_high"] - disc["beta"])
        above = np.hypot(line["beta_high"] - line["beta"], disc["beta"] - disc["beta_low"])
        interval = difference - below, difference + above
        met = evidence.may_lie_within(interval, -tolerance, tolerance)
        cases.append(judged(hurst_name(hurst), (difference, *interval), 0.0, met, convention))
    return cases


def _discs_and_lines(evidence, conventions):
    """Fits of discs, and of lines at the same Hurst exponents."""
    discs, lines = (evidence.fits(source, **conventions) for source in ("discs", "lines"))
    return discs, lines.reindex(discs.index)


def _nearest_to_coincidence(evidence, hursts, tolerance):
    """Conventions in words in which discs and lines coincide best at every Hurst exponent; "" if none do."""
    nearest, smallest = "", tolerance
    for values in product(*(evidence.scaling[name].unique() for name in FITTED)):
        conventions = dict(zip(FITTED, values, strict=True))
        discs, lines = _discs_and_lines(evidence, conventions)
        differences = np.abs(lines["beta"] - discs["beta"])
        if _meets_everywhere(differences, hursts, smallest):
            nearest, smallest = _in_words(conventions), differences.max()
    return nearest


# ---- prefactors


def zeta_elastic(evidence, tolerance):
    """ζ against Eq. 4, which is a law of the elastic contact, without the factor."""
    return _zeta(evidence, tolerance, law=reference.zeta_elastic, gamma="without")


def zeta_viscous(evidence, tolerance):
    """ζ against Eq. 11, which the paper fitted with Eq. 9, which has the factor."""
    return _zeta(evidence, tolerance, law=reference.zeta_viscous, gamma="with")


def _zeta(evidence, tolerance, *, law, gamma):
    return law_cases(evidence, tolerance, source="discs", column="zeta", law=law, relative=True, gamma=gamma)


def depth(evidence, tolerance):
    """(1 − α)κu/(hX) at the centre, where u/h = ∫dX/κ, with κ constant below the first abscissa."""

    def ratio(hurst, ensemble, fit, centre):
        x, softness = ensemble["x"].values, 1 / ensemble["stiffness"].values
        end = int(np.argmin(np.abs(np.log(x / centre)))) + 1
        depths = x[0] * softness[:, 0] + np.trapezoid(softness[:, :end], x[:end], axis=1)
        ratios = fit.beta * depths / (x[end - 1] * softness[:, end - 1])
        error = 1.96 * ratios.std(ddof=1) / np.sqrt(ratios.size)
        return ratios.mean(), ratios.mean() - error, ratios.mean() + error

    return _cases_at_centre(evidence, tolerance, ratio)


def master_curve(evidence, tolerance):
    """vt/h over the right side of Eq. 12 as printed."""

    def ratio(hurst, ensemble, fit, centre):
        law = reference.rate_law(centre, hurst, gamma=True)
        samples = fit.prefactor_samples * centre**fit.beta_samples / law
        return fit.prefactor * centre**fit.beta / law, *np.quantile(samples, [0.025, 0.975])

    return _cases_at_centre(evidence, tolerance, ratio)


def _cases_at_centre(evidence, tolerance, ratio):
    """Cases of a ratio that should be 1 at the geometric centre of region (b); not testable without a region.

    ratio : function of H, ensemble, fit of region (b) and centre; returns the value and its 95 % interval
    """
    bootstrap = {"average": evidence.conventions["average"], "resamples": evidence.resamples, "seed": evidence.seed}
    cases = []
    for hurst, ensemble in evidence.pooled.items():
        window = evidence.regions[hurst]
        if window is None:
            cases.append(judged(hurst_name(hurst), (np.nan,) * 3, 1.0, None))
            continue
        fit = fit_power_law(ensemble["x"].values, ensemble["velocity"].values, window, **bootstrap)
        values = ratio(hurst, ensemble, fit, np.sqrt(np.prod(window)))
        met = evidence.may_lie_within(values[1:], 1 - tolerance, 1 + tolerance)
        cases.append(judged(hurst_name(hurst), values, 1.0, met))
    return cases
