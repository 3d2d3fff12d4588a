"""Judge claims on the prefactor ζ: its value, its dependence on H up to a common factor, and which law fits better.

The criteria use the tables `scaling` and `zeta_laws` (fits.fit_table and fits.zeta_laws). The paper leaves some choices
(conventions) open, such as the kind of mean, and also some properties of the surfaces. A claim on the value of ζ may
fail in the conventions of the figures but hold in others. The verdict then names the conventions with the smallest
deviation.
"""

import numpy as np

from viscorough import reference
from viscorough_study.fits.conventions import VALUES, in_reading
from viscorough_study.fits.zeta_laws import difference, measure_value
from viscorough_study.verdicts.evidence import Combinations, Law

# Pairs (quantity, measure) of fits.zeta_laws that show which law fits better, for example the deviation of the curves.
# The criterion uses the first pair. The paper does not state a pair, so it may have meant one of the other pairs.
MEASURES = (("curve", "deviation"), ("curve", "spread"), ("zeta", "deviation"), ("zeta", "spread"))


def zeta_elastic(evidence, tolerance):
    """Test whether the prefactor ζ follows Eq. 4, a law of the elastic contact without the factor 1/Γ(2 − α)."""
    return _absolute(evidence, tolerance, reference.zeta_elastic, "without")


def zeta_viscous(evidence, tolerance):
    """Test whether the prefactor ζ follows Eq. 11, a law that the paper fitted with the factor 1/Γ(2 − α) (Eq. 9)."""
    return _absolute(evidence, tolerance, reference.zeta_viscous, "with")


def _absolute(evidence, tolerance, law, gamma):
    """Test whether the prefactor ζ follows a law; yield a verdict for each Hurst exponent.

    law : ζ as a function of H
    gamma : "with" or "without", whether ζ is fitted with the factor 1/Γ(2 − α)
    """
    every = in_reading(evidence.every_fit("discs"), gamma).rename(columns={"case_group": "surfaces"})
    own, law = evidence.fits("discs", gamma=gamma), Law(law, tolerance, relative=True)
    return evidence.cases_in_conventions(own, every, "zeta", law, names=[*VALUES, "surfaces"])


def zeta_elastic_shape(evidence, tolerance):
    """Test whether the prefactor ζ, without the factor 1/Γ(2 − α), follows Eq. 4 up to a factor common to all H.

    The tested value is the spread of ln(ζ/ζ of Eq. 4) between Hurst exponents (fits.zeta_laws).
    """
    return _spreads(evidence, tolerance, "zeta", "Eq. 4, without Γ")


def zeta_viscous_shape(evidence, tolerance):
    """Test whether the prefactor ζ, with the factor 1/Γ(2 − α), follows Eq. 11 up to a factor common to all H.

    The tested value is the spread of ln(ζ/ζ of Eq. 11) between Hurst exponents (fits.zeta_laws).
    """
    return _spreads(evidence, tolerance, "zeta", "Eq. 11, with Γ")


def master_curve_shape(evidence, tolerance):
    """Test whether vt/h at equal X follows Eq. 12 up to a factor common to all H.

    The tested value is the spread of ln(vt/h divided by Eq. 12) between Hurst exponents (fits.zeta_laws).
    """
    return _spreads(evidence, tolerance, "curve", "Eq. 11, with Γ")


def _spreads(evidence, tolerance, quantity, law):
    """Test whether a law holds up to a factor common to all H: the spread between Hurst exponents is then 0.

    Yields one verdict for all Hurst exponents, and one verdict for Hurst exponents from 0.4 on.
    quantity, law : entries in the columns `quantity` and `law` of the table `zeta_laws`
    """
    table = evidence.tables["zeta_laws"]
    counts = {"realizations": table["realizations"].min(), "cases": table["hurst_min"].nunique()}
    for hurst_min in table["hurst_min"].unique():
        name = f"H from {hurst_min:g} on" if hurst_min > 0 else "all H"
        values = measure_value(table, quantity, law, "spread", hurst_min)
        yield evidence.case(name, values, 0.0, (-np.inf, tolerance), **counts)


def zeta_better(evidence, tolerance):
    """Test whether Eq. 11 fits vt/h better than Eq. 4.

    The tested value is the deviation of vt/h from Eq. 4 minus its deviation from Eq. 11 (fits.zeta_laws). It is
    positive if Eq. 11 fits better. Both laws have the exponent H/(1 + H). There are two verdicts. For the first
    verdict, both laws have the factor 1/Γ(2 − α), as the paper compares them. For the second verdict, Eq. 4 has no such
    factor, as the paper prints it.

    The paper does not say in which sense Eq. 11 fits better. Besides the deviation of the curves, the verdict therefore
    also takes into account the spread of the curves between Hurst exponents, and the deviation and the spread of the
    fitted ζ.
    """
    table = evidence.tables["zeta_laws"]
    readings = {"Eq. 4, with Γ": "both with Γ", "Eq. 4, without Γ": "Eq. 4 without Γ"}
    context = {"realizations": table["realizations"].min(), "cases": len(readings)}
    for law, reading in readings.items():
        values, *others = (measure_value(table, quantity, difference(law), measure) for quantity, measure in MEASURES)
        combinations = Combinations([values, *others], own="deviation of the curves")
        allowed = (tolerance, np.inf)
        yield evidence.case_in_combinations(f"all H, {reading}", values, np.nan, allowed, combinations, **context)
