"""Find the cheapest of all measured models that answers a question within an allowed error.

The error and the processor time of a model are its largest values at any Hurst exponent of the tables. A sufficient
model is therefore sufficient for every Hurst exponent. The error of a model of one surface is its deviation from the
full map, the map of all points. The error of the full map itself is the error that it estimates for its own grid.
"""

import pandas as pd

from viscorough_study.run.names import CONTACT, GRID, LAW, MDR, MDR_FITTED, MDR_PI, PAPER
from viscorough_study.run.readable import readable

# Each question is a tuple: text, name of the table with the models' errors, quantity in this table, and allowed
# relative errors.
QUESTIONS = (
    ("mean exponent β", "mean", "exponent", (0.05,)),
    ("mean velocity", "mean", "velocity", (0.2, 0.1, 0.05, 0.01)),
    ("velocity of one surface", "one", "velocity", (0.2, 0.1, 0.05, 0.01)),
    ("contact area of one surface", "one", "contact area", (0.1,)),
    ("pressures of one surface, on its grid", "one", "pressures", (0.01,)),
)
COLUMNS = {
    "question": ("question", ""),
    "allowed": ("relative error allowed", "1"),
    "model": ("cheapest model within this error; if there is none, the most accurate model", ""),
    "setting": ("setting of the model", ""),
    "error": ("relative error, the largest over the Hurst exponents", "1"),
    "processor_s": ("processor time, the largest over the Hurst exponents", "s"),
    "reached": ("1 if the error is within the allowed error, else 0", "1"),
    "hurst": ("Hurst exponents", ""),
}


def sufficient_models(one_surface, mean_accuracy):
    """Find the cheapest sufficient model for every question and allowed error; return a table with `COLUMNS`.

    one_surface, mean_accuracy : tables of performance.one_surface and comparisons.mean_of_surfaces
    """
    tables, rows = {"one": _judged_by_itself(one_surface), "mean": mean_accuracy}, []
    for question, name, quantity, errors in QUESTIONS:
        measured = tables[name][tables[name]["quantity"] == quantity].dropna(subset=["processor_s", "error"])
        candidates = _over_hurst(measured)
        for allowed in errors if len(candidates) else ():
            within = candidates[candidates["error"] <= allowed]
            order = ["processor_s", "error"] if len(within) else ["error", "processor_s"]
            best = (within if len(within) else candidates).sort_values(order).iloc[0]
            rows.append(
                {
                    "question": question,
                    "allowed": allowed,
                    **dict(zip(("model", "setting"), _names(best), strict=True)),
                    **best[["error", "processor_s", "hurst"]],
                    "reached": int(best["error"] <= allowed),
                }
            )
    return pd.DataFrame(rows, columns=list(COLUMNS))


def _judged_by_itself(table):
    """Replace the error of the full map by its own estimate of this error, and return the changed table.

    The full map is the map of all points; the errors of all other models are deviations from the full map. The full map
    estimates only the error of its velocity, so its rows of other quantities are dropped.
    table : table of performance.one_surface
    """
    full = (table["model"] == GRID) & (table["across"] == table["across"].max())
    stated = table["stated"].where(table["quantity"] == "velocity")
    kept = ~full | stated.notna()
    return table.assign(error=table["error"].where(~full, stated))[kept]


def _over_hurst(table):
    """Return the models that were measured at all Hurst exponents, each with its largest error and its largest time."""
    keys = ["model", "across", "parameter", "value"] if "parameter" in table else ["model", "across", "surfaces"]
    every = sorted(table["hurst"].unique())
    largest = {"error": ("error", "max"), "processor_s": ("processor_s", "max"), "number": ("hurst", "nunique")}
    grouped = table.groupby(keys, sort=False, dropna=False).agg(**largest).reset_index()
    return grouped[grouped["number"] == len(every)].assign(hurst=", ".join(f"{hurst:g}" for hurst in every))


def _names(row):
    """Return two texts for a model: its name (a function of the library, or a formula) and its setting.

    row : row of a model from `_over_hurst`
    """
    model, size = row["model"], f"{row['across']:g} × {row['across']:g}"
    if model == PAPER:
        return "H/(1 + H)", ""
    if model == LAW:
        return "viscorough.penetration_law", ""
    if model == CONTACT:
        return "viscorough.contact_at", f"{size} points, tolerance={row['value']:g}"
    if model == MDR:
        return "viscorough.reduce", f"a line of {readable(row['value'])} points"
    if model in (MDR_PI, MDR_FITTED):
        return "viscorough.reduce", f"{row['surfaces']:g} lines, {model.removeprefix('MDR, ')}"
    if "surfaces" in row:
        return "viscorough.indent", f"{row['surfaces']:g} discs of {size} points"
    return "viscorough.indent", f"{size} points, tolerance={row['value']:g}"
