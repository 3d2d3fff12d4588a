"""All methods for the velocity of penetration.

A method solves a Problem: it gives the velocities vt = (F/G)/(k/G) at the problem's levels. Each method has a parameter
that trades accuracy for cost; `measurement` measures both.
"""

import warnings
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from viscorough import reference
from viscorough.basics.errors import AccuracyWarning
from viscorough.contact.loading_path import indent
from viscorough.mdr import reduce
from viscorough.surfaces.self_affine import self_affine_line
from viscorough.viscous.integration.events import march_events
from viscorough.viscous.integration.stepping import march_steps


@dataclass(frozen=True)
class Method:
    """A method; `values` are the values of its parameter, from coarse to fine.

    run : function of problem and value; returns the velocities vt at the problem's levels, and the number of steps:
        levels, events, time steps or points
    group : group in tables and figures; largest : largest number of elements across in measurements
    rough_only : True if it applies to rough discs only
    """

    name: str
    group: str
    parameter: str
    values: tuple
    run: Callable
    largest: int = 1025
    rough_only: bool = False


# ---- the elastic loading path


def _automatic(problem, tolerance):
    """Choose levels automatically, and interpolate between them."""
    curve = indent(problem.indenter, tolerance=tolerance, until_fraction=1, until_force=problem.force[-1] * (1 + 1e-12))
    _, stiffness = curve.at_force(problem.force)
    return problem.force / stiffness, curve.depth.size


def _at_levels(problem, tolerance):
    """Take exactly the problem's depths, with the exact tangent stiffness there."""
    curve = indent(problem.indenter, tolerance=tolerance, depths=problem.depth)
    return curve.force / curve.stiffness, curve.depth.size


# ---- direct integration


def _events(problem, fraction):
    """Integrate directly from contact event to contact event, up to a contact fraction."""
    events = march_events(problem.indenter, until_fraction=fraction)
    return problem.force / events.resistance[events.event_at(problem.force)], events.impulse.size


def _steps(scheme, problem, number):
    """Take a number of steps of the impulse in equal ratios, and interpolate between their ends."""
    ends = np.geomspace(1e-4 * problem.force[0], problem.force[-1] * (1 + 1e-12), number)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", AccuracyWarning)  # the table contains the error of too few steps
        steps = march_steps(problem.indenter, ends, scheme=scheme)
    resistance = np.exp(np.interp(np.log(problem.force), np.log(ends), np.log(steps.resistance)))
    return problem.force / resistance, steps.impulse.size


def _implicit(problem, tolerance):
    """Take backward Euler steps that end at the problem's impulses."""
    steps = march_steps(problem.indenter, problem.force, scheme="implicit", tolerance=tolerance)
    return problem.force / steps.resistance, steps.impulse.size


# ---- models


def _reduction(problem, points):
    """Apply the MDR to a body's exact line, or for a rough disc to one random line of the same h, L and H."""
    line = problem.body.mdr_line(points) if problem.body else self_affine_line(problem.hurst, points, seed=problem.seed)
    _, stiffness = reduce(line, until_force=problem.force[-1] * (1 + 1e-12)).at_force(problem.force)
    return problem.force / stiffness, points


def _law(problem, gamma):
    """Evaluate the closed law, Eq. 12, with or without the factor 1/Γ(2−α), in units of h = 1."""
    return reference.rate_law(problem.force / 4, problem.hurst, gamma=bool(gamma)), 0


TOLERANCES = (1e-1, 1e-2, 1e-3, 1e-4, 1e-5)
FINE_TOLERANCES = (*TOLERANCES, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10)
STEPS = (16, 64, 256, 1024)

METHODS = (
    Method("path, automatic levels", "path", "tolerance", TOLERANCES, _automatic),
    Method("path, at the depths", "path", "tolerance", FINE_TOLERANCES, _at_levels),
    Method("events", "marching", "contact fraction", (1.0,), _events, 65),
    Method("explicit, logarithmic steps", "marching", "steps", STEPS, partial(_steps, "explicit"), 257),
    Method("heun, logarithmic steps", "marching", "steps", STEPS, partial(_steps, "heun"), 257),
    Method("implicit", "marching", "tolerance", (1e-2, 1e-4, 1e-6, 1e-8), _implicit, 257),
    Method("MDR", "model", "points", tuple(2**n for n in range(6, 23, 2)), _reduction),
    Method("Eq. 12 without Γ", "model", "gamma", (0,), _law, rough_only=True),
    Method("Eq. 12 with Γ", "model", "gamma", (1,), _law, rough_only=True),
)
