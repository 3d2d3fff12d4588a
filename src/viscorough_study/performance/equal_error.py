"""What lines and boundary elements cost where both have the same error.

The error of a line is not reached by more points: that of a rough disc is that of the reduction itself. So the line has
the fewest points with which its error is about the least that it can have, and boundary elements the largest tolerance
with which theirs is no larger.
"""

import pandas as pd

EQUAL = 1.1  # errors are about equal within this factor
COLUMNS = {
    "problem": ("indenter", ""),
    "hurst": ("Hurst exponent of the indenter", "1"),
    "elements": ("elements across the indenter", "1"),
    "line_error": ("rms relative error of the velocity by the reduction", "1"),
    "points": ("fewest points of the line with which it is within a factor of 1.1 of the least", "1"),
    "line_wall_s": ("wall time of the line, its generation included", "s"),
    "tolerance": ("tolerance of the fastest loading path with an error no larger", "1"),
    "error": ("its rms relative error of the velocity", "1"),
    "wall_s": ("its wall time", "s"),
    "ratio": ("time of boundary elements over that of the line", "1"),
}


def methods_tables(tables, **settings):
    """{"methods", "equal_error": table} of the tables of all indenters; settings : with which methods were measured."""
    methods = pd.concat(tables, ignore_index=True)
    return {"methods": methods, "equal_error": equal_error(methods)}


def equal_error(methods):
    """A row for each indenter; a pandas.DataFrame with the columns of `COLUMNS`.

    methods : table of viscorough_study.performance.measurement. Indenters without lines, or on which no loading path is
    as accurate, are left out.
    """
    rows = []
    for (problem, elements), table in methods.groupby(["problem", "elements"], sort=False):
        lines, paths = table[table["method"] == "MDR"], table[table["group"] == "path"]
        if lines.empty:
            continue
        line = lines[lines["error"] <= EQUAL * lines["error"].min()].sort_values("value").iloc[0]
        paths = paths[paths["error"] <= line["error"]]
        if paths.empty:
            continue
        path = paths.loc[paths["wall_s"].idxmin()]
        values = (problem, line["hurst"], elements, line["error"], line["value"], line["wall_s"])
        rows.append((*values, path["value"], path["error"], path["wall_s"], path["wall_s"] / line["wall_s"]))
    return pd.DataFrame(rows, columns=list(COLUMNS))
