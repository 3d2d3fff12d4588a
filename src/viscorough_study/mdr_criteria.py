"""Criteria of claims on the line that stands for a surface: λ, exponents, contact area, separation, single surfaces.

The paper calls the applicability of the method of reduction of dimensionality proven, and compares exponents. What else
a line would have to reproduce to stand for a surface is judged here, too: Lyashenko, Pastewka & Persson (Tribology
Letters 52, 223 (2013)) find that it reproduces neither contact area nor separation.
"""

import numpy as np
from scipy import stats

from viscorough_study.evidence import NO_INTERVAL, hurst_name, judged

EQUAL_WINDOWS = ("same X", "same κ")


def lambda_constant(evidence, tolerance):
    """λ at the upper end of region (b) over λ at the lower end."""
    table, cases = evidence.tables["mdr_summary"], []
    for row in table.to_dict("records"):
        values, of_all = _values(row, "drift"), {"realizations": _fewest(row), "cases": len(table)}
        met = evidence.within(values, 1 / (1 + tolerance), 1 + tolerance, **of_all)
        cases.append(judged(hurst_name(row["hurst"]), values, 1.0, met))
    return cases


def exact_correspondence(evidence, tolerance):
    """Error of ln(vt/h) with the best single λ: at the upper end of region (b), and the largest of the whole curve."""
    table, cases = evidence.tables["mdr_summary"], []
    for row in table.to_dict("records"):
        for name, column in (("region (b)", "error_trend"), ("to complete contact", "error_whole")):
            values, of_all = _values(row, column), {"realizations": _fewest(row), "cases": 2 * len(table)}
            met = evidence.within(values, -tolerance, tolerance, **of_all)
            cases.append(judged(f"{hurst_name(row['hurst'])}, {name}", values, 0.0, met))
    return cases


def coincide_equal_windows(evidence, tolerance):
    """β of lines minus β of discs, both fitted in the same range of X, and both in the same range of κ."""
    table, cases = evidence.tables["mdr_exponents"], []
    table = table[table["window"].isin(EQUAL_WINDOWS)]
    number = {row["hurst"]: _fewest(row) for row in evidence.tables["mdr_summary"].to_dict("records")}
    for row in table.to_dict("records"):
        values, of_all = _values(row, "difference"), {"realizations": number[row["hurst"]], "cases": len(table)}
        met = evidence.within(values, -tolerance, tolerance, **of_all)
        cases.append(judged(f"{hurst_name(row['hurst'])}, {row['window']}", values, 0.0, met))
    return cases


def line_area(evidence, tolerance):
    """Contact fraction of lines over that of discs."""
    return _ratios(evidence, "area_ratio", tolerance)


def line_gap(evidence, tolerance):
    """Mean gap of lines over that of discs."""
    return _ratios(evidence, "gap_ratio", tolerance)


def single_surface(evidence, tolerance):
    """Factor between κ of a disc and its line: one standard deviation of the logarithm of their ratio.

    The interval is that of the standard deviation of a normal distribution, by the distribution of χ².
    """
    cases = []
    for hurst, rows in _in_regions(evidence, "stiffness_scatter"):
        if rows is None:
            cases.append(judged(hurst_name(hurst), (np.nan,) * 3, 1.0, None))
            continue
        row = _at_centre(rows)
        freedom, scatter = row["realizations"] - 1, row["stiffness_scatter"]
        ends = scatter * np.sqrt(freedom / stats.chi2.ppf([0.975, 0.025], freedom)) if freedom else NO_INTERVAL
        values = tuple(np.exp([scatter, *ends]))
        of_all = {"realizations": row["realizations"], "cases": len(evidence.regions)}
        met, every = evidence.within(values, -np.inf, 1 + tolerance, **of_all), np.exp(rows["stiffness_scatter"])
        cases.append(judged(hurst_name(hurst), values, 1.0, met, extremes=(every.min(), every.max())))
    return cases


def _ratios(evidence, column, tolerance):
    """Cases of a ratio that should be 1 at the centre of region (b), with its extremes over the region."""
    cases = []
    for hurst, rows in _in_regions(evidence, column):
        if rows is None:
            cases.append(judged(hurst_name(hurst), (np.nan,) * 3, 1.0, None))
            continue
        row = _at_centre(rows)
        values, of_all = _values(row, column), {"realizations": row["realizations"], "cases": len(evidence.regions)}
        met = evidence.within(values, 1 / (1 + tolerance), 1 + tolerance, **of_all)
        extremes = rows[column].min(), rows[column].max()
        cases.append(judged(hurst_name(hurst), values, 1.0, met, extremes=extremes))
    return cases


def _in_regions(evidence, column):
    """(H, rows of the comparison surface by surface in region (b) that have a value; None without any)."""
    table = evidence.tables["reduction"].dropna(subset=column)
    for hurst, window in evidence.regions.items():
        rows = None
        if window is not None:
            rows = table[(table["hurst"] == hurst) & table["x"].between(*window)]
        yield hurst, None if rows is None or rows.empty else rows


def _at_centre(rows):
    """The row in the middle of the rows in ln X."""
    offset = np.log(rows["x"]) - np.log(rows["x"].iloc[[0, -1]]).mean()
    return rows.loc[offset.abs().idxmin()]


def _fewest(row):
    """Realizations of a row of the summary: discs or lines, whichever are fewer."""
    return min(row["discs"], row["lines"])


def _values(row, column):
    """Value, low, high."""
    return tuple(row[name] for name in (column, f"{column}_low", f"{column}_high"))


JUDGES = {
    "lambda_constant": lambda_constant,
    "exact_correspondence": exact_correspondence,
    "coincide_equal_windows": coincide_equal_windows,
    "line_area": line_area,
    "line_gap": line_gap,
    "single_surface": single_surface,
}
