"""Judge claims on the variables that determine the contact, tested on one small rough disc.

These claims follow from the equations of the contact for every surface, so a small disc shows them without scatter.
Some claims are tested by integration in time, which solves a contact problem in every step. The integration never uses
the correspondence with the elastic problem, so its results are independent evidence.
"""

from itertools import pairwise

import numpy as np

from viscorough.contact.loading_path import indent
from viscorough.contact.one_contact import contact_at
from viscorough.media.kinds import Newtonian
from viscorough.media.load import Load
from viscorough.surfaces.indenter import Indenter
from viscorough.surfaces.self_affine import self_affine_disc
from viscorough.viscous.integration.internal_variables import integrate_steps
from viscorough.viscous.integration.march import march
from viscorough_study.run.seeds import gamma_factor_key, realization_seed
from viscorough_study.verdicts.evidence import exact, hurst_name

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
# Pairs (F/(hL), viscosity); the same disc is indented with each pair.
DRIVES = ((1.0, 1.0), (1.0, 5.0), (1e-2, 1.0), (30.0, 0.2))
STEPS = 10  # number of time steps in each direct integration; the impulse ∫F dt of all steps is equal


def _disc(evidence, hurst):
    """Return a small disc with the given Hurst exponent, rms height 1 and diameter 1."""
    return self_affine_disc(hurst, ACROSS, seed=realization_seed(evidence.seed, *gamma_factor_key(hurst)))


def _case(name, deviations, tolerance):
    """Return a verdict: whether several deviations, which should be zero, are all within the tolerance.

    name : name of the verdict, which says for what the deviations were computed
    """
    return exact(name, max(deviations), 0.0, max(deviations) <= tolerance, deviations)


def history(evidence, tolerance):
    """Test whether force histories of equal impulse end at equal depths with equal contact.

    Two numbers are tested for each pair of histories: the number of elements that are in contact after only one of the
    two histories, and the relative difference of the depths.
    """
    disc = _disc(evidence, min(evidence.pooled))
    histories = [(times, IMPULSE * np.array(forces)) for times, forces in HISTORIES.values()]
    motions = [integrate_steps(disc, Newtonian(1.0), Load(times, force=force)) for times, force in histories]
    sets, depths = [pressure > 0 for _, pressure in motions], [motion.depth[-1] for motion, _ in motions]
    differing = [int((first != second).sum()) for first, second in pairwise(sets)]
    apart = [abs(second / first - 1) for first, second in pairwise(depths)]
    number = int(sets[0].sum())
    yield _case(f"elements that differ, of {number}", differing, 0)
    yield _case("relative difference of depths", apart, tolerance)


def depth_over_rms(evidence, tolerance):
    """Test whether the contact stays the same if the depth u and the rms height h are multiplied by the same factor.

    The claim is tested for each Hurst exponent. The tested value is the number of elements that are in contact only
    before, or only after the multiplication.
    """
    for hurst in evidence.pooled:
        disc = _disc(evidence, hurst)
        touching = contact_at(disc, depth=DEPTH).contact
        scaled = [contact_at(Indenter(s * disc.heights, disc.spacing), depth=s * DEPTH) for s in SCALES]
        differing = [int((contact.contact != touching).sum()) for contact in scaled]
        number = int((touching == 1).sum())
        yield _case(f"{hurst_name(hurst)}, elements that differ, of {number}", differing, tolerance)


def one_surface(evidence, tolerance):
    """Test whether dimensionless results for one surface are the same for other sizes, forces and viscosities.

    For every Hurst exponent, the stiffness κ(X) is compared between surfaces with other heights and other diameters.
    For the smallest Hurst exponent, F/(ηvL) is also compared between direct integrations in time with other forces and
    viscosities. The values are compared at equal Ft/η, where the contacts are equal.
    """
    for hurst in evidence.pooled:
        disc = _disc(evidence, hurst)
        curve = _stiffness(disc, 1.0, 1.0)
        scaled = [_stiffness(Indenter(h * disc.heights, length * disc.spacing), h, length) for h, length in UNITS]
        yield _case(hurst_name(hurst), [np.max(np.abs(values / curve - 1)) for values in scaled], tolerance)
    disc = _disc(evidence, min(evidence.pooled))
    first, *others = (_resistance(disc, *drive) for drive in DRIVES)
    yield _case("other forces and viscosities", [np.max(np.abs(values / first - 1)) for values in others], tolerance)


def _resistance(disc, force, viscosity):
    """Return F/(ηvL) in each step of a direct integration in time, with the mean velocity v of the step.

    The impulse Ft/η of all steps is equal.
    """
    times = np.linspace(0.0, IMPULSE * viscosity / force, STEPS + 1)
    depth = march(disc, Load(times, force=np.full(times.size, force)), Newtonian(viscosity)).depth
    return force / (viscosity * np.diff(depth) / np.diff(times))


def _stiffness(indenter, rms, diameter):
    """Return the dimensionless stiffness κ at the forces X in `FORCES`.

    The surface of the indenter has the given rms height and diameter.
    """
    force = 4 * rms * diameter * FORCES
    return indent(indenter, until_force=force[-1]).at_force(force)[1] / diameter
