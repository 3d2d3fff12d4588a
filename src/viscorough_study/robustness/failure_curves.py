"""Where methods begin to fail: errors over the number of explicit steps and over the contact fraction."""

import warnings

import numpy as np
import pandas as pd

from viscorough.surfaces import self_affine_disc
from viscorough_study.robustness.stress_cases import StressCase
from viscorough_study.robustness.stress_solutions import METHODS, depth_ratios, explicit_steps, reference_solution

HURST, ELEMENTS_ACROSS = 0.7, 33  # of the discs
DEPTHS = 12  # contact fractions
COLUMNS = {
    "curve": ("which curve", ""),
    "method": ("method", ""),
    "x": ("explicit steps; contact fraction", "1"),
    "y": ("error, or overlap over depth", "1"),
}


def failure_curves(seed):
    """Errors over steps and over contact fraction, each of a disc; a pandas.DataFrame with the columns of `COLUMNS`.

    seed : numpy SeedSequence
    """
    discs = [self_affine_disc(HURST, ELEMENTS_ACROSS, seed=spawned) for spawned in seed.spawn(2)]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # large errors are what is looked for
        return pd.DataFrame(_over_steps(discs[0]) + _over_contact(discs[1]), columns=list(COLUMNS))


def _over_steps(disc):
    """Error of the depth, and largest overlap over depth, of explicit marching."""
    rows, solution = [], reference_solution(StressCase("", "", disc))
    for number in 2 ** np.arange(13):
        steps = explicit_steps(StressCase("", "", disc, steps=int(number)), solution)
        error = np.abs(depth_ratios(steps, solution) - 1).max()
        rows.append(("steps", "error of the depth", number, error))
        rows.append(("steps", "overlap over depth", number, steps.overlap.max()))
    return rows


def _over_contact(disc):
    """Error of every method at contact fractions from a few elements to all."""
    padded = StressCase("", "", disc, HURST, fractions=(4 / disc.elements, 1.0))
    unpadded = StressCase("", "", disc, HURST, periodic=True)
    solution = reference_solution(padded, DEPTHS)
    rows = []
    for method in METHODS:
        named = [(method.name, padded)]
        named += [("path, grid, no padding", unpadded)] if method.name == "path, grid, single" else []
        for name, case in named:
            errors = np.abs(method.ratios(case, solution) - 1)
            rows += [
                ("contact", name, count / disc.elements, error)
                for count, error in zip(solution.count, errors, strict=True)
            ]
    return rows
