"""All methods for the velocity of penetration.

A method solves a Problem: it gives the velocities vt = (F/G)/(k/G) at the problem's levels. Each method has a parameter
that trades accuracy for cost; `measurement` measures both.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from viscorough import reference
from viscorough.contact.loading_path import indent
from viscorough.contact.options import DEFAULT
from viscorough.mdr import reduce
from viscorough.surfaces import self_affine_line
from viscorough.viscous.integration.events import march_events
from viscorough.viscous.integration.stepping import SCHEMES, march_steps
from viscorough_study.performance import ablations, other_solvers


@dataclass(frozen=True)
class Answer:
    """Velocities vt at a problem's levels (nan where unknown), and their cost.

    operator_applications : of the half-space operator on the grid; steps : levels, events, time steps or points
    seconds : wall and processor time reported by a method that runs in another process
    """

    velocity: np.ndarray
    operator_applications: int = 0
    steps: int = 0
    seconds: tuple | None = None


@dataclass(frozen=True)
class Method:
    """A method; `run(problem, value)` returns an Answer, `values` are those of its parameter, from coarse to fine.

    group : of methods in tables and figures; largest : elements across the indenter up to which it is measured
    rough_only : whether it applies to rough discs only
    growth : values of the parameter for indenters too large for a comparison of errors
    """

    name: str
    group: str
    parameter: str
    values: tuple
    run: Callable
    largest: int = 4097
    rough_only: bool = False
    growth: tuple = ()


# ---- the elastic loading path


def _automatic(problem, tolerance):
    """Levels chosen automatically, and interpolation between them."""
    curve = indent(problem.indenter, tolerance=tolerance, until_fraction=1, until_force=problem.force[-1] * (1 + 1e-12))
    return _interpolated(problem, curve)


def _at_levels(problem, tolerance, options=DEFAULT):
    """Exactly the problem's depths, with the exact tangent stiffness there."""
    curve = indent(problem.indenter, tolerance=tolerance, depths=problem.depth, options=options)
    return Answer(curve.force / curve.stiffness, curve.operator_applications, curve.depth.size)


def _each_alone(problem, tolerance):
    """The problem's depths one by one, each solved without a previous level."""
    curves = [indent(problem.indenter, tolerance=tolerance, depths=[depth]) for depth in problem.depth]
    velocity = np.array([curve.force[0] / curve.stiffness[0] for curve in curves])
    return Answer(velocity, sum(curve.operator_applications for curve in curves), len(curves))


def _uniform(problem, levels):
    """A number of levels in equal steps of depth, and interpolation between them."""
    depths = np.linspace(0, problem.depth[-1], levels + 1)[1:] * (1 + 1e-12)
    return _interpolated(problem, indent(problem.indenter, tolerance=1e-6, depths=depths))


def _interpolated(problem, curve):
    _, stiffness = curve.at_force(problem.force)
    return Answer(problem.force / stiffness, curve.operator_applications, curve.depth.size)


# ---- direct integration


def _events(problem, fraction):
    """Direct integration from contact event to contact event, up to a contact fraction."""
    events = march_events(problem.indenter, until_fraction=fraction)
    last = np.searchsorted(events.impulse, problem.force, side="right") - 1
    resistance = np.where(problem.force <= events.impulse[-1], events.resistance[last], np.nan)
    return Answer(problem.force / resistance, steps=events.impulse.size)


def _steps(scheme, spacing, problem, number):
    """A number of steps of the impulse, and interpolation between their ends."""
    last = problem.force[-1] * (1 + 1e-12)
    uniform = np.linspace(0, last, number + 1)[1:]
    ends = uniform if spacing == "uniform" else np.geomspace(1e-4 * problem.force[0], last, number)
    steps = march_steps(problem.indenter, ends, scheme=scheme)
    inside = problem.force >= ends[0]
    resistance = np.exp(np.interp(np.log(problem.force), np.log(ends), np.log(steps.resistance)))
    return Answer(np.where(inside, problem.force / resistance, np.nan), steps=steps.steps)


def _adaptive_steps(scheme, problem, overlap):
    """The longest steps in which no element overlaps the half-space by more than a fraction of the depth."""
    steps = march_steps(problem.indenter, problem.force, scheme=scheme, overlap=overlap)
    return Answer(problem.force / steps.resistance, steps=steps.steps)


def _implicit(problem, tolerance):
    """Backward Euler steps that end at the problem's impulses."""
    steps = march_steps(problem.indenter, problem.force, scheme="implicit", tolerance=tolerance)
    return Answer(problem.force / steps.resistance, steps=steps.steps)


# ---- other solvers


def other_solver_method(solver, time_limit):
    """Another solver as a method: pairs of levels, whose differences give the stiffness that it does not report."""
    run = partial(_other_solver, solver, time_limit)
    return Method(solver.name, "other solver", "tolerance", OTHER_SOLVER_TOLERANCES, run, largest=257, rough_only=True)


def _other_solver(solver, time_limit, problem, tolerance):
    """Pairs of levels at u (1 ∓ δ), where δ balances the truncation error of the difference with the tolerance."""
    shift = np.clip(np.sqrt(tolerance), 1e-4, 1e-2)
    depths = (problem.depth[:, None] * [1 - shift, 1 + shift]).ravel()
    stiffness = np.repeat(problem.force / problem.velocity, 2)
    forces = np.repeat(problem.force, 2) + stiffness * (depths - np.repeat(problem.depth, 2))
    solution = other_solvers.solve(solver, problem.indenter, depths, forces, tolerance, time_limit=time_limit)
    if solution is None:
        return Answer(np.full(problem.depth.shape, np.nan), seconds=(time_limit, time_limit))
    force, depth = solution.force.reshape(-1, 2), solution.depth.reshape(-1, 2)
    velocity = force.mean(axis=1) * np.diff(depth)[:, 0] / np.diff(force)[:, 0]
    return Answer(velocity, steps=int(solution.iterations.sum()), seconds=(solution.wall_s, solution.processor_s))


# ---- models


def _reduction(problem, points):
    """MDR with the exact line of a body of revolution, or for a rough disc one random line of the same h, L and H."""
    line = problem.body.mdr_line(points) if problem.body else self_affine_line(problem.hurst, points, seed=problem.seed)
    _, stiffness = reduce(line, until_force=problem.force[-1] * (1 + 1e-12)).at_force(problem.force)
    return Answer(problem.force / stiffness, steps=points)


def _law(problem, gamma):
    """The closed law, Eq. 12, with or without the factor 1/Γ(2−α), in units of h = 1."""
    return Answer(reference.rate_law(problem.force / 4, problem.hurst, gamma=bool(gamma)))


TOLERANCES = (1e-1, 1e-2, 1e-3, 1e-4, 1e-5)
FINE_TOLERANCES = (*TOLERANCES, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10)
OTHER_SOLVER_TOLERANCES = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6)
EXPLICIT = tuple(scheme for scheme in SCHEMES if scheme != "implicit")
STEPS = (16, 64, 256, 1024)
LARGEST = {"logarithmic": 257, "uniform": 129}  # elements across, by the spacing of the time steps
OVERLAPS = (1e-1, 3e-2, 1e-2, 3e-3)
PARTS = {
    "path, double precision": ablations.DOUBLE_PRECISION,
    "path, single precision only": ablations.SINGLE_PRECISION_ONLY,
    "path, no preconditioner": ablations.NO_PRECONDITIONER,
    "path, no coarse correction": ablations.NO_COARSE_CORRECTION,
    "path, no tangent": ablations.NO_TANGENT,
}

METHODS = (
    Method("path, automatic levels", "path", "tolerance", TOLERANCES, _automatic, growth=(1e-3,)),
    Method("path, at the depths", "path", "tolerance", FINE_TOLERANCES, _at_levels, growth=(1e-6,)),
    *(
        Method(name, "path without a part", "tolerance", (1e-3, 1e-6, 1e-9), partial(_at_levels, options=options), 257)
        for name, options in PARTS.items()
    ),
    Method("path, each depth alone", "path without a part", "tolerance", (1e-3, 1e-6, 1e-9), _each_alone, 257),
    Method("path, uniform levels", "path without a part", "levels", (8, 32, 128), _uniform, 257),
    Method("events", "marching", "contact fraction", (1.0,), _events, 65),
    Method("events to 5 %", "marching", "contact fraction", (0.05,), _events, 257, rough_only=True),
    *(
        Method(f"{scheme}, {spacing} steps", "marching", "steps", STEPS, partial(_steps, scheme, spacing), largest)
        for scheme in EXPLICIT
        for spacing, largest in LARGEST.items()
    ),
    *(
        Method(f"{scheme}, adaptive steps", "marching", "overlap", OVERLAPS, partial(_adaptive_steps, scheme), 129)
        for scheme in EXPLICIT
    ),
    Method("implicit", "marching", "tolerance", (1e-2, 1e-4, 1e-6, 1e-8), _implicit, 257),
    Method("MDR", "model", "points", tuple(2**n for n in range(6, 23, 2)), _reduction),
    Method("Eq. 12 without Γ", "model", "gamma", (0,), _law, rough_only=True),
    Method("Eq. 12 with Γ", "model", "gamma", (1,), _law, rough_only=True),
)
