"""Judge claims on the variables that determine the contact, tested on one small rough disc.

These claims follow from the equations of the contact for every surface, so a small disc shows them without scatter. The
integration in time, which some of them use, solves a contact problem in every step. It never uses the correspondence
with the elastic problem, so its results are independent evidence.
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

ACROSS = 33  # number of elements across the disc
DEPTH = 1.5  # depth in rms heights, so that some tens of elements are in contact
IMPULSE = 2.0  # ∫F dt/(ηhL) at the end of each force history
# {history: (times, forces divided by IMPULSE)}. The force is linear between times, and steps at a repeated time.
HISTORIES = {
    "constant": ([0.0, 1.0], [1.0, 1.0]),
    "growing": ([0.0, 0.25, 0.5, 0.75, 1.0], [0.0, 0.5, 1.0, 1.5, 2.0]),
    "with rests": (
        [0.0, 0.2, 0.2, 0.6, 0.6, 0.8, 0.8, 0.9, 0.9, 1.0],
        [2.0, 2.0, 0.0, 0.0, 2.0, 2.0, 0.0, 0.0, 2.0, 2.0],
    ),
}
SCALES = (1e-3, 0.2, 7.0)  # common factors of heights and depth
# pairs (factor of the heights, factor of the lengths in the plane)
UNITS = ((7.0, 1.0), (1e-3, 3.0), (0.2, 1e-2))
FORCES = np.geomspace(1e-3, 1, 31)  # values of X where curves are compared
# pairs (F/(hL), viscosity) for indentations of one disc
DRIVES = ((1.0, 1.0), (1.0, 5.0), (1e-2, 1.0), (30.0, 0.2))
STEPS = 10  # number of steps, of equal impulse, in each direct integration


def _disc(evidence, hurst):
    """Return the small disc of a Hurst exponent, with rms height 1 and diameter 1."""
    return self_affine_disc(hurst, ACROSS, seed=realization_seed(evidence.seed, *gamma_factor_key(hurst)))


def _case(name, deviations, tolerance):
    """Return the case of several deviations that should vanish, judged by the largest of them."""
    return exact(name, max(deviations), 0.0, max(deviations) <= tolerance, deviations)


def history(evidence, tolerance):
    """Yield differences between contacts at the end of force histories of equal impulse.

    The histories should reach equal depths with equal contact. The first case is the number of elements whose contact
    differs between two histories, the second case is the relative difference of the depths.
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
    """Yield the number of elements whose contact changes when the depth u and the rms height h are scaled together."""
    for hurst in evidence.pooled:
        disc = _disc(evidence, hurst)
        touching = contact_at(disc, depth=DEPTH).contact
        scaled = [contact_at(Indenter(s * disc.heights, disc.spacing), depth=s * DEPTH) for s in SCALES]
        differing = [int((contact.contact != touching).sum()) for contact in scaled]
        number = int((touching == 1).sum())
        yield _case(f"{hurst_name(hurst)}, elements that differ, of {number}", differing, tolerance)


def one_surface(evidence, tolerance):
    """Yield relative differences between results for one surface in different units, which should vanish.

    For every Hurst exponent, κ(X) is compared between surfaces with other heights and other diameters. For the smallest
    Hurst exponent, F/(ηvL) is also compared between direct integrations with other forces and viscosities, at equal
    Ft/η and hence in equal contact.
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
    """Return F/(ηvL), with the mean velocity v, in each step of a direct integration in steps of equal impulse Ft/η."""
    times = np.linspace(0.0, IMPULSE * viscosity / force, STEPS + 1)
    depth = march(disc, Load(times, force=np.full(times.size, force)), Newtonian(viscosity)).depth
    return force / (viscosity * np.diff(depth) / np.diff(times))


def _stiffness(indenter, rms, diameter):
    """Return κ at the dimensionless forces X in `FORCES`, for a surface of the given rms height and diameter."""
    force = 4 * rms * diameter * FORCES
    return indent(indenter, until_force=force[-1]).at_force(force)[1] / diameter
