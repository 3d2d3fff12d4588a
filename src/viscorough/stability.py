"""Where each method fails: every method driven into every difficulty, with its error and whether users are told.

A difficulty is an indenter and a question: the depths at given impulses ∫F dt/η, or for the elastic methods the forces
at given depths, which by the correspondence is the same. The answer to compare with is the dense solution on the same
elements, exact to rounding. A method holds if its error is within its limit; if not, it must have refused with a
reason or warned, or, for a model, be outside of what its documentation states. What fails unnoticed would be a defect:
`unnoticed` of a table is to be empty.
"""

import warnings
from collections.abc import Callable
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from functools import partial
from unittest.mock import patch

import numpy as np
import pandas as pd

from viscorough import contact, gradients, halfspace, reference, viscous
from viscorough.contact import ContactSolver
from viscorough.curve import AccuracyWarning, ConvergenceError
from viscorough.indentation import indent
from viscorough.marching import march_events
from viscorough.reduction import reduce
from viscorough.stepping import march_steps
from viscorough.surfaces import Indenter, self_affine_disc, self_affine_line

QUESTIONS = 6  # depths asked for
LINE_POINTS = 2**14  # of the line that stands for a surface in the reduction of dimensionality
LIMIT_EVENTS, LIMIT_STEPS, LIMIT_MODEL = 1e-9, 0.02, 1.0  # a model of one realization: a factor of two
FEW = 10  # elements in contact, below which the grid rules (region a)
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


@dataclass(frozen=True)
class Difficulty:
    """An indenter, and what is asked of it.

    hurst : the exponent that a user of the power law, and of a line with the same spectrum, would take
    fractions : contact fractions between which depths are asked for
    body : of revolution with a power-law profile, whose line is exact
    tolerance : of the elastic path; steps : of explicit marching
    force : F at equal times, whose impulses are those asked for; constant by default
    stated : why models are documented not to hold here
    periodic : the grid of the elastic path without padding, so that images of the indenter press as well
    """

    group: str
    name: str
    indenter: Indenter
    hurst: float = 1.0
    fractions: tuple = (0.02, 0.5)
    body: reference.PowerLawBody | None = None
    tolerance: float = 1e-6
    steps: int = 256
    force: tuple = (1.0, 1.0)
    stated: str = ""
    periodic: bool = False


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


# ---- difficulties

NOT_SELF_AFFINE = "the indenter is no isotropic self-affine surface, which a line with its spectrum stands for"
SMALL = "Eq. 5 is said to hold above H = 0.4"
FEW_TOUCH = "fewer than ten elements touch: region (a), which belongs to the grid"
ROLL_OFF = "the spectrum rolls off: there is no power law"


def difficulties(seed, across, grids):
    """Every difficulty of the atlas, on maps of `across` elements, and on `grids` where the size is the difficulty."""

    def disc(hurst, elements=across, **options):
        return self_affine_disc(hurst, elements, seed=seed, **options)

    def of(shape):
        """The map of a shape over x and y from −1 to 1, times 0.1; spacing 2 / across."""
        x = (np.arange(across) - (across - 1) / 2) * 2 / across
        return Indenter(0.1 * (shape(x[:, None], x) + np.zeros((across, across))), 2 / across)

    def shaped(name, shape, **options):
        return Difficulty("shape", name, of(shape), stated=NOT_SELF_AFFINE, **options)

    def tied(name, heights, **options):
        return Difficulty(
            "ties", name, Indenter(np.asarray(heights, dtype=float), 1.0), stated=NOT_SELF_AFFINE, **options
        )

    rough = disc(0.7)
    usual = {"indenter": rough, "hurst": 0.7}
    elements, random = rough.elements, np.random.default_rng(seed)
    checkered = np.add.outer(np.arange(across), np.arange(across)) % 2
    apart = np.full((across, across), np.nan)
    apart[0, 0], apart[-1, -1] = 0, -0.1

    yield Difficulty("step size", "4096 steps", **usual, steps=4096)
    yield Difficulty("step size", "256 steps", **usual)
    yield Difficulty("step size", "16 steps", **usual, steps=16)
    yield Difficulty("step size", "one step", **usual, steps=1)
    for hurst in (0.0, 0.2, 0.4, 0.7, 1.0):
        yield Difficulty("Hurst exponent", f"H = {hurst:g}", disc(hurst), hurst, stated=SMALL if hurst <= 0.4 else "")
    rolled = {"roll_off_wavelength": 0.2, "roll_off_level": 1.0}
    yield Difficulty("Hurst exponent", "H = 0.7, roll-off", disc(0.7, **rolled), 0.7, stated=ROLL_OFF)
    for n in grids:
        few = (0.05, 0.5) if n < 65 else (30 / n**2, 300 / n**2)
        yield Difficulty("grid", f"{n} elements across", disc(0.7, n), 0.7, few, steps=256 if n < 257 else 64)
    yield Difficulty("contact", "up to 2 elements", **usual, fractions=(1 / elements, 2 / elements))
    yield Difficulty("contact", "95 % to all but one", **usual, fractions=(0.95, 1 - 1 / elements))
    yield Difficulty("contact", "to all elements", **usual, fractions=(0.5, 1.0))
    yield Difficulty("contact", "past all elements", **usual, fractions=(0.9, 1.1))
    yield tied("exactly flat", np.zeros((across, across)))
    yield tied("one element", [[1.0]])
    yield tied("two, far apart", apart, fractions=(0.5, 1.0))
    yield tied("plateau on a hill", of(lambda x, y: -np.maximum(np.hypot(x, y), 0.3)).heights * 10)
    yield tied("terraces", of(lambda x, y: -np.floor(6 * np.hypot(x, y))).heights)
    yield tied("one step", of(lambda x, y: -1.0 * (x > 0.1)).heights)
    yield tied("checkered", -0.5 * checkered, fractions=(0.5, 1.0))
    yield tied("whole numbers", random.integers(0, 4, (across, across)))
    yield Difficulty("shape", "sphere", of(lambda x, y: -(x**2 + y**2) / 2), body=reference.PowerLawBody(0.05, 2))
    yield Difficulty("shape", "cone", of(lambda x, y: -np.hypot(x, y)), body=reference.PowerLawBody(0.1, 1))
    yield shaped("ridge", lambda x, y: -(x**2))
    yield shaped("wedge", lambda x, y: -abs(x))
    yield shaped("two spheres", lambda x, y: -np.minimum((x - 0.5) ** 2, (x + 0.5) ** 2) - y**2)
    yield shaped("tip off the centre", lambda x, y: -((x - 0.6) ** 2) - (y + 0.5) ** 2, fractions=(0.02, 0.3))
    yield shaped("elongated", lambda x, y: -(x**2) - (y / 8) ** 2)
    yield shaped("tilted plane", lambda x, y: x + y / 2)
    yield shaped("steep: slope 20", lambda x, y: -200 * np.hypot(x, y))
    low = (2 / elements, 20 / elements)
    yield Difficulty("no padding", "2 to 20 elements", **usual, fractions=low, periodic=True)
    yield Difficulty("no padding", "up to half of all", **usual, periodic=True)
    for name, height, length in (
        ("heights times 1e12", 1e12, 1.0),
        ("heights times 1e-12", 1e-12, 1.0),
        ("spacing times 1e12", 1.0, 1e12),
        ("spacing times 1e-12", 1.0, 1e-12),
        ("heights 1e-12, spacing 1e12", 1e-12, 1e12),
    ):
        scaled = Indenter(height * rough.heights, length * rough.spacing)
        yield Difficulty("scale", name, scaled, 0.7)
    for name, force in (
        ("ramp", (0.0, 1.0)),
        ("step", (0.1, 0.1, 0.1, 1.0, 1.0, 1.0)),
        ("pulses with rests", (0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0)),
        ("zero at first", (0.0, 0.0, 0.0, 0.0, 1.0, 1.0)),
        ("negative for a while", (1.0, 1.0, -0.1, 1.0)),
    ):
        yield Difficulty("force in time", name, **usual, force=force)
    for tolerance in (1e-1, 1e-3, 1e-10, 1e-12, 1e-14):
        yield Difficulty("tolerance", f"{tolerance:g}", **usual, tolerance=tolerance)


# ---- the question, and the answer to compare with


@dataclass(frozen=True)
class _Question:
    depth: np.ndarray
    force: np.ndarray
    count: np.ndarray  # elements in contact


def _question(difficulty, questions=QUESTIONS):
    """Depths, and F/G at them by dense solutions."""
    with _dense():
        solver = ContactSolver(difficulty.indenter, 1e-11)
        depths = _depths(solver, difficulty, questions)
        state, force, count = solver.touch(), [], []
        for depth in depths:
            state = solver.advance(state, depth)
            force.append(state.force)
            count.append(state.count)
    scale = 4 * np.pi * difficulty.indenter.spacing * solver.unit
    return _Question(depths * solver.unit, scale * np.array(force), np.array(count))


def _depths(solver, difficulty, questions):
    """Depths in equal ratios between those at which the contact fractions are reached."""
    first, last = difficulty.fractions
    state, depth = solver.touch(), 0.0
    found, levels = [], []
    # Depths double until the fraction is met, then halve the interval: cheap, and no curve is needed.
    for fraction in (first, min(last, 1.0)):
        low, high = depth, max(2 * depth, solver.gap[solver.gap > 0][0] if solver.gap[-1] > 0 else 1.0)
        while solver.advance(state, high).count < fraction * solver.elements:
            low, high = high, 2 * high
        for _ in range(12):
            middle = 0.5 * (low + high)
            if solver.advance(state, middle).count < fraction * solver.elements:
                low = middle
            else:
                high = middle
        depth = high
        found.append(high)
    levels = np.geomspace(*found, questions) if found[1] > found[0] else found[0] * np.arange(1.0, questions + 1)
    return levels * (3.0 if last > 1 else 1.0)  # past full contact


# ---- methods


def _path(difficulty, question):
    """Forces at the depths."""
    curve = indent(difficulty.indenter, tolerance=difficulty.tolerance, depths=question.depth)
    return curve.force / question.force


def _path_dense(difficulty, question):
    with _dense():
        return _path(difficulty, question)


def _path_grid(precision, difficulty, question):
    with _grid(precision), _periodic() if difficulty.periodic else ExitStack():
        return _path(difficulty, question)


def _events(difficulty, question):
    until = min(1.0, (1.1 * question.count[-1] + 2) / difficulty.indenter.elements)
    events = march_events(difficulty.indenter, until=until)
    return events.depth_at(question.force) / question.depth


def _steps(difficulty, question):
    asked, ends = question.force, []
    if difficulty.steps > 1 and min(difficulty.force) == max(difficulty.force):
        ends = np.geomspace(asked[0] / difficulty.steps, asked[-1], difficulty.steps)
    elif difficulty.steps > 1:  # equal steps of time, as a simulation of that history takes them
        times = np.linspace(0, len(difficulty.force) - 1, difficulty.steps)
        _, _, impulse = viscous.impulses(np.interp(times, np.arange(len(difficulty.force)), difficulty.force), times)
        ends = asked[-1] * np.unique(impulse[impulse > 0]) / impulse[-1]
    steps = march_steps(difficulty.indenter, np.union1d(ends, asked), scheme="explicit")
    return steps.depth[np.searchsorted(steps.impulse, asked)] / question.depth


def _reduction(difficulty, question):
    indenter = difficulty.indenter
    across = indenter.spacing * len(indenter.heights)
    if difficulty.body is not None:
        x = (np.arange(LINE_POINTS) + 0.5) / LINE_POINTS - 0.5
        line = Indenter(-difficulty.body.mdr_profile(across * x), across / LINE_POINTS)
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
    _Method("path, dense", _path_dense, lambda d: 10 * d.tolerance),
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
            viscous.impulses(np.array(difficulty.force), np.arange(len(difficulty.force), dtype=float))
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
    "y": ("error, or penetration over depth", "1"),
}


def curves(seed):
    """Errors against steps and against contact; a pandas.DataFrame with the columns of `CURVES`."""
    discs = [self_affine_disc(0.7, 33, seed=each) for each in seed.spawn(2)]
    return pd.DataFrame(_against_steps(discs[0]) + _against_contact(discs[1]), columns=list(CURVES))


def _against_steps(disc):
    """Error of depth, and deepest penetration, of explicit marching."""
    rows, question = [], _question(Difficulty("", "", disc))
    for number in 2 ** np.arange(13):
        difficulty = Difficulty("", "", disc, steps=int(number))
        with warnings.catch_warnings(record=True):
            warnings.simplefilter("always")
            error = np.abs(_steps(difficulty, question) - 1).max()
            ends = np.geomspace(question.force[0] / number, question.force[-1], number) if number > 1 else []
            steps = march_steps(disc, np.union1d(ends, question.force))
        rows.append(("steps", "error of the depth", number, error))
        rows.append(("steps", "penetration over depth", number, steps.penetration.max()))
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


# ---- generated cases

KINDS = ("uniform", "normal", "whole numbers", "hill", "rough disc", "steps", "strip", "ridge", "one spike", "flat")


def generated_case(generator):
    """A small indenter of a random kind and scale, three depths, a tolerance, and whether to use the grid."""
    kind, rows, columns = generator.choice(KINDS), *generator.integers(1, 13, 2)
    row, column = np.mgrid[:rows, :columns] - np.array([rows, columns])[:, None, None] * generator.random((2, 1, 1))
    if kind == "normal":
        heights = generator.standard_normal((rows, columns))
    elif kind == "whole numbers":
        heights = generator.integers(0, generator.integers(2, 6), (rows, columns)).astype(float)
    elif kind == "hill":
        heights = -(np.hypot(row, column) ** generator.uniform(0.5, 4))
    elif kind == "rough disc":
        heights = self_affine_disc(
            generator.random(), int(generator.integers(3, 13)), seed=int(generator.integers(2**32))
        ).heights
    elif kind == "steps":
        heights = np.floor(generator.uniform(0.1, 2) * row + generator.uniform(0.1, 2) * column)
    elif kind == "strip":
        heights = generator.random((1, int(generator.integers(1, 100))))
    elif kind == "ridge":
        heights = -abs(row + generator.normal() * column) + 1e-3 * generator.random((rows, columns))
    elif kind == "one spike":
        heights = 1e-6 * generator.random((rows, columns))
        heights[rows // 2, columns // 2] = 1.0
    else:
        heights = np.zeros((rows, columns)) if kind == "flat" else generator.random((rows, columns))
    if generator.random() < 0.3 and heights.size > 3:
        heights = np.where(generator.random(heights.shape) < generator.random() * 0.8, np.nan, heights)
        heights.flat[generator.integers(heights.size)] = 0.5
    height, length = 10.0 ** generator.uniform(-12, 12, 2) if generator.random() < 0.3 else (1.0, 1.0)
    indenter = Indenter(height * heights, length)
    span = np.nanmax(indenter.gaps) or length
    depths = np.sort(span * 10.0 ** generator.uniform(-3, 1.5, 3))
    return indenter, depths, 10.0 ** -generator.uniform(1, 11), bool(generator.random() < 0.6)


def silent_failure(indenter, depths, tolerance, on_grid):
    """What is wrong, in words, with a solution that claims to have converged; "" if nothing is.

    Tension, and gap in contact or penetration outside over ten times the tolerance, are looked for with the dense
    influence matrix; the force is compared with events, which share no code with the path but influence coefficients.
    A ConvergenceError is no silent failure. Heights are known to rounding, which is allowed for at small depths.
    """
    solver, wrong = ContactSolver(indenter, tolerance), ""
    influence = solver.influence[abs(solver.row[:, None] - solver.row), abs(solver.column[:, None] - solver.column)]
    events = march_events(indenter)
    scale = 4 * np.pi * indenter.spacing * solver.unit
    with _grid("single") if on_grid else ExitStack():
        state = solver.touch()
        for depth in depths / solver.unit:
            try:
                state = solver.advance(state, depth)
            except ConvergenceError:
                return ""
            allowed = 10 * tolerance + 1e-13 / min(depth, 1.0)
            gap = influence[:, state.members] @ state.pressure - depth + solver.gap
            force, at = scale * state.force, depth * solver.unit
            exact = np.interp(at, events.depth, events.impulse)
            exact += max(at - events.depth[-1], 0.0) * events.resistance[-1]
            if state.pressure.min() < 0:
                wrong = f"tension {state.pressure.min():.2g}"
            elif max(-gap.min(), np.abs(gap[state.members]).max()) > allowed * depth:
                wrong = f"penetration {-gap.min():.2g}, gap {gap[state.members].max():.2g} at depth {depth:.2g}"
            elif abs(force / exact - 1) > allowed:
                wrong = f"force off by {force / exact - 1:.2g}, tolerance {tolerance:.2g}, depth {depth:.2g}"
    return wrong


# ---- ways of the elastic path that users cannot choose


@contextmanager
def _dense():
    with patch.multiple(contact, _DENSE_MEMBERS=10**9, _DENSE_INTERACTIONS=10**12):
        yield


@contextmanager
def _grid(precision):
    with ExitStack() as changes:
        changes.enter_context(patch.multiple(contact, _DENSE_MEMBERS=0, _DENSE_INTERACTIONS=0))
        if precision == "double":
            changes.enter_context(patch.multiple(gradients, _PRECISION=np.float64, _SINGLE=1e-13))
        yield


@contextmanager
def _periodic():
    """Without padding: the indenter has images at its own distance."""

    def spectrum(rows, columns):
        lengths = [rows, columns + columns % 2]
        distance = [np.minimum(np.arange(m), m - np.arange(m)) for m in lengths]
        kernel = halfspace.influence_coefficient(distance[0][:, None].astype(float), distance[1].astype(float))
        return lengths, halfspace.ducc0.fft.r2c(kernel).real / kernel.size

    with patch.object(halfspace, "_spectrum", spectrum):
        yield
