"""Measure cost and error of every method on one problem.

The error of a method is the root mean square of the relative deviation of its velocities from the reference solution.
"""

import logging
from functools import partial

import numpy as np
import pandas as pd
from threadpoolctl import threadpool_limits

from viscorough_study.performance import timing
from viscorough_study.performance.methods import METHODS
from viscorough_study.performance.problems import named_problem
from viscorough_study.run.kernels import compile_kernels

MAX_REPEATED = 10.0  # runs of at least this time are not repeated [s]
TIMES = ("wall_s", "processor_s")
COLUMNS = {
    "problem": ("indenter", ""),
    "hurst": ("Hurst exponent", "1"),
    "elements": ("elements across the indenter", "1"),
    "method": ("method", ""),
    "group": ("group of the method", ""),
    "parameter": ("parameter of the method that trades accuracy for cost", ""),
    "value": ("value of that parameter", "1"),
    "wall_s": ("wall time, median of interleaved repeats", "s"),
    "processor_s": ("processor time, median of interleaved repeats", "s"),
    "error": ("relative error of the velocity, root mean square over all depths", "1"),
    "steps": ("levels, events, time steps or points of a line", "1"),
}


def measure_problems(*, problems, seed, levels, repeats, longest):
    """Measure cost and error of every method on several problems; return a pandas.DataFrame with `COLUMNS`.

    problems : list of arguments of `named_problem`; seed : root seed of rough discs
    levels : number of depths of each problem
    repeats, longest : arguments of `measure`
    """
    compile_kernels()  # load compiled code now, so that its loading is not timed
    # Use one thread. Snakemake gives the job all cores, so that no other job disturbs the timing.
    with threadpool_limits(1):
        indenters = (named_problem(**problem, levels=levels, root=seed) for problem in problems)
        return pd.concat([measure(indenter, repeats, longest=longest) for indenter in indenters], ignore_index=True)


def measure(problem, repeats, *, longest, methods=METHODS):
    """Measure cost and error of every method that can solve a problem, at every value of its parameter.

    repeats : number of interleaved repeats after a first run. Errors are taken from the first run, and times are
        medians of the repeats. If the first run exceeds MAX_REPEATED or `longest`, it is not repeated, and its time
        is used
    longest : if a run takes at least this time [s], its method is not tried at finer values

    Returns a pandas.DataFrame with the columns of `COLUMNS`, one row per method and value.
    """
    rows, functions, elements = [], {}, len(problem.indenter.heights)
    for method in methods:
        if elements > method.largest or (method.rough_only and problem.body):
            continue
        for value in method.values:
            logging.info("%s: %s, %s %g", problem.name, method.name, method.parameter, value)
            function = partial(method.run, problem, value)
            (velocity, steps), *seconds = timing.timed(function)
            error = np.sqrt(np.mean((velocity / problem.velocity - 1) ** 2))
            row = {"method": method.name, "group": method.group, "parameter": method.parameter, "value": float(value)}
            rows.append(row | {"error": error, "steps": steps} | dict(zip(TIMES, seconds, strict=True)))
            spent = min(seconds)  # on a busy machine, only the wall time grows
            if spent < min(longest, MAX_REPEATED):
                functions[len(rows) - 1] = function
            if spent >= longest:
                break
    logging.info("%s: %d repeats", problem.name, repeats)
    for place, seconds in timing.interleaved(functions, repeats).items():
        rows[place] |= dict(zip(TIMES, seconds, strict=True))
    table = pd.DataFrame(rows).assign(problem=problem.name, hurst=problem.hurst, elements=elements)
    return table[list(COLUMNS)]
