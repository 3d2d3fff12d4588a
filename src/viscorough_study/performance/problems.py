"""Define the indenters for the comparison of methods, with reference velocities of penetration.

The velocity v under constant force is given as vt = (F/G)/(k/G), a length (paper, Eqs. 1-3: vt/h = X/κ).
"""

from dataclasses import dataclass

import numpy as np

from viscorough import reference
from viscorough.contact.loading_path import indent
from viscorough.surfaces.indenter import Indenter
from viscorough.surfaces.self_affine import self_affine_disc
from viscorough_study.run.seeds import method_problem_key, realization_seed

BODIES = {"sphere": reference.sphere(1.0), "cone": reference.cone(0.1)}
FINAL_X, FINAL_FRACTION = 30.0, 0.9  # the curve of a rough disc ends at this X, or earlier at this contact fraction
REFERENCE_TOLERANCE = 1e-11  # tolerance of the reference velocities of rough discs


@dataclass(frozen=True)
class Problem:
    """An indenter with L = 1 (a rough disc also has h = 1), and its reference solution; arrays of shape (levels,).

    depth, force, velocity : u, F/G and vt = (F/G)/(k/G) of the reference solution
    hurst, seed : Hurst exponent and seed of a rough disc; nan and None for a body of revolution
    body : body of revolution, whose solution is exact; None for a rough disc
    """

    name: str
    indenter: Indenter
    depth: np.ndarray
    force: np.ndarray
    velocity: np.ndarray
    hurst: float = np.nan
    seed: np.random.SeedSequence | None = None
    body: reference.PowerLawBody | None = None


def named_problem(name, elements, levels, *, root=None, hurst=None):
    """Return the Problem of an indenter named "sphere", "cone" or "rough disc" (self-affine).

    elements : number of elements across the indenter; levels : number of depths
    root, hurst : root seed and Hurst exponent of a rough disc
    For sphere and cone, the contact radii are 0.1 to 0.45 L, and the reference velocities are exact. On a rough disc,
    each depth is the same multiple of the previous depth. The smallest depth is 1.5 times the depth at which at least
    two elements are in contact. At the largest depth, X = FINAL_X or the contact fraction FINAL_FRACTION is reached,
    whichever is reached first.
    """
    if name == "rough disc":
        seed = realization_seed(root, *method_problem_key(hurst, elements))
        disc = self_affine_disc(hurst, elements, seed=seed)
        coarse = indent(disc, tolerance=1e-2, until_fraction=FINAL_FRACTION, until_force=4 * FINAL_X)
        first = coarse.depth[np.argmax(coarse.contact_count > 1)]
        depth = np.geomspace(1.5 * first, coarse.depth[-1], levels)
        exact = indent(disc, tolerance=REFERENCE_TOLERANCE, depths=depth)
        velocity = exact.force / exact.stiffness
        return Problem(f"rough disc, H = {hurst:g}", disc, depth, exact.force, velocity, hurst=hurst, seed=seed)
    body = BODIES[name]
    depth = body.mdr_profile(np.geomspace(0.1, 0.45, levels))
    force, indenter = body.force(depth), body.indenter(elements)
    return Problem(name, indenter, depth, force, force / body.stiffness(depth), body=body)
