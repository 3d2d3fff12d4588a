"""Judge claims on lines that represent surfaces: λ, exponents, contact area, separation, single surfaces.

The paper calls the applicability of the method of dimensionality reduction proven, and compares exponents. Other
quantities that a line should reproduce are judged here as well: Lyashenko, Pastewka & Persson (Tribology Letters 52,
223 (2013)) find that it reproduces neither contact area nor separation.
"""

import numpy as np

from viscorough_study.fits.intervals import UNDEFINED, deviation_interval, interval
from viscorough_study.verdicts.evidence import exact, hurst_name, judged

EQUAL_WINDOWS = ("same X", "same κ")


def lambda_constant(evidence, tolerance):
    """Return λ at the upper end of region (b) over λ at the lower end."""
    return _cases(evidence, evidence.tables["mdr_summary"], "drift", 1.0, (1 / (1 + tolerance), 1 + tolerance))


def exact_correspondence(evidence, tolerance):
    """Return the error of ln(vt/h) with the best single λ at the upper end of region (b)."""
    return _cases(evidence, evidence.tables["mdr_summary"], "error_trend", 0.0, (-tolerance, tolerance))


def whole_curve(evidence, tolerance):
    """Return the largest error of ln(vt/h) over the whole curve, with the λ that is best in region (b)."""
    return _cases(evidence, evidence.tables["mdr_summary"], "error_whole", 0.0, (-tolerance, tolerance))


def _cases(evidence, table, column, expected, allowed):
    """Yield cases of a column of a table, one for each row, named by H and, if it has one, by its window."""
    for row in table.to_dict("records"):
        name = hurst_name(row["hurst"]) + (f", {row['window']}" if "window" in row else "")
        context = {"realizations": row["realizations"], "cases": len(table)}
        yield evidence.case(name, interval(row, column), expected, allowed, **context)


def coincide_equal_windows(evidence, tolerance):
    """Return β of lines minus β of discs, both fitted in the same range of X, and both in the same range of κ."""
    table = evidence.tables["mdr_exponents"]
    return _cases(evidence, table[table["window"].isin(EQUAL_WINDOWS)], "difference", 0.0, (-tolerance, tolerance))


def line_area(evidence, tolerance):
    """Return the contact fraction of lines over the contact fraction of discs."""
    return _at_centres(evidence, "area_ratio", (1 / (1 + tolerance), 1 + tolerance))


def line_gap(evidence, tolerance):
    """Return the mean gap of lines over the mean gap of discs."""
    return _at_centres(evidence, "gap_ratio", (1 / (1 + tolerance), 1 + tolerance))


def single_surface(evidence, tolerance):
    """Return the factor between κ of a disc and its line: one standard deviation of the logarithm of their ratio.

    The interval follows from the χ² distribution of a standard deviation of normal samples.
    """

    def factor(row, column):
        return tuple(np.exp(deviation_interval(row[column], row["realizations"] - 1)))

    return _at_centres(evidence, "stiffness_scatter", (-np.inf, 1 + tolerance), factor)


def own_line(evidence, tolerance):
    """Judge the deviation of the row of springs of a surface's own line from direct integration in time.

    The deviation must fall to less than half with twice as many steps; the extremes are the deviations at both.
    """
    for hurst, rows in evidence.tables["histories"].groupby("hurst"):
        fine, coarse = (rows[name].abs().max() for name in ("deviation", "deviation_coarse"))
        yield exact(hurst_name(hurst), fine, 0.0, fine <= tolerance and fine < 0.5 * coarse, (fine, coarse))


def _at_centres(evidence, column, allowed, values=interval):
    """Yield cases of the comparison by surface at the centre of region (b), with the extremes over the region.

    column : column that must be defined; values : function of a row of the comparison and the column, returns value and
        interval
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
