"""Judge claims on the prefactor ζ: its value, which of the paper's two formulas fits better, and one common constant.

Eqs. 4 and 11 of the paper belong to a law with the exponent β = H/(1 + H). They are therefore compared with ζ of fits
with this exponent, not with ζ of fits with a free exponent, which describes the curve at X = 1.

The criteria use the tables `scaling` and `zeta_laws` (fits.fit_table and fits.zeta_laws). The paper leaves some choices
(conventions) open, such as the kind of mean, and also some properties of the surfaces. A claim on the value of ζ may
fail in the conventions of the figures but hold in others. The verdict then names the conventions with the smallest
deviation.
"""

import numpy as np

from viscorough import reference
from viscorough_study.fits.conventions import VALUES, in_reading
from viscorough_study.fits.intervals import UNDEFINED
from viscorough_study.fits.zeta_laws import LAST, difference, measure_value
from viscorough_study.verdicts.evidence import Combinations, Law, hurst_name, judged

# Pairs (range of X, measure) of fits.zeta_laws that show which law fits better. The criterion uses the first pair. The
# paper does not state a pair, so it may have meant one of the other pairs.
BETTER = (("region", "deviation"), ("common", "deviation"), ("common", "spread"))
# Constants that reconcile a law with the curves: {text of the case: (measure of the constant, measure of the residual)}
CONSTANTS = {
    "vt/h times": ("common factor", "residual"),
    "X times": ("factor of X", "residual with factor of X"),
}


def zeta_elastic(evidence, tolerance):
    """Test whether the prefactor ζ follows Eq. 4, a law of the elastic contact without the factor 1/Γ(2 − α)."""
    return _absolute(evidence, tolerance, reference.zeta_elastic, "without")


def zeta_viscous(evidence, tolerance):
    """Test whether the prefactor ζ follows Eq. 11, a law that the paper fitted with the factor 1/Γ(2 − α) (Eq. 9)."""
    return _absolute(evidence, tolerance, reference.zeta_viscous, "with")


def _absolute(evidence, tolerance, law, gamma):
    """Test whether the prefactor ζ of fits with β = H/(1 + H) follows a law; yield a verdict for each Hurst exponent.

    If the curve departs from a power law with this exponent by more than the tolerance, ζ is not defined, and the case
    is undecided.

    law : ζ as a function of H
    gamma : "with" or "without", whether ζ is fitted with the factor 1/Γ(2 − α)
    """
    every = in_reading(evidence.every_fit("discs"), gamma).rename(columns={"case_group": "surfaces"})
    own = evidence.fits("discs", gamma=gamma)
    undefined = own["residual_fixed"] > tolerance
    for hurst in own.index[undefined]:
        yield judged(f"{hurst_name(hurst)}, not defined", UNDEFINED, law(hurst), None)
    law, names = Law(law, tolerance, relative=True), [*VALUES, "surfaces"]
    yield from evidence.cases_in_conventions(own[~undefined], every, "zeta_fixed", law, names=names)


def master_curve_shape(evidence, tolerance):
    """Test whether vt/h at equal X follows Eq. 12 up to a factor common to all H.

    The tested value is the spread of ln(vt/h divided by Eq. 12) between Hurst exponents (fits.zeta_laws). It is 0 if
    all curves collapse onto one curve. Yields one verdict for all Hurst exponents, and one verdict for Hurst exponents
    from 0.4 on.
    """
    table = evidence.tables["zeta_laws"]
    counts = {"realizations": table["realizations"].min(), "cases": table["hurst_min"].nunique()}
    for hurst_min in table["hurst_min"].unique():
        values = measure_value(table, "common", LAST, "spread", hurst_min)
        yield evidence.case(_from(hurst_min), values, 0.0, (-np.inf, tolerance), **counts)


def one_constant(evidence, tolerance):
    """Test whether a single constant, for all Hurst exponents that the paper claims, reconciles Eq. 12 with the discs.

    The constant is a factor of vt/h, or a factor of X. The tested value is the root mean square of ln(vt/h) less
    Eq. 12 over region (b) that remains with this constant. The name of the case states the constant.
    """
    table = evidence.tables["zeta_laws"]
    hurst_min = table["hurst_min"].max()
    counts = {"realizations": table["realizations"].min(), "cases": len(CONSTANTS)}
    for text, (constant, residual) in CONSTANTS.items():
        factor, *_ = measure_value(table, "region", LAST, constant, hurst_min)
        values = measure_value(table, "region", LAST, residual, hurst_min)
        name = f"{_from(hurst_min)}, {text} {factor:.3g}"
        yield evidence.case(name, values, 0.0, (-np.inf, tolerance), **counts)


def _from(hurst_min):
    """Return the text for the Hurst exponents that are at least `hurst_min`, for names of cases."""
    return f"H from {hurst_min:g} on" if hurst_min > 0 else "all H"


def zeta_better(evidence, tolerance):
    """Test whether Eq. 11 fits vt/h better than Eq. 4, with the factor 1/Γ(2 − α) in both, as the paper compares them.

    The paper does not say in which sense Eq. 11 fits better. Besides the deviation over region (b) of every Hurst
    exponent, the verdict therefore also takes into account the deviation at the X that all Hurst exponents share, and
    the spread of the curves between Hurst exponents there.
    """
    return _better(evidence, tolerance, "Eq. 4, with Γ")


def zeta_better_elastic(evidence, tolerance):
    """Test whether Eq. 11 with the factor 1/Γ(2 − α) fits vt/h better than Eq. 4 without it (see `zeta_better`)."""
    return _better(evidence, tolerance, "Eq. 4, without Γ")


def _better(evidence, tolerance, law):
    """Test whether Eq. 11 fits vt/h better than another law; yield one verdict for all Hurst exponents.

    The tested value is the deviation of vt/h from the other law minus its deviation from Eq. 11 (fits.zeta_laws). It is
    positive if Eq. 11 fits better. Both laws have the exponent H/(1 + H).

    law : key of fits.zeta_laws.LAWS
    """
    table = evidence.tables["zeta_laws"]
    values, *others = (measure_value(table, of_x, difference(law), measure) for of_x, measure in BETTER)
    combinations = Combinations([values, *others], own="deviation over region (b)")
    context = {"realizations": table["realizations"].min()}
    yield evidence.case_in_combinations("all H", values, np.nan, (tolerance, np.inf), combinations, **context)
