"""Make the failure map: the error of every method in every stress-test case, and whether a failure is reported.

A method holds in a case if its error is within its limit. Otherwise the method must refuse the case with a reason, or
give a warning. An approximate model may also fail without a message outside its documented range. Any other failure
goes unnoticed, and is a defect.
"""

import logging
import warnings

import numpy as np
import pandas as pd

from viscorough.basics.errors import AccuracyWarning, ConvergenceError
from viscorough_study.robustness.stress_cases import stress_cases
from viscorough_study.robustness.stress_solutions import METHODS, MODELS, reference_solution
from viscorough_study.run.seeds import failure_map_key, realization_seed

MIN_ELEMENTS = 10  # with fewer elements in contact (region (a)), the grid determines the result
FEW_ELEMENTS = "fewer than ten elements touch: region (a), which belongs to the grid"
COLUMNS = {
    "group": ("kind of stress-test case", ""),
    "case": ("stress-test case", ""),
    "method": ("method", ""),
    "error": ("largest factor by which the depth is too large or too small, less 1; 1 where a case is refused", "1"),
    "limit": ("largest error for which the method holds", "1"),
    "verdict": ("holds, model, stated, warned, refused or unnoticed", ""),
    "reason": ("messages to users", ""),
}


def map_failures(*, seed, across, grids, hurst_min):
    """Return the `failure_map` of all stress-test cases, and log a warning for every unnoticed failure.

    seed : root seed of the cases; across, grids, hurst_min : arguments of `stress_cases`
    """
    table = failure_map(stress_cases(realization_seed(seed, *failure_map_key()), across, grids, hurst_min))
    for row in table[table["verdict"] == "unnoticed"].itertuples():
        logging.warning("%s: %s fails unnoticed, error %.2g", row.case, row.method, row.error)
    return table


def failure_map(cases, methods=METHODS):
    """Apply every method to every stress-test case; return a pandas.DataFrame with the columns of `COLUMNS`.

    cases : iterable of StressCase; methods : {name: (function, limit, parameters)}, see stress_solutions.METHODS
    """
    rows, solutions, answers = [], {}, {}
    for case in cases:
        logging.info("%s: %s", case.group, case.name)
        # Cases with the same indenter and contact fractions share one reference solution.
        question = (case.indenter.heights.tobytes(), case.indenter.spacing, case.fractions)
        if question not in solutions:
            solutions[question] = reference_solution(case)
        for name, (ratios, limit, parameters) in methods.items():
            # Such cases also share the answer of a method if they agree in the further parameters that it uses.
            asked = name, *question, *(getattr(case, parameter) for parameter in parameters)
            if asked not in answers:
                answers[asked] = _answer(case, solutions[question], ratios)
            cell = _cell(case, solutions[question], *answers[asked], limit(case), is_model=name in MODELS)
            rows.append((case.group, case.name, name, *cell))
    return pd.DataFrame(rows, columns=list(COLUMNS))


def _answer(case, solution, ratios):
    """Apply one method to one case; return its error, its messages, and whether it refused the case.

    solution : reference solution of the case
    ratios : function of case and solution that returns the ratios of the method's results to the reference solution
    """
    messages, error, refused = [], 1.0, False
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", AccuracyWarning)
        try:
            found = np.atleast_1d(ratios(case, solution))
            factors = np.where(found > 0, np.maximum(found, 1 / np.where(found > 0, found, 1.0)), np.inf)
            error = float(factors.max()) - 1
        except (ValueError, ConvergenceError, MemoryError) as reason:
            messages, refused = [str(reason)], True
    messages += [str(warning.message) for warning in caught if issubclass(warning.category, AccuracyWarning)]
    return error, messages, refused


def _cell(case, solution, error, messages, refused, limit, *, is_model):
    """Judge the answer of one method in one case; return its error, limit, verdict and reason.

    solution : reference solution of the case; limit : largest error for which the method holds
    error, messages, refused : answer of the method, from `_answer`
    is_model : True for an approximate model
    """
    verdict = "refused" if refused else ""
    if not verdict and error <= limit:
        verdict = "model" if is_model else "holds"
    elif not verdict:
        limits = {case.stated: is_model, FEW_ELEMENTS: is_model and solution.count[0] < MIN_ELEMENTS}
        stated = [text for text, applies in limits.items() if text and applies]  # documented reasons that apply
        verdict = "warned" if messages else "stated" if stated else "unnoticed"
        messages = messages + stated
    reason = " ".join("; ".join(dict.fromkeys(messages)).split())
    return error, limit, verdict, reason
