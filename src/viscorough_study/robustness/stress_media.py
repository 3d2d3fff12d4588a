"""Solutions of a stress-test case in a viscoelastic medium: by the correspondence, and by direct integration in steps.

The reference is the direct integration from contact event to contact event, exact while the contact grows; for receding
contact it is one in many steps. Cases without a medium are those of a Newtonian one under a constant force.
"""

from itertools import pairwise

import numpy as np

from viscorough.contact.loading_path import indent
from viscorough.viscous.correspondence import impulses, kinetics
from viscorough.viscous.integration.internal_variable_events import march_medium_events
from viscorough.viscous.integration.internal_variables import march_medium
from viscorough.viscous.media import Newtonian

TOLERANCE = 1e-6  # of loading curves
STEPS, REFERENCE_STEPS = 64, 1024  # between the samples of a force


def by_correspondence(case, solution):
    """Depths by the correspondence, over those of the reference."""
    curve = indent(case.indenter, tolerance=TOLERANCE, until_fraction=1.0, until_force=solution.force[-1])
    if case.medium is None:
        return kinetics(curve, 1.0, Newtonian(1.0), solution.force).depth / solution.depth
    times, force = _history(case, solution)
    depth = kinetics(curve, impulses(force, times), case.medium).depth
    return _ratios(depth, _reference(case, solution))


def by_steps(case, solution):
    """Depths by the second-order steps of direct integration, over those of the reference."""
    if case.medium is None:
        times = np.append(0.0, solution.force)
        moved = march_medium(case.indenter, Newtonian(1.0), times, force=np.ones(times.size))
        return moved.depth[1:] / solution.depth
    return _ratios(_stepped(case, solution, STEPS), _reference(case, solution))


def _history(case, solution):
    """Times from 0 to 1, with steps, and a force whose elastic equivalent stays below the solution's last force."""
    times, shape = np.array(case.medium_load).T
    largest = solution.force[-1] / case.medium.creep_compliance(times[-1]) / shape.max()
    return times, 0.999 * largest * shape


def _reference(case, solution):
    times, force = _history(case, solution)
    if case.recedes:
        return _stepped(case, solution, REFERENCE_STEPS)
    until = min(1.0, (1.1 * solution.count[-1] + 2) / case.indenter.elements)
    return march_medium_events(case.indenter, case.medium, times, force=force, until_fraction=until).depth


def _stepped(case, solution, number):
    """Depths at the samples of the force, with `number` steps between them, shorter ones first."""
    times, force = _history(case, solution)
    fine, place = [times[:1]], [0]
    for start, end in pairwise(times):
        steps = [end] if start == end else start + (end - start) * np.linspace(0, 1, number + 1)[1:] ** 2
        fine.append(np.asarray(steps))
        place.append(place[-1] + len(steps))
    fine = np.concatenate(fine)
    step = np.flatnonzero(np.diff(times) == 0)
    loads = np.interp(fine, times, force)
    for k in step:  # np.interp returns the force after the step at both
        loads[place[k]], loads[place[k + 1]] = force[k], force[k + 1]
    return march_medium(case.indenter, case.medium, fine, force=loads).depth[place]


def _ratios(depth, reference):
    loaded = reference > 0
    return depth[loaded] / reference[loaded]
