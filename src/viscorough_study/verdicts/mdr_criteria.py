"""Judge claims on lines that represent surfaces in the method of dimensionality reduction.

The claims concern the factor λ in the spectrum of a line, exponents, contact area, separation, and single surfaces. The
paper calls the applicability of the method proven, and compares exponents only. Further quantities that a line should
reproduce are judged here as well. Lyashenko, Pastewka & Persson (Tribology Letters 52, 223 (2013)) find that the method
reproduces neither contact area nor separation.
"""

import numpy as np

from viscorough_study.fits.intervals import UNDEFINED, deviation_interval, interval
from viscorough_study.verdicts.evidence import exact, hurst_name, judged

EQUAL_WINDOWS = ("same X", "same κ")


def lambda_constant(evidence, tolerance):
    """Test whether λ, the factor in the spectrum of a line (Eq. 13), is constant in region (b).

    The claim is tested for each Hurst exponent. The tested value is the ratio of λ at the upper end of region (b) to λ
    at its lower end.
    """
    return _cases(evidence, evidence.tables["mdr_summary"], "drift", 1.0, (1 / (1 + tolerance), 1 + tolerance))


def exact_correspondence(evidence, tolerance):
    """Test whether lines have the same vt/h as discs in region (b), with a single factor λ for each H (Eq. 13).

    λ is a factor in the spectrum of the line. The claim is tested for each Hurst exponent. The tested value is the
    error of ln(vt/h) at the upper end of region (b), with the λ that is best in this region.
    """
    return _cases(evidence, evidence.tables["mdr_summary"], "error_trend", 0.0, (-tolerance, tolerance))


def whole_curve(evidence, tolerance):
    """Test whether lines have the same vt/h as discs up to complete contact, with a single λ for each H (Eq. 13).

    λ is a factor in the spectrum of the line. The claim is tested for each Hurst exponent. The tested value is the
    largest error of ln(vt/h) from the start of region (b) to the end of the curve, with the λ that is best in region
    (b).
    """
    return _cases(evidence, evidence.tables["mdr_summary"], "error_whole", 0.0, (-tolerance, tolerance))


def _cases(evidence, table, column, expected, allowed):
    """Test whether the values in a column of a table are in the allowed range; yield a verdict for each row.

    The verdict is named after the Hurst exponent, and after the range of X of the fit if the table has the column
    `window`.

    expected : value of the paper; allowed : (low, high)
    """
    for row in table.to_dict("records"):
        name = hurst_name(row["hurst"]) + (f", {row['window']}" if "window" in row else "")
        context = {"realizations": row["realizations"], "cases": len(table)}
        yield evidence.case(name, interval(row, column), expected, allowed, **context)


def coincide_equal_windows(evidence, tolerance):
    """Test whether the exponents β of lines and discs are equal if both are fitted in the same range of X, or of κ.

    The claim is tested for each Hurst exponent and both ranges. The tested value is β of the lines minus β of the
    discs.
    """
    table = evidence.tables["mdr_exponents"]
    return _cases(evidence, table[table["window"].isin(EQUAL_WINDOWS)], "difference", 0.0, (-tolerance, tolerance))


def line_area(evidence, tolerance):
    """Test whether lines have the same contact fraction as the discs that they represent.

    The claim is tested for each Hurst exponent at the centre of region (b). The tested value is the mean contact
    fraction of the lines, divided by the mean contact fraction of the discs.
    """
    return _at_centres(evidence, "area_ratio", (1 / (1 + tolerance), 1 + tolerance))


def line_gap(evidence, tolerance):
    """Test whether lines have the same mean gap as the discs that they represent.

    The claim is tested for each Hurst exponent at the centre of region (b). The tested value is the mean gap of the
    lines, divided by the mean gap of the discs.
    """
    return _at_centres(evidence, "gap_ratio", (1 / (1 + tolerance), 1 + tolerance))


def single_surface(evidence, tolerance):
    """Test whether a single line has the same stiffness κ as its disc, by a typical factor between the two values.

    The typical factor is exp(s), where s is the standard deviation of ln(κ of the line/κ of the disc). Its interval
    follows from the χ² distribution of the standard deviation of normal samples.
    """

    def factor(row, column):
        return tuple(np.exp(deviation_interval(row[column], row["realizations"] - 1)))

    return _at_centres(evidence, "stiffness_scatter", (-np.inf, 1 + tolerance), factor)


def own_line(evidence, tolerance):
    """Test whether independent viscoelastic springs with the loading curve of a rough surface move like this surface.

    The motion of the surface is computed by direct integration in time. The claim is tested for each Hurst exponent.
    The tested value is the largest deviation between the motion of the springs and the motion of the surface. It must
    be within the tolerance, and must fall to less than half if the number of time steps is doubled. The deviations with
    both numbers of steps are stated as well.
    """
    for hurst, rows in evidence.tables["histories"].groupby("hurst"):
        fine, coarse = (rows[name].abs().max() for name in ("deviation", "deviation_coarse"))
        yield exact(hurst_name(hurst), fine, 0.0, fine <= tolerance and fine < 0.5 * coarse, (fine, coarse))


def _at_centres(evidence, column, allowed, values=interval):
    """Test a quantity that compares lines with their discs at the centre of region (b); yield a verdict for each H.

    column : column of the table `reduction` with the quantity. Rows of the table without a value in this column are
        omitted.
    allowed : range (low, high) in which the claim allows the quantity
    values : function of a row of the table and the column; returns the quantity as (value, low, high)
    The least and the largest value of the quantity in region (b) are stated as well.
    """
    table = evidence.tables["reduction"].dropna(subset=column)
    for hurst, window in evidence.regions.items():
        rows = table[(table["hurst"] == hurst) & table["x"].between(*window or (np.nan, np.nan))]
        if rows.empty:
            yield judged(hurst_name(hurst), UNDEFINED, 1.0, None)
            continue
        offset = np.log(rows["x"]) - np.log(rows["x"].iloc[[0, -1]]).mean()
        row, over_region = rows.loc[offset.abs().idxmin()], [values(row, column)[0] for row in rows.to_dict("records")]
        more = {"realizations": row["realizations"], "extremes": (min(over_region), max(over_region))}
        yield evidence.case(hurst_name(hurst), values(row, column), 1.0, allowed, cases=len(evidence.regions), **more)
