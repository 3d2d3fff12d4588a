"""Failure map: every method on every stress-test case, with its error and whether failures are reported.

A method holds if its error is within its limit. Otherwise it must have refused with a reason, or warned, or, if it is a
model, be outside its documented range. Any other failure goes unnoticed, and is a defect.
"""

import logging
import warnings

import numpy as np
import pandas as pd

from viscorough.errors import AccuracyWarning, ConvergenceError
from viscorough.viscous.correspondence import impulses
from viscorough_study.robustness.stress_cases import stress_cases
from viscorough_study.robustness.stress_solutions import METHODS, reference_solution
from viscorough_study.run.seeds import failure_map_key, realization_seed

MIN_ELEMENTS = 10  # elements in contact below which the grid determines the result, region (a)
FEW_ELEMENTS = "fewer than ten elements touch: region (a), which belongs to the grid"
COLUMNS = {
    "group": ("kind of stress-test case", ""),
    "case": ("stress-test case", ""),
    "method": ("method", ""),
    "error": ("largest relative error of depth, or of force at given depth; 1 where there is no answer", "1"),
    "limit": ("largest error for which the method holds", "1"),
    "verdict": ("holds, model, stated, warned, refused or unnoticed", ""),
    "reason": ("messages to users", ""),
}
VERDICTS = ("holds", "model", "stated", "warned", "refused", "unnoticed")


def map_failures(*, seed, across, grids, hurst_min):
    """`failure_map` of all stress-test cases, with a warning in the log for every unnoticed failure."""
    cases = stress_cases(realization_seed(seed, *failure_map_key()), across, grids, hurst_min)
    table = failure_map(cases)
    for row in table[table["verdict"] == "unnoticed"].itertuples():
        logging.warning("%s: %s fails unnoticed, error %.2g", row.case, row.method, row.error)
    return table


def failure_map(cases, methods=METHODS):
    """Every method on every stress-test case; a pandas.DataFrame with the columns of `COLUMNS`."""
    rows, solutions = [], {}
    for case in cases:
        logging.info("%s: %s", case.group, case.name)
        question = (case.indenter.heights.tobytes(), case.indenter.spacing, case.fractions)  # shared by many cases
        if question not in solutions:
            solutions[question] = reference_solution(case)
        rows += [_cell(case, solutions[question], method) for method in methods]
    return pd.DataFrame(rows, columns=list(COLUMNS))


def _cell(case, solution, method):
    """Row of one method on one case."""
    messages, error, refused = [], 1.0, False
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", AccuracyWarning)
        try:
            impulses(np.array(case.force), np.arange(len(case.force), dtype=float))  # refuses tensile forces
            ratios = method.ratios(case, solution)
            error = float(np.abs(np.nan_to_num(ratios, nan=0.0) - 1).max())
        except (ValueError, ConvergenceError, MemoryError) as reason:
            messages, refused = [str(reason)], True
    messages += [str(warning.message) for warning in caught if issubclass(warning.category, AccuracyWarning)]
    limit = method.limit(case)
    if refused:
        verdict = "refused"
    elif error <= limit:
        verdict = "model" if method.model else "holds"
    else:
        stated = _stated_limits(case, solution) if method.model else []
        verdict = "warned" if messages else "stated" if stated else "unnoticed"
        messages += stated
    reason = " ".join("; ".join(dict.fromkeys(messages)).split())
    return case.group, case.name, method.name, error, limit, verdict, reason


def _stated_limits(case, solution):
    """Documented limits of models that apply to a case."""
    limits = [case.stated] if case.stated else []
    return limits + ([FEW_ELEMENTS] if solution.count[0] < MIN_ELEMENTS else [])
