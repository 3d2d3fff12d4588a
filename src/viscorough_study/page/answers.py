"""Collect the numbers for the answers at the top of the page, and for its section on methods that fail."""

from collections import Counter

import numpy as np

from viscorough_study.page.results import Number
from viscorough_study.robustness.stress_solutions import MODELS
from viscorough_study.verdicts.claims import counted_verdicts


def verdict_counts(results):
    """Count the claims on physics with each verdict; return a list of `Number`, from the best verdict to the worst.

    A claim is counted once, by its overall verdict, even if it was tested in several cases.
    """
    numbers = counted_verdicts(results.tables["claims"])
    column, origin = "verdict over all cases of a claim on physics", results.origin("claims")
    return [Number(number, "claims", column, counted=verdict, origin=origin) for verdict, number in numbers]


def answers(results):
    """Return the numbers in the answers at the top of the page, {name of an answer: one or several numbers}."""

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


# ---- failures


def failures(results):
    """Return the numbers that the page states about the stress tests of all methods (robustness.failure_map).

    cases : number of stress tests
    unnoticed : number of results that are wrong without a warning
    warned : number of results that are wrong, but come with a warning
    worst_model : largest finite error of an approximate model that warned or was used outside its documented range
    methods : {method: {verdict: number of stress tests}}
    """
    table = results.tables["failure_map"]
    outside = table[table["method"].isin(MODELS) & table["verdict"].isin(["stated", "warned"])]
    return {
        # each method has one row per stress test
        "cases": results.count("failure_map", "method", table["method"].iloc[0]),
        **{name: results.count("failure_map", "verdict", name) for name in ("unnoticed", "warned")},
        "worst_model": results.extremes(outside[np.isfinite(outside["error"])], "failure_map", "error")[1],
        "methods": {name: Counter(rows["verdict"]) for name, rows in table.groupby("method", sort=False)},
    }
