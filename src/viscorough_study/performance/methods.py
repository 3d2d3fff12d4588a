"""Define all methods that compute the velocity of penetration.

A method solves a Problem (performance.problems): it computes the velocities vt = (F/G)/(k/G) at the levels (depths) of
the problem. Each method has a parameter that trades accuracy for cost; performance.measurement measures accuracy and
cost.
"""

import warnings
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from viscorough import reference
from viscorough.basics.errors import AccuracyWarning
from viscorough.contact.loading_path import indent
from viscorough.mdr import reduce
from viscorough.surfaces.lines import self_affine_line
from viscorough.viscous.integration.events import newtonian_events
from viscorough_study.performance.explicit_steps import explicit_steps


@dataclass(frozen=True)
class Method:
    """A method, and the values of its parameter that are measured.

    name, group : names of the method and of its group in tables and figures
    parameter : name of the parameter that trades accuracy for cost; values : its values, from coarse to fine
    run : function of a Problem and a value; returns the velocities vt at the levels of the problem, and the number of
        steps (levels of a curve, events, time steps, or points of a line)
    largest : largest number of elements across the indenters on which the method is measured
    rough_only : True if the method applies to rough discs only
    """

    name: str
    group: str
    parameter: str
    values: tuple
    run: Callable
    largest: int = 1025
    rough_only: bool = False


# ---- methods that compute elastic loading curves


def _automatic(problem, tolerance):
    """Interpolate the velocities on a loading curve; `indent` chooses the depths of this curve automatically."""
    curve = indent(problem.indenter, tolerance=tolerance, until_fraction=1, until_force=problem.force[-1] * (1 + 1e-12))
    _, stiffness = curve.at_force(problem.force)
    return problem.force / stiffness, curve.depth.size


def _at_levels(problem, tolerance):
    """Compute the velocities by contacts at the depths of the problem, so that no interpolation is needed."""
    curve = indent(problem.indenter, tolerance=tolerance, depths=problem.depth)
    return curve.force / curve.stiffness, curve.depth.size


# ---- direct integration of the viscous problem


def _events(problem, fraction):
    """Compute the velocities by integration in time from contact event to contact event, up to a contact fraction."""
    events = newtonian_events(problem.indenter, until_fraction=fraction)
    return problem.force / events.resistance[events.event_at(problem.force)], events.impulse.size


def _steps(problem, number):
    """Compute the velocities by integration of the viscous problem in time steps, and by interpolation between them.

    number : number of steps; the impulses ∫F dt/η at the ends of the steps are in equal ratios
    """
    ends = np.geomspace(1e-4 * problem.force[0], problem.force[-1] * (1 + 1e-12), number)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", AccuracyWarning)  # the error of too few steps is measured, too
        steps = explicit_steps(problem.indenter, ends)
    resistance = np.exp(np.interp(np.log(problem.force), np.log(ends), np.log(steps.resistance)))
    return problem.force / resistance, steps.impulse.size


# ---- approximate models


def _reduction(problem, points):
    """Compute the velocities by the method of dimensionality reduction (MDR), from a line that represents the indenter.

    The line of a body of revolution is exactly equivalent to the body. The line of a rough disc is random, with the
    same h, L and H as the disc.
    points : number of points of the line
    """
    line = problem.body.mdr_line(points) if problem.body else self_affine_line(problem.hurst, points, seed=problem.seed)
    _, stiffness = reduce(line, until_force=problem.force[-1] * (1 + 1e-12)).at_force(problem.force)
    return problem.force / stiffness, points


def _law(problem, gamma):
    """Compute the velocities by the paper's law, Eq. 12, in units of h = 1.

    gamma : 1 with the factor 1/Γ(2−α), 0 without this factor
    """
    return reference.rate_law(problem.force / 4, problem.hurst, gamma=bool(gamma)), 0


TOLERANCES = (1e-1, 1e-2, 1e-3, 1e-4, 1e-5)
FINE_TOLERANCES = (*TOLERANCES, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10)
STEPS = (16, 64, 256, 1024)

METHODS = (
    Method("path, automatic levels", "path", "tolerance", TOLERANCES, _automatic),
    Method("path, at the depths", "path", "tolerance", FINE_TOLERANCES, _at_levels),
    Method("events", "marching", "contact fraction", (1.0,), _events, 65),
    Method("explicit, logarithmic steps", "marching", "steps", STEPS, _steps, 257),
    Method("MDR", "model", "points", tuple(2**n for n in range(6, 23, 2)), _reduction),
    Method("Eq. 12 without Γ", "model", "gamma", (0,), _law, rough_only=True),
    Method("Eq. 12 with Γ", "model", "gamma", (1,), _law, rough_only=True),
)
