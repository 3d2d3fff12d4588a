"""Claims on the prefactor ζ of the power law vt/h = X^β/ζ: the paper's two formulas, and the curve of Eq. 12.

Eqs. 4 and 11 of the paper belong to a law with the exponent β = H/(1 + H). They are therefore compared with the curves
and with ζ of fits with this exponent, not with ζ of fits with a free exponent, which describes the curve at X = 1.
"""

import numpy as np

from viscorough import reference
from viscorough_study.fits.intervals import interval
from viscorough_study.fits.zeta_laws import LAST, difference, measure_value
from viscorough_study.verdicts.claim import claim
from viscorough_study.verdicts.evidence import hurst_name

GAMMA = ("with", "without")  # the factor 1/Γ(2 − α) in the law

# Constants that reconcile Eq. 12 with the curves: {case: (measure of the constant, measure of the residual)}
CONSTANTS = {
    "constant on vt/h": ("common factor", "residual"),
    "constant on X": ("factor of X", "residual with factor of X"),
}


@claim(
    title="all surfaces follow one master curve, Eq. 12, with the prefactor of Eq. 11",
    sentence="in region (b) all results collapse to a single “master curve”, the right side of Eq. 12, which contains "
    "the “somewhat different” prefactor ζ “≈” 2 − H of Eq. 11; judged on discs",
    where="Eqs. 11 and 12, Fig. 3",
    kind="own",
    quantity="root mean square of ln(vt/h) less Eq. 12 over region (b)",
    criterion="over region (b) the root mean square of ln(vt/h) less the right side of Eq. 12 is below the tolerance, "
    "at every H",
    tolerance=0.15,
    assumption=True,
    reason="15 % is 0.06 decades, half the size of a symbol of Fig. 3. At first the ratio at the centre of region (b) "
    "was judged; the whole region took its place with the numbers in view, since the paper speaks of the region",
    figure="fig3_master_curve",
    readings=True,
    remark="The paper does not say how its discs were made. Reading B is a sufficient cause of Eq. 12, not a proven "
    "one: nothing printed contradicts it, and nothing says it. No one reading meets this claim and the claim on β at "
    "every H. The law has the factor 1/Γ(2 − α), as printed, which the contact itself does not have (see the claim on "
    "it); the notes state the values without it.",
)
def master_curve(evidence, tolerance):
    """Test whether vt/h of discs follows Eq. 12 as printed, in region (b), for each Hurst exponent.

    The note has the value without the factor 1/Γ(2 − α) in Eq. 12, too.
    """
    cases, others = (follow_equation_12(evidence, tolerance, evidence.fits("discs", gamma)) for gamma in GAMMA)
    for case, other in zip(cases, others, strict=True):
        yield case | {"note": f"{case['note']}, with Γ; rms without Γ {other['value']:.3f}"}


def follow_equation_12(evidence, tolerance, fits):
    """Test whether vt/h follows Eq. 12; yield a case for each row of a table of fits with Γ, which is indexed by H.

    The tested value is the root mean square of ln(vt/h) less the right side of Eq. 12 over region (b). It has two
    parts, which add in quadrature: the logarithm of the ratio of prefactors, in a fit with β = H/(1 + H) and in Eq. 12,
    and the residual of this fit. The interval is from the first part.
    """
    for hurst, row in fits.iterrows():
        ratios = np.array(interval(row, "zeta_fixed")) / reference.zeta_viscous(hurst)
        value, *ends = np.log(ratios)
        nearest = 0.0 if ends[0] < 0 < ends[1] else np.min(np.abs(ends))
        values = np.hypot([value, nearest, np.max(np.abs(ends))], row["residual_fixed"])
        more = {"realizations": row["realizations"], "cases": len(fits), "note": f"ζ/(2 − H) = {ratios[0]:.2f}"}
        yield evidence.case(hurst_name(hurst), tuple(values), 0.0, (-np.inf, tolerance), **more)


@claim(
    title="divided by Eq. 12, the curves of all H fall on one curve",
    sentence="divided by the right side of Eq. 12, the results of all H collapse to a single “master curve” in region "
    "(b), whichever it is",
    where="Fig. 3",
    kind="own",
    quantity="root mean square of ln(vt/h) less Eq. 12 about its mean over H",
    criterion="at the X that lie in region (b) for every H, the root mean square deviation of ln(vt/h) less that of "
    "Eq. 12 from its mean over H is below the tolerance",
    tolerance=0.15,
    assumption=True,
    reason="as for Eq. 12",
    figure="fig3_master_curve",
    readings=True,
)
def master_curve_shape(evidence, tolerance):
    """Test whether vt/h at equal X follows Eq. 12 up to a factor common to all H.

    The tested value is the spread of ln(vt/h divided by Eq. 12) between Hurst exponents (fits.zeta_laws). It is 0 if
    all curves collapse onto one curve. Yields one case for all Hurst exponents, and one case for Hurst exponents from
    0.4 on.
    """
    table = evidence.of_reading("zeta_laws")
    counts = {"realizations": table["realizations"].min(), "cases": table["hurst_min"].nunique()}
    for hurst_min in table["hurst_min"].unique():
        values = measure_value(table, "common", LAST, "spread", hurst_min, evidence.reading)
        name = f"H from {hurst_min:g} on" if hurst_min > 0 else "all H"
        yield evidence.case(name, values, 0.0, (-np.inf, tolerance), **counts)


@claim(
    title="Eq. 12 holds up to one constant, from H = 0.4 on",
    sentence="from H = 0.4 on, Eq. 12 describes the discs in region (b) up to one constant, the same for every H",
    where="Eq. 12, Fig. 3",
    kind="beyond",
    quantity="root mean square of ln(vt/h) less Eq. 12 times one constant, over region (b)",
    criterion="with the constant that fits best, as a factor of vt/h and as a factor of X, the root mean square of "
    "ln(vt/h) less Eq. 12 over region (b) is below the tolerance",
    tolerance=0.1,
    reason="the paper states no precision, and ≈ in Eqs. 4 and 11 is read as within a tenth; set with the residuals "
    "in view",
    figure="fig3_master_curve",
    readings=True,
)
def one_constant(evidence, tolerance):
    """Test whether one constant, for all Hurst exponents from 0.4 on, reconciles Eq. 12 with the discs.

    The tested value is the root mean square of ln(vt/h) less Eq. 12 over region (b) that remains with this constant.
    The note of the case states the constant.
    """
    table = evidence.of_reading("zeta_laws")
    hurst_min, counts = table["hurst_min"].max(), {"realizations": table["realizations"].min(), "cases": len(CONSTANTS)}
    for name, (constant, residual) in CONSTANTS.items():
        factor, values = (
            measure_value(table, "region", LAST, measure, hurst_min, evidence.reading)
            for measure in (constant, residual)
        )
        note = f"constant {factor[0]:.2f} [{factor[1]:.2f}, {factor[2]:.2f}]"
        yield evidence.case(name, values, 0.0, (-np.inf, tolerance), note=note, **counts)


@claim(
    title="the prefactor of Eq. 11 fits better than that of Eq. 4",
    sentence="the viscous results “can be better fitted” by the law (9) with ζ “≈” 2 − H than with Eq. 4",
    where="Eq. 11",
    kind="own",
    quantity="root mean square deviation from Eq. 4 minus that from Eq. 11",
    criterion="the root mean square of ln(vt/h) less that of the law, with the exponent H/(1 + H), over region (b) "
    "and all H, is smaller for Eq. 11 than for Eq. 4, by more than the tolerance, with the factor 1/Γ(2 − α) in both "
    "laws, as the paper compares them",
    tolerance=0.0,
    reason="better is better by any amount that the interval can tell",
    figure="fig3_master_curve",
    readings=True,
)
def zeta_better(evidence, tolerance):
    """Test whether Eq. 11 fits vt/h better than Eq. 4, with the factor 1/Γ(2 − α) in both (fits.zeta_laws).

    The note has the difference without this factor in either law.
    """
    table = evidence.of_reading("zeta_laws")
    values = measure_value(table, "region", difference("Eq. 4, with Γ"), "deviation", reading=evidence.reading)
    fits = evidence.fits("discs", gamma="without")
    deviations = [
        np.sqrt(np.mean(np.log(fits["zeta_fixed"] / law(fits.index)) ** 2 + fits["residual_fixed"] ** 2))
        for law in (reference.zeta_elastic, reference.zeta_viscous)
    ]
    note = f"without Γ in both laws: {deviations[0] - deviations[1]:.3f}"
    realizations = table["realizations"].min()
    yield evidence.case("all H", values, np.nan, (tolerance, np.inf), realizations=realizations, note=note)


@claim(
    title="these discs have the prefactor of Eq. 4, a law of the elastic contact",
    sentence="ζ “≈” π(3 − H)/10, an “empirical approximation” that the paper quotes for the elastic contact and finds "
    "to fit its own results less well than Eq. 11",
    where="Eq. 4",
    kind="quoted",
    quantity="ζ at β = H/(1 + H), without Γ",
    criterion="the relative difference of ζ, fitted with the exponent H/(1 + H), is below the tolerance, at every H",
    tolerance=0.1,
    reason="the paper states no precision, and ≈ is read as within a tenth",
    figure="fig3_master_curve",
    readings=True,
)
def zeta_elastic(evidence, tolerance):
    """Test whether the prefactor ζ of discs follows Eq. 4, a law of the elastic contact without the factor Γ."""
    fits = evidence.fits("discs", gamma="without")
    for hurst, row in fits.iterrows():
        expected, counted = reference.zeta_elastic(hurst), {"realizations": row["realizations"], "cases": len(fits)}
        ends = (expected * (1 - tolerance), expected * (1 + tolerance))
        yield evidence.case(hurst_name(hurst), interval(row, "zeta_fixed"), expected, ends, **counted)
