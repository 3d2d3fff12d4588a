"""Judge claims on the prefactor ζ: absolute, up to a factor common to all H, and comparison of laws.

They use the tables `scaling` and `zeta_laws` (fits.fit_table and fits.zeta_laws). If an absolute claim fails in the
conventions of the figures but holds in others that the paper leaves open, including conventions of the surfaces, the
verdict names the conventions with the smallest deviation.
"""

import numpy as np

from viscorough import reference
from viscorough_study.fits.conventions import VALUES, in_reading
from viscorough_study.fits.zeta_laws import difference, measure_value
from viscorough_study.verdicts.evidence import Combinations, Law

# Measures by which one law fits better than another (fits.zeta_laws): the measure of the criterion, and others.
MEASURES = (("curve", "deviation"), ("curve", "spread"), ("zeta", "deviation"), ("zeta", "spread"))


def zeta_elastic(evidence, tolerance):
    """Compare ζ with Eq. 4, a law of the elastic contact without the factor 1/Γ(2 − α)."""
    return _absolute(evidence, tolerance, reference.zeta_elastic, "without")


def zeta_viscous(evidence, tolerance):
    """Compare ζ with Eq. 11, which the paper fitted with Eq. 9, a law with the factor 1/Γ(2 − α)."""
    return _absolute(evidence, tolerance, reference.zeta_viscous, "with")


def _absolute(evidence, tolerance, law, gamma):
    """Return cases of ζ against a law, a function of H, one for each Hurst exponent."""
    every = in_reading(evidence.every_fit("discs"), gamma).rename(columns={"case_group": "surfaces"})
    own, law = evidence.fits("discs", gamma=gamma), Law(law, tolerance, relative=True)
    return evidence.cases_in_conventions(own, every, "zeta", law, names=[*VALUES, "surfaces"])


def zeta_elastic_shape(evidence, tolerance):
    """Return the spread of ζ over Eq. 4 between Hurst exponents, without 1/Γ(2 − α), up to a common factor."""
    return _spreads(evidence, tolerance, "zeta", "Eq. 4, without Γ")


def zeta_viscous_shape(evidence, tolerance):
    """Return the spread of ζ over Eq. 11 between Hurst exponents, with 1/Γ(2 − α), up to a common factor."""
    return _spreads(evidence, tolerance, "zeta", "Eq. 11, with Γ")


def master_curve_shape(evidence, tolerance):
    """Return the spread between Hurst exponents, at the same X, of vt/h over the right side of Eq. 12."""
    return _spreads(evidence, tolerance, "curve", "Eq. 11, with Γ")


def _spreads(evidence, tolerance, quantity, law):
    """Yield cases of the spread, which is 0 if a law holds up to a factor: for all H, and from H = 0.4 on."""
    table = evidence.tables["zeta_laws"]
    counts = {"realizations": table["realizations"].min(), "cases": table["hurst_min"].nunique()}
    for hurst_min in table["hurst_min"].unique():
        name = f"H from {hurst_min:g} on" if hurst_min > 0 else "all H"
        values = measure_value(table, quantity, law, "spread", hurst_min)
        yield evidence.case(name, values, 0.0, (-np.inf, tolerance), **counts)


def zeta_better(evidence, tolerance):
    """Yield the deviation of vt/h from Eq. 4 minus the deviation from Eq. 11; positive if Eq. 11 is better.

    The exponent is H/(1 + H). Both laws are taken with the factor 1/Γ(2 − α), as in the paper, and each in its own
    reading, that is, Eq. 4 without the factor. The paper does not say by which measure the law fits better: the others
    are the spread of the curves over H, and deviation and spread of the fitted ζ.
    """
    table = evidence.tables["zeta_laws"]
    readings = {"Eq. 4, with Γ": "both with Γ", "Eq. 4, without Γ": "Eq. 4 without Γ"}
    context = {"realizations": table["realizations"].min(), "cases": len(readings)}
    for law, reading in readings.items():
        values, *others = (measure_value(table, quantity, difference(law), measure) for quantity, measure in MEASURES)
        combinations = Combinations([values, *others], own="deviation of the curves")
        allowed = (tolerance, np.inf)
        yield evidence.case_in_combinations(f"all H, {reading}", values, np.nan, allowed, combinations, **context)
