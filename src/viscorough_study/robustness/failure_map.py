"""Make the failure map: the error of every method in every stress test, and whether a failure is reported.

A method holds in a test if its error is within its limit. Otherwise the method must refuse the test with a reason, or
give a warning. An approximate model may also fail without a message outside its documented range. Any other failure
goes unnoticed, and is a defect.
"""

import logging
import warnings

import numpy as np
import pandas as pd

from viscorough.basics.errors import AccuracyWarning, ConvergenceError
from viscorough_study.robustness.stress_solutions import METHODS, MODELS, reference_solution
from viscorough_study.robustness.stress_tests import stress_tests
from viscorough_study.run.seeds import failure_map_key, realization_seed

MIN_ELEMENTS = 10  # with fewer elements in contact (region (a)), the grid determines the result
FEW_ELEMENTS = "fewer than ten elements touch: region (a), which belongs to the grid"
COLUMNS = {
    "group": ("kind of stress test", ""),
    "test": ("stress test", ""),
    "method": ("method", ""),
    "error": ("largest factor by which the depth is too large or too small, less 1; 1 where a test is refused", "1"),
    "limit": ("largest error for which the method holds", "1"),
    "verdict": ("holds, model, stated, warned, refused or unnoticed", ""),
    "reason": ("messages to users", ""),
}


def map_failures(*, seed, across, grids, hurst_min):
    """Return the `failure_map` of all stress tests, and log a warning for every unnoticed failure.

    seed : root seed of the tests; across, grids, hurst_min : arguments of `stress_tests`
    """
    table = failure_map(stress_tests(realization_seed(seed, *failure_map_key()), across, grids, hurst_min))
    for row in table[table["verdict"] == "unnoticed"].itertuples():
        logging.warning("%s: %s fails unnoticed, error %.2g", row.test, row.method, row.error)
    return table


def failure_map(tests, methods=METHODS):
    """Apply every method to every stress test; return a pandas.DataFrame with the columns of `COLUMNS`.

    tests : iterable of StressTest; methods : {name: (function, limit, parameters)}, see stress_solutions.METHODS
    """
    rows, solutions, answers = [], {}, {}
    for test in tests:
        logging.info("%s: %s", test.group, test.name)
        # Tests with the same indenter and contact fractions share one reference solution.
        question = (test.indenter.heights.tobytes(), test.indenter.spacing, test.fractions)
        if question not in solutions:
            solutions[question] = reference_solution(test)
        for name, (ratios, limit, parameters) in methods.items():
            # Such tests also share the answer of a method if they agree in the further parameters that it uses.
            asked = name, *question, *(getattr(test, parameter) for parameter in parameters)
            if asked not in answers:
                answers[asked] = _answer(test, solutions[question], ratios)
            cell = _cell(test, solutions[question], *answers[asked], limit(test), is_model=name in MODELS)
            rows.append((test.group, test.name, name, *cell))
    return pd.DataFrame(rows, columns=list(COLUMNS))


def _answer(test, solution, ratios):
    """Apply one method to one test; return its error, its messages, and whether it refused the test.

    solution : reference solution of the test
    ratios : function of test and solution that returns the ratios of the method's results to the reference solution
    """
    messages, error, refused = [], 1.0, False
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", AccuracyWarning)
        try:
            found = np.atleast_1d(ratios(test, solution))
            factors = np.where(found > 0, np.maximum(found, 1 / np.where(found > 0, found, 1.0)), np.inf)
            error = float(factors.max()) - 1
        except (ValueError, ConvergenceError, MemoryError) as reason:
            messages, refused = [str(reason)], True
    messages += [str(warning.message) for warning in caught if issubclass(warning.category, AccuracyWarning)]
    return error, messages, refused


def _cell(test, solution, error, messages, refused, limit, *, is_model):
    """Judge the answer of one method in one test; return its error, limit, verdict and reason.

    solution : reference solution of the test; limit : largest error for which the method holds
    error, messages, refused : answer of the method, from `_answer`
    is_model : True for an approximate model
    """
    verdict = "refused" if refused else ""
    if not verdict and error <= limit:
        verdict = "model" if is_model else "holds"
    elif not verdict:
        limits = {test.stated: is_model, FEW_ELEMENTS: is_model and solution.count[0] < MIN_ELEMENTS}
        stated = [text for text, applies in limits.items() if text and applies]  # documented reasons that apply
        verdict = "warned" if messages else "stated" if stated else "unnoticed"
        messages = messages + stated
    reason = " ".join("; ".join(dict.fromkeys(messages)).split())
    return error, limit, verdict, reason
