"""Collect numbers of the answers at the top of the page, of the advice on methods, and of their failures."""

from collections import Counter

import numpy as np

from viscorough_study.page.results import Number
from viscorough_study.performance.costs import fastest
from viscorough_study.robustness.stress_solutions import MODELS
from viscorough_study.verdicts.claims import counted_verdicts

GROUPS = {"path": "elastic path", "marching": "direct integration in time", "model": "model"}
ERRORS = (0.1, 1e-2, 1e-3, 1e-6)  # allowed errors of the velocity for which the page names the fastest method
ADVISED = 1e-2  # allowed error of the advice at the top of the page


def verdict_counts(results):
    """Return [Number] of claims on physics by verdict, from best to worst; all cases of a claim have one verdict."""
    numbers = counted_verdicts(results.tables["claims"])
    column, origin = "verdict over all cases of a claim on physics", results.origin("claims")
    return [Number(number, "claims", column, counted=verdict, origin=origin) for verdict, number in numbers]


def answers(results):
    """Return {name: numbers} of the sentences that answer the questions at the top of the page."""

    def cases(claim):
        return results.records("claims", claim=claim)

    def extremes(claim, column):
        return results.extremes(results.rows("claims", claim=claim), "claims", column)

    def farthest(claim):
        rows = results.rows("claims", claim=claim)
        distance = (rows["value"] - rows["expected"]).abs().dropna()
        return results.record("claims", distance.idxmax()) if len(distance) else None

    return {
        "collapse": cases("collapse")[0],
        "spread": extremes("power_law", "value"),
        "beta": cases("beta"),
        "lines": farthest("beta_lines"),
        "coincide": farthest("coincide"),
        "elastic": cases("zeta_elastic"),
        "viscous": cases("zeta_viscous"),
        "complete": cases("complete_contact"),
        "small": cases("exponent_small_hurst"),
        "control": extremes("power_law_control", "value"),
        "gamma": [extremes("gamma", "least")[0], extremes("gamma", "largest")[1], *extremes("gamma", "expected")],
    }


# ---- methods


def rough_disc(results):
    """Return rows of the table of methods for the largest rough disc in the comparison of errors."""
    methods = results.tables["methods"]
    rough = methods[methods["hurst"].notna() & methods["group"].isin(GROUPS)]
    rough = rough[rough["elements"] == rough["elements"].max()]
    return rough[rough["hurst"] == rough["hurst"].max()]


def fastest_methods(results):
    """Return {allowed error: {group: fastest method of the group that reaches it, or None}}."""
    rough, methods = rough_disc(results), {}
    for error in ERRORS:
        rows = fastest(rough, error)
        methods[error] = {group: method_row(results, rows[group].name) if group in rows else None for group in GROUPS}
    return methods


def method_row(results, row):
    """Return the record of a row of the table of methods, with the name of the method as in the figure."""
    record = results.record("methods", row)
    return record | {"method": record["method"].removeprefix("path, ").replace("at the depths", "given levels")}


def best_model(results):
    """Return the most accurate model on the rough disc; None if none was measured."""
    models = rough_disc(results).query("group == 'model'")
    return method_row(results, models["error"].idxmin()) if len(models) else None


# ---- failures


def failures(results):
    """Return counts of the failure map, and for every method the number of cases by outcome."""
    table = results.tables["failure_map"]
    outside = table[table["method"].isin(MODELS) & table["verdict"].isin(["stated", "warned"])]
    return {
        "cases": results.count("failure_map", "method", table["method"].iloc[0]),  # one row per case
        **{name: results.count("failure_map", "verdict", name) for name in ("unnoticed", "warned")},
        "worst_model": results.extremes(outside[np.isfinite(outside["error"])], "failure_map", "error")[1],
        "methods": {name: Counter(rows["verdict"]) for name, rows in table.groupby("method", sort=False)},
    }
