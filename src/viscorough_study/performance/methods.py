"""Every way to the velocity of penetration, on the same indenters: what it costs and how wrong it is.

A problem is an indenter, a number of depths, and the velocity v there under constant force, as vt = (F/G)/(k/G), a
length (paper, Eqs. 1-3: vt/h = X/κ). A method has a knob, which trades accuracy for cost. Its error is the root mean
square of the relative deviation of its velocities; where it says nothing, the deviation counts as 1.
"""

import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
import pandas as pd

from viscorough import reference
from viscorough.contact.loading_path import indent
from viscorough.indenter import Indenter
from viscorough.mdr import reduce
from viscorough.surfaces import self_affine_disc, self_affine_line
from viscorough.viscous.events import march_events
from viscorough.viscous.stepping import SCHEMES, march_steps
from viscorough_study.performance import ablations, other_solvers, timing
from viscorough_study.seeds import method_problem_key, realization_seed

BODIES = {"sphere": reference.sphere(1.0), "cone": reference.cone(0.1)}
FINAL_X, FINAL_FRACTION = 30.0, 0.9  # where a rough disc's curve ends
REGION_B = {"elements_min": 10, "stiffness_max": 0.2}  # in contact, and κ
EXACT = 1e-11  # tolerance of the velocities to compare with
MANY = 513  # elements across the indenter, beyond which only the growth of the cost is measured
SLOWEST = 10.0  # what takes more seconds is not repeated
TIMES = ("wall_s", "processor_s")

COLUMNS = {
    "problem": ("indenter", ""),
    "hurst": ("Hurst exponent", "1"),
    "elements": ("elements across the indenter", "1"),
    "method": ("method", ""),
    "group": ("group of the method", ""),
    "knob": ("name of the knob", ""),
    "value": ("value of the knob", "1"),
    "wall_s": ("wall time, median of interleaved repeats", "s"),
    "processor_s": ("processor time, median of interleaved repeats", "s"),
    "error": ("relative error of the velocity, root mean square over all depths", "1"),
    "error_b": ("the same in region (b)", "1"),
    "largest_error": ("largest relative error of the velocity", "1"),
    "operator_applications": ("applications of the half-space operator on the grid", "1"),
    "steps": ("levels, events, steps, points of a line, or iterations of a peer", "1"),
    "memory": ("most memory that its arrays took", "bytes"),
}


@dataclass(frozen=True)
class Problem:
    """An indenter with h = L = 1 and what is known of it; arrays of shape (levels,).

    depth, force, velocity : u, F/G and vt = (F/G)/(k/G) to compare with
    region_b : whether a level is in region (b)
    hurst, seed : of a rough disc; body : of one with an exact solution; else None
    """

    name: str
    indenter: Indenter
    depth: np.ndarray
    force: np.ndarray
    velocity: np.ndarray
    region_b: np.ndarray
    hurst: float | None = None
    seed: np.random.SeedSequence | None = None
    body: reference.PowerLawBody | None = None

    @property
    def elements(self):
        """Elements across the indenter."""
        return len(self.indenter.heights)


@dataclass(frozen=True)
class Answer:
    """Velocities vt at a problem's levels (nan where unknown), operators and steps that they took.

    seconds : wall and processor time, of an answer that knows them better than who asked for it
    """

    velocity: np.ndarray
    operator_applications: int = 0
    steps: int = 0
    seconds: tuple | None = None


@dataclass(frozen=True)
class Method:
    """A way to the velocities. `run(problem, value)` returns an Answer; `values` are those of the knob, coarse to fine.

    group : what the figure shows alike; largest : most elements across the indenter for which it ends in time
    growth : values for indenters of more than MANY elements across
    """

    name: str
    group: str
    knob: str
    values: tuple
    run: Callable
    largest: int = 4097
    rough_only: bool = False
    growth: tuple = ()


def rough_problem(hurst, elements, levels, root):
    """A self-affine disc, at depths from the second element in contact to FINAL_X or FINAL_FRACTION."""
    seed = realization_seed(root, *method_problem_key(hurst, elements))
    disc = self_affine_disc(hurst, elements, seed=seed)
    coarse = indent(disc, tolerance=1e-2, until_fraction=FINAL_FRACTION, until_force=4 * FINAL_X)
    first = coarse.depth[np.argmax(coarse.contact_count > 1)]
    depth = np.geomspace(1.5 * first, coarse.depth[-1], levels)
    exact = indent(disc, tolerance=EXACT, depths=depth)
    _, kappa = exact.normalised(1.0, 1.0)
    region_b = (exact.contact_count >= REGION_B["elements_min"]) & (kappa <= REGION_B["stiffness_max"])
    name = f"rough disc, H = {hurst:g}, {elements}"
    return Problem(name, disc, depth, exact.force, exact.force / exact.stiffness, region_b, hurst, seed)


def body_problem(name, body, elements, levels):
    """A sphere or a cone, on radii of contact from 0.1 to 0.45 L, with the velocities of the exact solution."""
    indenter = body.indenter(elements)
    depth = body.mdr_profile(np.geomspace(0.1, 0.45, levels))
    force = body.force(depth)
    everywhere = np.ones(levels, dtype=bool)
    return Problem(f"{name}, {elements}", indenter, depth, force, force / body.stiffness(depth), everywhere, body=body)


def named_problem(name, elements, levels, root, hurst=None):
    """A problem by the name of its body, "sphere", "cone" or "rough disc"; the latter has a Hurst exponent."""
    if name == "rough disc":
        return rough_problem(hurst, elements, levels, root)
    return body_problem(name, BODIES[name], elements, levels)


# ---- the elastic path


def _automatic(problem, tolerance):
    """Levels of the path's own choice, and interpolation between them."""
    curve = indent(problem.indenter, tolerance=tolerance, until_fraction=1, until_force=problem.force[-1] * (1 + 1e-12))
    return _interpolated(problem, curve)


def _at_levels(problem, tolerance):
    """Exactly the problem's depths, with the exact tangent stiffness there."""
    curve = indent(problem.indenter, tolerance=tolerance, depths=problem.depth)
    return Answer(curve.force / curve.stiffness, curve.operator_applications, curve.depth.size)


def _each_alone(problem, tolerance):
    """The problem's depths one by one, each from nothing."""
    curves = [indent(problem.indenter, tolerance=tolerance, depths=[depth]) for depth in problem.depth]
    velocity = np.array([curve.force[0] / curve.stiffness[0] for curve in curves])
    return Answer(velocity, sum(curve.operator_applications for curve in curves), len(curves))


def _uniform(problem, levels):
    """So many levels in equal steps of depth, and interpolation between them."""
    depths = np.linspace(0, problem.depth[-1], levels + 1)[1:] * (1 + 1e-12)
    return _interpolated(problem, indent(problem.indenter, tolerance=1e-6, depths=depths))


def _interpolated(problem, curve):
    _, stiffness = curve.at_force(problem.force)
    return Answer(problem.force / stiffness, curve.operator_applications, curve.depth.size)


def _without(part, problem, tolerance):
    with part():
        return _at_levels(problem, tolerance)


# ---- direct integration


def _events(problem, fraction):
    """From contact event to contact event, up to a contact fraction."""
    events = march_events(problem.indenter, until_fraction=fraction)
    last = np.searchsorted(events.impulse, problem.force, side="right") - 1
    resistance = np.where(problem.force <= events.impulse[-1], events.resistance[last], np.nan)
    return Answer(problem.force / resistance, steps=events.impulse.size)


def _steps(scheme, spacing, problem, number):
    """So many steps of impulse, and interpolation between their ends."""
    ends = {
        "logarithmic": partial(np.geomspace, 1e-4 * problem.force[0]),
        "uniform": lambda last, number: np.linspace(0, last, number + 1)[1:],
    }[spacing](problem.force[-1] * (1 + 1e-12), number)
    steps = march_steps(problem.indenter, ends, scheme=scheme)
    inside = problem.force >= ends[0]
    resistance = np.exp(np.interp(np.log(problem.force), np.log(ends), np.log(steps.resistance)))
    return Answer(np.where(inside, problem.force / resistance, np.nan), steps=steps.steps)


def _adaptive_steps(scheme, problem, penetration):
    """Steps as long as no element penetrates deeper than a share of the depth."""
    steps = march_steps(problem.indenter, problem.force, scheme=scheme, overlap=penetration)
    return Answer(problem.force / steps.resistance, steps=steps.steps)


def _implicit(problem, tolerance):
    """Backward Euler steps that end at the problem's impulses."""
    steps = march_steps(problem.indenter, problem.force, scheme="implicit", tolerance=tolerance)
    return Answer(problem.force / steps.resistance, steps=steps.steps)


# ---- peers


def peer_method(peer, longest):
    """A peer as a method: levels in pairs, stiffness by differences, since it gives none itself."""
    return Method(peer.name, "peer", "tolerance", PEER_TOLERANCES, partial(_peer, peer, longest), 257, True)


def _peer(peer, longest, problem, tolerance):
    """Pairs of levels at u (1 ∓ δ), with δ of the order of the error that differences are left with either way."""
    shift = np.clip(np.sqrt(tolerance), 1e-4, 1e-2)
    depths = (problem.depth[:, None] * [1 - shift, 1 + shift]).ravel()
    stiffness = np.repeat(problem.force / problem.velocity, 2)
    forces = np.repeat(problem.force, 2) + stiffness * (depths - np.repeat(problem.depth, 2))
    (found,) = other_solvers.ask(peer, problem.indenter, depths, forces, [tolerance], longest=longest)
    if found is None:
        return Answer(np.full(problem.depth.shape, np.nan), seconds=(longest, longest))
    force, depth = found.force.reshape(-1, 2), found.depth.reshape(-1, 2)
    velocity = force.mean(axis=1) * np.diff(depth)[:, 0] / np.diff(force)[:, 0]
    return Answer(velocity, steps=int(found.iterations.sum()), seconds=(found.wall_s, found.processor_s))


# ---- models


def _reduction(problem, points):
    """MDR: the line of a body of revolution; for a rough disc one random line of the same h, L and H."""
    line = problem.body.mdr_line(points) if problem.body else self_affine_line(problem.hurst, points, seed=problem.seed)
    _, stiffness = reduce(line, until_force=problem.force[-1] * (1 + 1e-12)).at_force(problem.force)
    return Answer(problem.force / stiffness, steps=points)


def _law(problem, gamma):
    """The closed law, Eq. 12, with or without Γ; its unit is h = 1."""
    return Answer(reference.rate_law(problem.force / 4, problem.hurst, gamma=bool(gamma)))


TOLERANCES = (1e-1, 1e-2, 1e-3, 1e-4, 1e-5)
FINE_TOLERANCES = (*TOLERANCES, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10)
PEER_TOLERANCES = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6)
EXPLICIT = tuple(scheme for scheme in SCHEMES if scheme != "implicit")
STEPS = (16, 64, 256, 1024)
LARGEST = {"logarithmic": 257, "uniform": 129}  # elements across, by the spacing of steps
SHARES = (1e-1, 3e-2, 1e-2, 3e-3)
PARTS = {
    "path, double precision": ablations.double_precision,
    "path, single precision only": ablations.single_precision_only,
    "path, no preconditioner": ablations.no_preconditioner,
    "path, preconditioner without blocks": ablations.no_blocks,
    "path, no tangent": ablations.no_tangent,
}

METHODS = (
    Method("path, automatic levels", "path", "tolerance", TOLERANCES, _automatic, growth=(1e-3,)),
    Method("path, at the depths", "path", "tolerance", FINE_TOLERANCES, _at_levels, growth=(1e-6,)),
    *(
        Method(name, "path without a part", "tolerance", (1e-3, 1e-6, 1e-9), partial(_without, part), 257)
        for name, part in PARTS.items()
    ),
    Method("path, each depth alone", "path without a part", "tolerance", (1e-3, 1e-6, 1e-9), _each_alone, 257),
    Method("path, uniform levels", "path without a part", "levels", (8, 32, 128), _uniform, 257),
    Method("events", "marching", "contact fraction", (1.0,), _events, 65),
    Method("events to 5 %", "marching", "contact fraction", (0.05,), _events, 257, rough_only=True),
    *(
        Method(
            f"{scheme}, {spacing} steps", "marching", "steps", STEPS, partial(_steps, scheme, spacing), LARGEST[spacing]
        )
        for scheme in EXPLICIT
        for spacing in ("logarithmic", "uniform")
    ),
    *(
        Method(f"{scheme}, adaptive steps", "marching", "penetration", SHARES, partial(_adaptive_steps, scheme), 129)
        for scheme in EXPLICIT
    ),
    Method("implicit", "marching", "tolerance", (1e-2, 1e-4, 1e-6, 1e-8), _implicit, 257),
    Method("MDR", "model", "points", tuple(2**n for n in range(6, 23, 2)), _reduction),
    Method("Eq. 12 without Γ", "model", "gamma", (0,), _law, rough_only=True),
    Method("Eq. 12 with Γ", "model", "gamma", (1,), _law, rough_only=True),
)


def measure(problem, repeats, methods=METHODS, report=lambda text: None):
    """Cost and error of every method that can do a problem, at every value of its knob.

    repeats : timed repeats after the first run, which gives errors and memory, and the time of what takes over SLOWEST
    report : called with a line of text before each first run

    Returns a pandas.DataFrame with the columns of `COLUMNS`, a row per method and value.
    """
    rows, functions = {}, {}
    for method in methods:
        if problem.elements > method.largest or (method.rough_only and problem.hurst is None):
            continue
        for value in method.values if problem.elements <= MANY else method.growth:
            report(f"{problem.name}: {method.name}, {method.knob} {value:g}")
            function = partial(method.run, problem, value)
            clocks = time.perf_counter(), time.process_time()
            answer, memory = timing.with_memory(function)
            seconds = answer.seconds or (time.perf_counter() - clocks[0], time.process_time() - clocks[1])
            key = method.name, value
            rows[key] = row(problem, method, value, answer, memory) | dict(zip(TIMES, seconds, strict=True))
            if seconds[0] < SLOWEST:
                functions[key] = function
    report(f"{problem.name}: {repeats} repeats")
    for key, seconds in timing.interleaved(functions, repeats).items():
        rows[key] |= dict(zip(TIMES, seconds, strict=True))
    return pd.DataFrame(rows.values(), columns=list(COLUMNS))


def row(problem, method, value, answer, memory):
    """Entries of `COLUMNS`, but for times."""
    deviation = np.nan_to_num(np.abs(answer.velocity / problem.velocity - 1), nan=1.0)
    return {
        "problem": problem.name.rsplit(",", 1)[0],
        "hurst": np.nan if problem.hurst is None else problem.hurst,
        "elements": problem.elements,
        "method": method.name,
        "group": method.group,
        "knob": method.knob,
        "value": float(value),
        "error": np.sqrt(np.mean(deviation**2)),
        "error_b": np.sqrt(np.mean(deviation[problem.region_b] ** 2)) if problem.region_b.any() else np.nan,
        "largest_error": deviation.max(),
        "operator_applications": answer.operator_applications,
        "steps": answer.steps,
        "memory": memory,
    }
