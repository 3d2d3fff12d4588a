"""Cost of lines and of boundary elements at equal error.

More points do not reduce the error of a line for a rough disc below that of the reduction itself. The line therefore
has the fewest points with nearly its smallest error, and boundary elements have the largest tolerance with an error no
larger than that.
"""

import pandas as pd

EQUAL = 1.1  # factor within which errors count as equal
COLUMNS = {
    "problem": ("indenter", ""),
    "hurst": ("Hurst exponent of the indenter", "1"),
    "elements": ("elements across the indenter", "1"),
    "line_error": ("rms relative error of the velocity by the reduction", "1"),
    "points": ("fewest points of the line with an error within a factor of 1.1 of the least", "1"),
    "line_wall_s": ("wall time of the line, including its generation", "s"),
    "tolerance": ("tolerance of the fastest loading path with an error no larger", "1"),
    "error": ("its rms relative error of the velocity", "1"),
    "wall_s": ("its wall time", "s"),
    "ratio": ("time of boundary elements over that of the line", "1"),
}


def methods_tables(tables, **settings):
    """{"methods", "equal_error": table} of the tables of all indenters; settings : of the measurements."""
    methods = pd.concat(tables, ignore_index=True)
    return {"methods": methods, "equal_error": equal_error(methods)}


def equal_error(methods):
    """One row per indenter; a pandas.DataFrame with the columns of `COLUMNS`.

    methods : table of viscorough_study.performance.measurement
    Indenters without lines, or for which no loading path is as accurate, are omitted.
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
