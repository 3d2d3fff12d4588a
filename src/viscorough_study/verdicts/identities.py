"""Statements of the paper that follow from the equations of the contact, for every surface.

They cannot fail by the physics, so they are one entry of the table of verdicts, and are not counted. They are evaluated
on one small rough disc for each Hurst exponent, where they hold without scatter, and on the curves of all discs.
"""

from itertools import pairwise

import numpy as np

from viscorough import reference
from viscorough.contact.loading_path import indent
from viscorough.contact.one_contact import contact_at
from viscorough.media.kinds import Newtonian
from viscorough.media.load import Load
from viscorough.surfaces.indenter import Indenter
from viscorough.surfaces.self_affine import self_affine_disc
from viscorough.viscous.integration.internal_variables import integrate_steps
from viscorough_study.run.seeds import gamma_factor_key, realization_seed
from viscorough_study.verdicts.claim import claim
from viscorough_study.verdicts.evidence import exact

ACROSS = 33  # number of elements across the diameter of the disc
DEPTH = 1.5  # depth divided by the rms height; some tens of elements are then in contact
IMPULSE = 2.0  # value of ∫F dt/(ηhL) at the end of each force history
# {force history: (times, forces divided by IMPULSE)}. The force is linear between the times, and jumps where a time is
# repeated.
HISTORIES = {
    "constant": ([0.0, 1.0], [1.0, 1.0]),
    "growing": ([0.0, 0.25, 0.5, 0.75, 1.0], [0.0, 0.5, 1.0, 1.5, 2.0]),
    "with rests": (
        [0.0, 0.2, 0.2, 0.6, 0.6, 0.8, 0.8, 0.9, 0.9, 1.0],
        [2.0, 2.0, 0.0, 0.0, 2.0, 2.0, 0.0, 0.0, 2.0, 2.0],
    ),
}
SCALES = (1e-3, 0.2, 7.0)  # factors that multiply both the heights and the depth
# Pairs of factors that rescale a surface: (factor of the heights, factor of the lengths in the plane).
UNITS = ((7.0, 1.0), (1e-3, 3.0), (0.2, 1e-2))
FORCES = np.geomspace(1e-3, 1, 31)  # values of X, the dimensionless force F/(4GhL), at which curves are compared
# Largest contact count that still means a single element. Logarithmic interpolation of counts causes rounding errors.
ONE_ELEMENT = 1 + 1e-9


@claim(
    title="identities of the contact problem",
    sentence="the contact depends on the depth only, not on the history; it does not change if depth and rms height "
    "are multiplied by one factor; force, viscosity, diameter and rms height enter by Ft/(ηhL) alone, so on "
    "one kind of surface and grid the exponents do not depend on them (how they depend on H, grid and reading is "
    "judged above); and while “exactly one element” touches, the indenter moves at constant velocity",
    where="abstract, Secs. II and III",
    kind="identity",
    quantity="elements that differ, or largest relative difference",
    criterion="no element differs, and relative differences are below the tolerance",
    tolerance=1e-6,
    reason="these statements hold by the equations, so rounding alone can differ",
    figure="fig2_kinetics",
)
def identities(evidence, tolerance):
    """Evaluate the identities; yield a case for each."""
    elements, depths = _histories(evidence)
    found = {
        "history, elements that differ": elements,
        "history, depth": depths,
        "u and h multiplied by one factor, elements that differ": _scaled_contacts(evidence),
        "heights and diameters in other units, stiffness": _scaled_curves(evidence),
        "one element in contact, stiffness": _one_element(evidence),
    }
    for name, differences in found.items():
        yield exact(name, max(differences), 0.0, max(differences) <= tolerance, differences)


def _discs(evidence):
    """Return a small disc with rms height 1 and diameter 1 for each Hurst exponent."""
    seeds = {hurst: realization_seed(evidence.seed, *gamma_factor_key(hurst)) for hurst in evidence.pooled}
    return [self_affine_disc(hurst, ACROSS, seed=seed) for hurst, seed in seeds.items()]


def _histories(evidence):
    """Compare neighbouring force histories of equal impulse by direct integration in time.

    Return the numbers of elements that are in contact after only one of two histories, and the relative differences of
    the depths.
    """
    disc = _discs(evidence)[0]
    loads = [Load(times, force=IMPULSE * np.array(forces)) for times, forces in HISTORIES.values()]
    motions = [integrate_steps(disc, Newtonian(1.0), load) for load in loads]
    sets, depths = [pressure > 0 for _, pressure in motions], [motion.depth[-1] for motion, _ in motions]
    differing = [int((first != second).sum()) for first, second in pairwise(sets)]
    return differing, [abs(second / first - 1) for first, second in pairwise(depths)]


def _scaled_contacts(evidence):
    """Return the numbers of elements in contact only before, or only after heights and depth are multiplied."""
    differing = []
    for disc in _discs(evidence):
        touching = contact_at(disc, depth=DEPTH).contact
        scaled = [contact_at(Indenter(s * disc.heights, disc.spacing), depth=s * DEPTH) for s in SCALES]
        differing += [int((contact.contact != touching).sum()) for contact in scaled]
    return differing


def _scaled_curves(evidence):
    """Return the largest relative differences of κ(X) between surfaces with other heights and other diameters."""
    differences = []
    for disc in _discs(evidence):
        curve = _stiffness(disc, 1.0, 1.0)
        scaled = [_stiffness(Indenter(h * disc.heights, length * disc.spacing), h, length) for h, length in UNITS]
        differences += [np.max(np.abs(values / curve - 1)) for values in scaled]
    return differences


def _stiffness(indenter, rms, diameter):
    """Return the dimensionless stiffness κ at the forces X in `FORCES`.

    The surface of the indenter has the given rms height and diameter.
    """
    force = 4 * rms * diameter * FORCES
    return indent(indenter, until_force=force[-1]).at_force(force)[1] / diameter


def _one_element(evidence):
    """Return the largest relative differences of κ from π/(K₀₀ n) in region (a), where a single element touches.

    n is the number of elements across; `reference.one_element_stiffness` defines K₀₀.
    """
    differences = []
    for ensemble in evidence.pooled.values():
        alone = ensemble["contact_count"].values <= ONE_ELEMENT
        ratio = ensemble["stiffness"].values[alone] / reference.one_element_stiffness(evidence.across)
        differences.append(np.max(np.abs(ratio - 1), initial=0.0))
    return differences
