"""Claims on the method of dimensionality reduction (MDR), in which a line of independent springs represents a surface.

Lines are compared with discs of reading A: a line has the period and the rms height of these discs. The paper calls the
applicability of the method proven, and compares exponents only. Lyashenko, Pastewka & Persson (Tribology Letters 52,
223 (2013)) find that the method reproduces neither contact area nor separation.
"""

import numpy as np

from viscorough_study.fits.intervals import UNDEFINED, difference, interval
from viscorough_study.verdicts.claim import claim
from viscorough_study.verdicts.evidence import hurst_name, judged
from viscorough_study.verdicts.exponents import above_limit, follows_law
from viscorough_study.verdicts.prefactors import follow_equation_12


@claim(
    title="lines of independent springs (MDR) give H/(1 + H), for H above 0.4",
    sentence="the exponents β of the reduction of dimensionality are “accurately described” by H/(1 + H), “at least "
    "for H > 0.4”",
    where="Eq. 10, Fig. 4",
    kind="own",
    quantity="β of lines",
    criterion="β differs from H/(1 + H) by less than the tolerance, at every such H",
    tolerance=0.03,
    assumption=True,
    reason="as for boundary elements, with which it is compared",
    figure="fig4_exponent",
)
def beta_lines(evidence, tolerance):
    """Test whether the exponent β of lines is H/(1 + H), at the Hurst exponents for which the paper claims this."""
    return follows_law(evidence, tolerance, above_limit(evidence, evidence.fits("lines")))


@claim(
    title="both methods give nearly the same exponents at all H",
    sentence="the exponents of boundary elements and of the reduction of dimensionality “nearly coincide”, “over the "
    "entirety” of the Hurst exponents studied",
    where="Sec. V, Fig. 4",
    kind="own",
    quantity="β of lines minus β of discs",
    criterion="they differ by less than the tolerance, at every H",
    tolerance=0.05,
    assumption=True,
    reason="a symbol of Fig. 4 covers 0.01 to 0.03, and two symbols are compared. With 0.03, the tolerance of β, H = "
    "0.4 would not hold, and the claim would hold in part likewise",
    figure="fig4_exponent",
)
def coincide(evidence, tolerance):
    """Test whether the exponents β of MDR lines and of discs are equal, for each Hurst exponent of the discs."""
    discs, lines = evidence.fits("discs"), evidence.fits("lines")
    for hurst, row in discs.iterrows():
        if hurst not in lines.index:
            yield judged(hurst_name(hurst), UNDEFINED, 0.0, None)
            continue
        line = lines.loc[hurst]
        counted = {"realizations": min(row["realizations"], line["realizations"]), "cases": len(discs)}
        values = difference(interval(row, "beta"), interval(line, "beta"))
        yield evidence.case(hurst_name(hurst), values, 0.0, (-tolerance, tolerance), **counted)


@claim(
    title="lines of independent springs (MDR) with λ = π follow the master curve, Eq. 12",
    sentence="in region (b) the results of the reduction of dimensionality lie on the “master curve” of Eq. 12, too",
    where="Eq. 12, Fig. 3",
    kind="own",
    quantity="root mean square of ln(vt/h) less Eq. 12 over region (b), of lines",
    criterion="over region (b) the root mean square of ln(vt/h) less the right side of Eq. 12 is below the tolerance, "
    "at every H of the discs",
    tolerance=0.15,
    assumption=True,
    reason="as for discs",
    remark="The lines have the factor λ = π of Eq. 13. The paper later replaces π by λ(H), and does not say which "
    "lines Fig. 3 shows; another λ moves the lines along X.",
    figure="fig3_master_curve",
)
def line_master_curve(evidence, tolerance):
    """Test whether vt/h of lines follows Eq. 12 as printed, in region (b), for each Hurst exponent of the discs."""
    lines = evidence.fits("lines", gamma="with")
    return follow_equation_12(evidence, tolerance, lines[lines.index.isin(list(evidence.pooled))])


@claim(
    title="the exponent of lines is exact as H tends to 1",
    sentence="for H → 1 the exponent α = 1/(1 + H) is an “exact relation following from rigorous scaling "
    "considerations”",
    where="Sec. IV, Eq. 5",
    kind="quoted",
    quantity="β of lines at H = 1",
    criterion="β at H = 1 is 1/2 within the tolerance; discs at H = 1 are among the fine grids",
    tolerance=0.015,
    reason="half of what other H are held to, since the relation is called exact",
    figure="fig4_exponent",
)
def alpha_limit(evidence, tolerance):
    """Test whether the exponent β of lines is 1/2 at H = 1, where the paper calls the exponent exact."""
    fits = evidence.fits("lines")
    if 1.0 not in fits.index:
        yield judged("H = 1", UNDEFINED, 0.5, None)
        return
    values, number = interval(fits.loc[1.0], "beta"), fits.loc[1.0, "realizations"]
    yield evidence.case("H = 1", values, 0.5, (0.5 - tolerance, 0.5 + tolerance), realizations=number)


@claim(
    title="the spectrum of a line needs a factor λ that depends on H",
    sentence="the line's spectrum needs a factor λ(H), which depends on H, in place of π",
    where="Eq. 13 and below",
    kind="quoted",
    quantity="λ at the largest H over λ at the smallest",
    criterion="λ at the largest H over λ at the smallest differs from 1 by more than the tolerance; where it does, no "
    "constant serves, π included",
    tolerance=0.05,
    assumption=True,
    reason="ζ varies as λ^(−α/2), so that 5 % in λ are 2 to 3 % in the velocity, which no figure of the paper can show",
    figure="mdr_lambda",
)
def line_spectrum(evidence, tolerance):
    """Test whether the factor λ in the spectrum of a line (Eq. 13) depends on the Hurst exponent H.

    If the ratio differs from 1 by more than the tolerance, λ is not constant, and so not π. The two λ are independent,
    so the half-widths of the intervals of their logarithms add in quadrature. The smallest and the largest λ/π of all
    Hurst exponents are stated as well.
    """
    fits = evidence.fits("discs")[["lambda", "lambda_low", "lambda_high", "realizations"]].dropna()
    if len(fits) < 2:
        yield judged("λ over H", UNDEFINED, np.nan, None)
        return
    logarithms = np.log(fits.drop(columns="realizations").to_numpy())
    logarithmic, widest = difference(logarithms[0], logarithms[-1]), np.log1p(tolerance)
    number = min(fits["realizations"].min(), evidence.fits("lines")["realizations"].min())
    constant = evidence.within(logarithmic, -widest, widest, realizations=number)
    met = None if constant is None else not constant
    name, ends = f"H = {fits.index[-1]:g} over H = {fits.index[0]:g}", fits["lambda"].agg(["min", "max"]) / np.pi
    yield judged(name, np.exp(logarithmic), np.nan, met, note="λ/π from {:.2f} to {:.2f}".format(*ends))


@claim(
    title="λ is a constant at each H",
    sentence="λ(H) is a “constant which depends only on the Hurst exponent”",
    where="Sec. V, below Eq. 13",
    kind="quoted",
    quantity="λ at the upper end of region (b) over λ at its lower end",
    criterion="λ at the upper end of region (b) over λ at its lower end, by a power law through λ(X), is 1 up to a "
    "factor of 1 plus the tolerance",
    tolerance=0.15,
    assumption=True,
    reason="the velocity varies as λ^(α/2), so that 15 % in λ are 4 to 6 % in the velocity, the width of a line in "
    "Fig. 3",
    figure="mdr_lambda",
)
def lambda_constant(evidence, tolerance):
    """Test whether λ, the factor in the spectrum of a line (Eq. 13), is constant in region (b), for each H."""
    return _of_summary(evidence, "drift", 1.0, (1 / (1 + tolerance), 1 + tolerance))


@claim(
    title="with this λ a line moves like its surface",
    sentence="with the factor λ(H) the line has “the exact correspondence” to the surface",
    where="Sec. V, below Eq. 13",
    kind="quoted",
    quantity="error of ln(vt/h) at the upper end of region (b), with the best single λ",
    criterion="with the one λ for each H that makes the largest error over region (b) the smallest, the error of "
    "ln(vt/h) is below the tolerance over region (b)",
    tolerance=0.05,
    assumption=True,
    reason="5 % is 0.02 decades, less than the width of a line in Fig. 3",
    figure="mdr_lambda",
)
def exact_correspondence(evidence, tolerance):
    """Test whether lines have the same vt/h as discs in region (b), with a single factor λ for each H (Eq. 13)."""
    return _of_summary(evidence, "error_trend", 0.0, (-tolerance, tolerance))


def _of_summary(evidence, column, expected, allowed):
    """Test whether a column of the table `mdr_summary` is in the allowed range; yield a case for each H."""
    table = evidence.tables["mdr_summary"]
    for row in table.to_dict("records"):
        context = {"realizations": row["realizations"], "cases": len(table)}
        yield evidence.case(hurst_name(row["hurst"]), interval(row, column), expected, allowed, **context)


OUR_CHOICE = "our choice; the paper does not treat this quantity"


@claim(
    title="a line gives the contact area of its surface",
    sentence="lines of the reduction of dimensionality also give the contact area, a quantity that the paper does not "
    "treat",
    where="not in the paper",
    kind="beyond",
    quantity="contact fraction of lines over that of discs at the centre of region (b); published results of `make "
    "paper`",
    criterion="the contact fraction of lines over that of the discs with the same spectrum (Eq. 13) is 1 up to a "
    "factor of 1 plus the tolerance at the centre of region (b)",
    tolerance=0.1,
    reason=OUR_CHOICE,
    figure="reduction",
)
def line_area(evidence, tolerance):
    """Test whether lines have the same contact fraction as the discs that they represent, for each Hurst exponent."""
    return _at_centres(evidence, "area_ratio", (1 / (1 + tolerance), 1 + tolerance))


@claim(
    title="a line gives the mean gap of its surface",
    sentence="lines of the reduction of dimensionality also give the mean gap, a quantity that the paper does not "
    "treat",
    where="not in the paper",
    kind="beyond",
    quantity="mean gap of lines over that of discs at the centre of region (b); published results of make paper",
    criterion="the mean gap of lines over that of the discs with the same spectrum (Eq. 13) is 1 up to a factor of 1 "
    "plus the tolerance at the centre of region (b)",
    tolerance=0.1,
    reason=OUR_CHOICE,
    figure="reduction",
)
def line_gap(evidence, tolerance):
    """Test whether lines have the same mean gap as the discs that they represent, for each Hurst exponent."""
    return _at_centres(evidence, "gap_ratio", (1 / (1 + tolerance), 1 + tolerance))


def _at_centres(evidence, column, allowed):
    """Test a ratio of lines to their discs at the centre of region (b); yield a case for each H.

    column : column of the published table `reduction` with the ratio; rows without a value are omitted
    allowed : range (low, high) in which the claim allows the ratio
    The least and the largest ratio in region (b) are stated as well.
    """
    table = evidence.tables["reduction"].dropna(subset=column)
    for hurst, window in evidence.regions.items():
        rows = table[(table["hurst"] == hurst) & table["x"].between(*window or (np.nan, np.nan))]
        if rows.empty:
            yield judged(hurst_name(hurst), UNDEFINED, 1.0, None)
            continue
        offset = np.log(rows["x"]) - np.log(rows["x"].iloc[[0, -1]]).mean()
        row = rows.loc[offset.abs().idxmin()]
        more = {"realizations": row["realizations"], "extremes": (rows[column].min(), rows[column].max())}
        more |= {"cases": len(evidence.regions), "note": f"at X = {row['x']:.2g}"}
        yield evidence.case(hurst_name(hurst), interval(row, column), 1.0, allowed, **more)
