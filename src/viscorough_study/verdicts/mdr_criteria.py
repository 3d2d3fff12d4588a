"""Judge claims on lines that represent surfaces: λ, exponents, contact area, separation, single surfaces.

The paper calls the applicability of the method of dimensionality reduction proven, and compares exponents only. Further
quantities that a line should reproduce are judged here as well. Lyashenko, Pastewka & Persson (Tribology Letters 52,
223 (2013)) find that the method reproduces neither contact area nor separation.
"""

import numpy as np

from viscorough_study.fits.intervals import UNDEFINED, deviation_interval, interval
from viscorough_study.verdicts.evidence import exact, hurst_name, judged

EQUAL_WINDOWS = ("same X", "same κ")


def lambda_constant(evidence, tolerance):
    """Return the cases of the ratio of λ at the upper end of region (b) to λ at its lower end, one for each H."""
    return _cases(evidence, evidence.tables["mdr_summary"], "drift", 1.0, (1 / (1 + tolerance), 1 + tolerance))


def exact_correspondence(evidence, tolerance):
    """Return cases of the error of ln(vt/h) at the upper end of region (b), with the best single λ in region (b)."""
    return _cases(evidence, evidence.tables["mdr_summary"], "error_trend", 0.0, (-tolerance, tolerance))


def whole_curve(evidence, tolerance):
    """Return the cases of the largest error of ln(vt/h) on the whole curve, with the best single λ in region (b)."""
    return _cases(evidence, evidence.tables["mdr_summary"], "error_whole", 0.0, (-tolerance, tolerance))


def _cases(evidence, table, column, expected, allowed):
    """Yield a case for each row of a table, from one of its columns.

    The name of a case is the Hurst exponent, followed by the window if the table has the column `window`.
    """
    for row in table.to_dict("records"):
        name = hurst_name(row["hurst"]) + (f", {row['window']}" if "window" in row else "")
        context = {"realizations": row["realizations"], "cases": len(table)}
        yield evidence.case(name, interval(row, column), expected, allowed, **context)


def coincide_equal_windows(evidence, tolerance):
    """Return the cases of β of lines minus β of discs, fitted in equal ranges of X, and fitted in equal ranges of κ."""
    table = evidence.tables["mdr_exponents"]
    return _cases(evidence, table[table["window"].isin(EQUAL_WINDOWS)], "difference", 0.0, (-tolerance, tolerance))


def line_area(evidence, tolerance):
    """Return the cases of the ratio of the contact fraction of lines to the contact fraction of discs."""
    return _at_centres(evidence, "area_ratio", (1 / (1 + tolerance), 1 + tolerance))


def line_gap(evidence, tolerance):
    """Return the cases of the ratio of the mean gap of lines to the mean gap of discs."""
    return _at_centres(evidence, "gap_ratio", (1 / (1 + tolerance), 1 + tolerance))


def single_surface(evidence, tolerance):
    """Return the cases of the typical factor between κ of a disc and κ of its line.

    The logarithm of this factor is the standard deviation of the logarithm of the ratio of line to disc. Its interval
    follows from the χ² distribution of the standard deviation of normal samples.
    """

    def factor(row, column):
        return tuple(np.exp(deviation_interval(row[column], row["realizations"] - 1)))

    return _at_centres(evidence, "stiffness_scatter", (-np.inf, 1 + tolerance), factor)


def own_line(evidence, tolerance):
    """Yield the deviation between the row of springs of a surface's own line and direct integration in time.

    The deviation must be within the tolerance and fall to less than half with twice as many steps. The extremes of a
    case are the deviations with both numbers of steps.
    """
    for hurst, rows in evidence.tables["histories"].groupby("hurst"):
        fine, coarse = (rows[name].abs().max() for name in ("deviation", "deviation_coarse"))
        yield exact(hurst_name(hurst), fine, 0.0, fine <= tolerance and fine < 0.5 * coarse, (fine, coarse))


def _at_centres(evidence, column, allowed, values=interval):
    """Yield the cases of the comparison of lines and discs by surface, at the centre of region (b), one for each H.

    column : column of the table `reduction`, which must be defined
    allowed : (low, high); values : function of a row of the table and the column, which returns (value, low, high)
    The extremes of a case are the least and the largest value in the region.
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
