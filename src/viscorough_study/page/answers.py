"""Collect the numbers for the answers at the top of the page, and for its section on methods that fail."""

from collections import Counter

import numpy as np

from viscorough_study.page.results import Number
from viscorough_study.robustness.stress_solutions import MODELS
from viscorough_study.verdicts.claims import counted_verdicts
from viscorough_study.verdicts.region_criteria import SLOPES_OF_LINE


def verdict_counts(results, published):
    """Count the claims on physics with each verdict, apart for the paper's own claims and for those that it quotes.

    A claim is counted once, by its overall verdict, even if it was tested in several cases.

    Returns {"own" or "quoted": {"here": list of `Number`, from the best verdict to the worst, "full_scale": text}}. The
    text has the counts of the published run if they differ; otherwise it is empty.

    published : published table of claims, from a run with the grids and numbers of surfaces of the paper
    """
    counts, table = {}, results.tables["claims"]
    for origin in ("own", "quoted"):
        column, place = f"verdict over all cases of the {origin} claims on physics", results.origin("claims")
        numbers, full_scale = (counted_verdicts(claims, origin) for claims in (table, published))
        here = [Number(number, "claims", column, counted=verdict, origin=place) for verdict, number in numbers]
        text = ", ".join(f"{number} {verdict}" for verdict, number in full_scale)
        counts[origin] = {"here": here, "full_scale": text if full_scale != numbers else ""}
    return counts


def answers(results):
    """Return the numbers in the answers at the top of the page, {name of an answer: one or several numbers}."""

    def cases(claim):
        return results.records("claims", claim=claim)

    def extremes(claim, column):
        return results.extremes(results.rows("claims", claim=claim), "claims", column)

    def of_slope(slope):
        rows = results.rows("claims", claim="complete_contact")
        return results.extremes(rows[rows["case"].str.contains(f"within {slope:g}")], "claims", "value")

    def farthest(claim):
        rows = results.rows("claims", claim=claim)
        distance = (rows["value"] - rows["expected"]).abs().dropna()
        return results.record("claims", distance.idxmax()) if len(distance) else None

    return {
        "equivalence": [extremes("equivalence", "least")[0], extremes("equivalence", "largest")[1]],
        "collapse": cases("collapse")[0],
        "spread": extremes("power_law", "value"),
        "beta": cases("beta"),
        "lines": farthest("beta_lines"),
        "limit": cases("exponent_limit"),
        "coincide": farthest("coincide"),
        "elastic": cases("zeta_elastic"),
        "viscous": cases("zeta_viscous"),
        "master": cases("master_curve"),
        "constant": cases("one_constant"),
        "complete": {slope: of_slope(slope) for slope in SLOPES_OF_LINE},
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
    stated : number of results of models that are wrong outside their documented range, without a warning
    worst_model : largest finite error of an approximate model that warned or was used outside its documented range
    methods : {method: {verdict: number of stress tests}}
    """
    table = results.tables["failure_map"]
    outside = table[table["method"].isin(MODELS) & table["verdict"].isin(["stated", "warned"])]
    return {
        # each method has one row per stress test
        "cases": results.count("failure_map", "method", table["method"].iloc[0]),
        **{name: results.count("failure_map", "verdict", name) for name in ("unnoticed", "warned", "stated")},
        "worst_model": results.extremes(outside[np.isfinite(outside["error"])], "failure_map", "error")[1],
        "methods": {name: Counter(rows["verdict"]) for name, rows in table.groupby("method", sort=False)},
    }
