"""Where each method fails: every method driven into every difficulty, with its error and whether users are told.

A difficulty is an indenter and a question: the depths at given impulses ∫F dt/η, or for the elastic methods the forces
at given depths, which by the correspondence is the same. The answer to compare with is the dense solution on the same
elements, exact to rounding. A method holds if its error is within its limit; if not, it must have refused with a
reason or warned, or, for a model, be outside of what its documentation states. What fails unnoticed would be a defect:
`unnoticed` of a table is to be empty.
"""

import warnings
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
import pandas as pd

from viscorough import reference
from viscorough.contact.loading_path import indent
from viscorough.contact.solver import ContactSolver
from viscorough.errors import AccuracyWarning, ConvergenceError
from viscorough.mdr import reduce
from viscorough.surfaces import self_affine_disc, self_affine_line
from viscorough.viscous import correspondence
from viscorough.viscous.events import march_events
from viscorough.viscous.stepping import march_steps
from viscorough_study.performance.ablations import DENSE_ONLY, GRID_ONLY, NO_PADDING
from viscorough_study.robustness.stress_cases import Difficulty

QUESTIONS = 6  # depths asked for
LINE_POINTS = 2**14  # of the line that stands for a surface in the reduction of dimensionality
LIMIT_EVENTS, LIMIT_STEPS, LIMIT_MODEL = 1e-9, 0.02, 1.0  # a model of one realization: a factor of two
FEW = 10  # elements in contact, below which the grid rules (region a)
FEW_TOUCH = "fewer than ten elements touch: region (a), which belongs to the grid"
COLUMNS = {
    "group": ("kind of difficulty", ""),
    "difficulty": ("difficulty", ""),
    "method": ("method", ""),
    "error": ("largest relative error of depth, or of force at given depth; 1 where there is no answer", "1"),
    "limit": ("error up to which the method counts as holding", "1"),
    "verdict": ("holds, model, stated, warned, refused, not offered or unnoticed", ""),
    "reason": ("what users are told", ""),
}
VERDICTS = ("holds", "model", "stated", "warned", "refused", "not offered", "unnoticed")


def table(difficulties, report=lambda text: None):
    """Every method in every difficulty; a pandas.DataFrame with the columns of `COLUMNS`."""
    rows = []
    for difficulty in difficulties:
        report(f"{difficulty.group}: {difficulty.name}")
        question = _question(difficulty)
        rows += [_cell(difficulty, question, method) for method in METHODS]
    return pd.DataFrame(rows, columns=list(COLUMNS))


def unnoticed(atlas):
    """The rows of a table in which a method fails and nobody is told."""
    return atlas[atlas["verdict"] == "unnoticed"]


# ---- the question, and the answer to compare with


@dataclass(frozen=True)
class _Question:
    depth: np.ndarray
    force: np.ndarray
    count: np.ndarray  # elements in contact


def _question(difficulty, questions=QUESTIONS):
    """Depths, and F/G at them by dense solutions."""
    solver = ContactSolver(difficulty.indenter, 1e-11, DENSE_ONLY)
    depths = _reduced_depths(solver, difficulty, questions)
    contact, force, count = solver.unloaded_state(), [], []
    for depth in depths:
        contact = solver.advance_reduced(contact, depth)
        force.append(contact.force)
        count.append(contact.count)
    return _Question(depths * solver.units.length, np.array(force), np.array(count))


def _reduced_depths(solver, difficulty, questions):
    """Depths in equal ratios between those at which the contact fractions are reached."""
    first, last = difficulty.fractions
    contact, depth = solver.unloaded_state(), 0.0
    gap, elements = solver.elements.initial_gap, solver.elements.count
    found, levels = [], []
    # Depths double until the fraction is met, then halve the interval: cheap, and no curve is needed.
    for fraction in (first, min(last, 1.0)):
        low, high = depth, max(2 * depth, gap[gap > 0][0] if gap[-1] > 0 else 1.0)
        while solver.advance_reduced(contact, high).count < fraction * elements:
            low, high = high, 2 * high
        for _ in range(12):
            middle = 0.5 * (low + high)
            if solver.advance_reduced(contact, middle).count < fraction * elements:
                low = middle
            else:
                high = middle
        depth = high
        found.append(high)
    levels = np.geomspace(*found, questions) if found[1] > found[0] else found[0] * np.arange(1.0, questions + 1)
    return levels * (3.0 if last > 1 else 1.0)  # past full contact


# ---- methods


def _path(options, difficulty, question):
    """Forces at the depths."""
    curve = indent(difficulty.indenter, tolerance=difficulty.tolerance, depths=question.depth, options=options)
    return curve.force / question.force


def _path_grid(precision, difficulty, question):
    options = NO_PADDING if difficulty.periodic else GRID_ONLY
    return _path(options[precision], difficulty, question)


def _events(difficulty, question):
    until = min(1.0, (1.1 * question.count[-1] + 2) / difficulty.indenter.elements)
    events = march_events(difficulty.indenter, until_fraction=until)
    return events.depth_at(question.force) / question.depth


def _steps(difficulty, question):
    asked, ends = question.force, []
    if difficulty.steps > 1 and min(difficulty.force) == max(difficulty.force):
        ends = np.geomspace(asked[0] / difficulty.steps, asked[-1], difficulty.steps)
    elif difficulty.steps > 1:  # equal steps of time, as a simulation of that history takes them
        times = np.linspace(0, len(difficulty.force) - 1, difficulty.steps)
        _, _, impulse = correspondence.impulses(
            np.interp(times, np.arange(len(difficulty.force)), difficulty.force), times
        )
        ends = asked[-1] * np.unique(impulse[impulse > 0]) / impulse[-1]
    steps = march_steps(difficulty.indenter, np.union1d(ends, asked), scheme="explicit")
    return steps.depth[np.searchsorted(steps.impulse, asked)] / question.depth


def _reduction(difficulty, question):
    indenter = difficulty.indenter
    across = indenter.spacing * len(indenter.heights)
    if difficulty.body is not None:
        line = difficulty.body.mdr_line(LINE_POINTS, across)
    else:
        rms = np.nanstd(indenter.heights)
        line = self_affine_line(difficulty.hurst, LINE_POINTS, rms=rms, length=across, seed=1)
    depth, _ = reduce(line, until_force=1.01 * question.force[-1]).at_force(question.force)
    return depth / question.depth


def _law(gamma, difficulty, question):
    """Eqs. 6 or 8, with Eqs. 4 and 5; with the exact α and ζ of a body of revolution."""
    indenter = difficulty.indenter
    across, rms = indenter.spacing * len(indenter.heights), np.nanstd(indenter.heights)
    zeta, alpha = reference.zeta_elastic(difficulty.hurst), reference.exponent_alpha(difficulty.hurst)
    if difficulty.body is not None:
        alpha = 1 / (1 + difficulty.body.exponent)
        x, kappa = (each / 4 for each in (1 / (rms * across), 1 / across))
        force, stiffness = difficulty.body.force(1.0) * x, difficulty.body.stiffness(1.0) * kappa
        zeta = stiffness / force**alpha
    if rms == 0:
        raise ValueError("power law: the rms height is 0; allowed: above 0")
    if gamma:
        text = "the factor 1/Γ(2−α) comes from the Laplace transform of a nonlinear relation"
        warnings.warn(text, AccuracyWarning, stacklevel=1)
    x = question.force / (4 * rms * across)
    return rms * reference.depth_law(x, zeta, alpha, gamma=gamma) / question.depth


@dataclass(frozen=True)
class _Method:
    """`ask` returns the answers over those of the dense solution; `limit` of the error depends on the difficulty."""

    name: str
    ask: Callable
    limit: Callable
    model: bool = False


METHODS = (
    _Method("path, dense", partial(_path, DENSE_ONLY), lambda d: 10 * d.tolerance),
    _Method("path, grid, double", partial(_path_grid, "double"), lambda d: 10 * d.tolerance),
    _Method("path, grid, single", partial(_path_grid, "single"), lambda d: 10 * d.tolerance),
    _Method("events", _events, lambda d: LIMIT_EVENTS),
    _Method("explicit steps", _steps, lambda d: LIMIT_STEPS),
    _Method("MDR", _reduction, lambda d: LIMIT_MODEL, model=True),
    _Method("power law", partial(_law, False), lambda d: LIMIT_MODEL, model=True),
    _Method("power law with Γ", partial(_law, True), lambda d: LIMIT_MODEL, model=True),
)


def _cell(difficulty, question, method):
    told, error = [], 1.0
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", AccuracyWarning)
        try:
            correspondence.impulses(np.array(difficulty.force), np.arange(len(difficulty.force), dtype=float))
            ratio = method.ask(difficulty, question)
            error = float(np.abs(np.nan_to_num(ratio, nan=0.0) - 1).max())
            refused = False
        except (ValueError, ConvergenceError, MemoryError) as reason:
            refused, told = True, [str(reason)]
    told += [str(each.message) for each in caught if issubclass(each.category, AccuracyWarning)]
    limit = method.limit(difficulty)
    if refused:
        verdict = "refused"
    elif difficulty.periodic and "grid" in method.name:
        verdict = "not offered"
    elif error <= limit:
        verdict = "model" if method.model else "holds"
    else:
        stated = [difficulty.stated] if difficulty.stated else []
        stated += [FEW_TOUCH] if question.count[0] < FEW else []
        verdict = "warned" if told else "stated" if stated and method.model else "unnoticed"
        told += stated if method.model else []
    reason = " ".join("; ".join(dict.fromkeys(told)).split())
    return difficulty.group, difficulty.name, method.name, error, limit, verdict, reason


# ---- curves that tell most

CURVES = {
    "curve": ("which curve", ""),
    "method": ("method", ""),
    "x": ("explicit steps; contact fraction", "1"),
    "y": ("error, or overlap over depth", "1"),
}


def curves(seed):
    """Errors against steps and against contact; a pandas.DataFrame with the columns of `CURVES`."""
    discs = [self_affine_disc(0.7, 33, seed=each) for each in seed.spawn(2)]
    return pd.DataFrame(_against_steps(discs[0]) + _against_contact(discs[1]), columns=list(CURVES))


def _against_steps(disc):
    """Error of the depth, and largest overlap over depth, of explicit marching."""
    rows, question = [], _question(Difficulty("", "", disc))
    for number in 2 ** np.arange(13):
        difficulty = Difficulty("", "", disc, steps=int(number))
        with warnings.catch_warnings(record=True):
            warnings.simplefilter("always")
            error = np.abs(_steps(difficulty, question) - 1).max()
            ends = np.geomspace(question.force[0] / number, question.force[-1], number) if number > 1 else []
            steps = march_steps(disc, np.union1d(ends, question.force))
        rows.append(("steps", "error of the depth", number, error))
        rows.append(("steps", "overlap over depth", number, steps.overlap.max()))
    return rows


def _against_contact(disc):
    """Error of every method at contact fractions from one element to all."""
    question = _question(Difficulty("", "", disc, fractions=(4 / disc.elements, 1.0)), questions=12)
    rows = []
    for method in METHODS:
        for difficulty in (Difficulty("", "", disc, 0.7), Difficulty("", "", disc, 0.7, periodic=True)):
            if difficulty.periodic and method.name != "path, grid, single":
                continue
            name = "path, grid, no padding" if difficulty.periodic else method.name
            with warnings.catch_warnings(record=True):
                warnings.simplefilter("always")
                errors = np.abs(method.ask(difficulty, question) - 1)
            for count, error in zip(question.count, errors, strict=True):
                rows.append(("contact", name, count / disc.elements, error))
    return rows
