"""Judge claims on the variables that determine the contact, tested on one small rough disc.

The claims follow from the equations of the contact for every surface, so a small disc shows them exactly. The
integration in time solves a contact problem in every step and never uses the correspondence with the elastic problem.
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
DEPTH = 1.5  # in rms heights; some tens of elements are in contact
IMPULSE = 2.0  # ∫F dt/η over hL at the end of force histories
HISTORIES = {  # times, and forces over IMPULSE, linear between times; a repeated time marks a step
    "constant": ([0.0, 1.0], [1.0, 1.0]),
    "growing": ([0.0, 0.25, 0.5, 0.75, 1.0], [0.0, 0.5, 1.0, 1.5, 2.0]),
    "with rests": (
        [0.0, 0.2, 0.2, 0.6, 0.6, 0.8, 0.8, 0.9, 0.9, 1.0],
        [2.0, 2.0, 0.0, 0.0, 2.0, 2.0, 0.0, 0.0, 2.0, 2.0],
    ),
}
SCALES = (1e-3, 0.2, 7.0)  # factors of heights and depth
UNITS = ((7.0, 1.0), (1e-3, 3.0), (0.2, 1e-2))  # factors of heights and of lengths in the plane
FORCES = np.geomspace(1e-3, 1, 31)  # values of X for the comparison of curves
DRIVES = ((1.0, 1.0), (1.0, 5.0), (1e-2, 1.0), (30.0, 0.2))  # forces over hL and viscosities of one indentation
STEPS = 10  # steps of equal impulse in each direct integration


def _disc(evidence, hurst):
    """Return the small disc of a Hurst exponent, of rms height and diameter 1."""
    return self_affine_disc(hurst, ACROSS, seed=realization_seed(evidence.seed, *gamma_factor_key(hurst)))


def _case(name, deviations, tolerance):
    """Return the case of the largest of several deviations, which should vanish."""
    return exact(name, max(deviations), 0.0, max(deviations) <= tolerance, deviations)


def history(evidence, tolerance):
    """Yield differences at the end of force histories of equal impulse: elements in contact, and relative depths.

    Histories of equal impulse reach equal depths, and should have equal contact.
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
    """Yield the number of elements whose contact changes when u and h are multiplied by the same factor."""
    for hurst in evidence.pooled:
        disc = _disc(evidence, hurst)
        touching = contact_at(disc, depth=DEPTH).contact
        scaled = [contact_at(Indenter(s * disc.heights, disc.spacing), depth=s * DEPTH) for s in SCALES]
        differing = [int((contact.contact != touching).sum()) for contact in scaled]
        number = int((touching == 1).sum())
        yield _case(f"{hurst_name(hurst)}, elements that differ, of {number}", differing, tolerance)


def one_surface(evidence, tolerance):
    """Yield relative differences between one surface and the same surface in other units.

    They are differences of κ(X) with other heights and another diameter, for every Hurst exponent. For the smallest
    exponent they are also differences of F/(ηvL) from direct integrations with other forces and viscosities at the same
    Ft/η, hence in the same contact.
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
    """Return F/(ηvL) over steps of equal impulse Ft/η in a direct integration; v : velocity over a step"""
    times = np.linspace(0.0, IMPULSE * viscosity / force, STEPS + 1)
    depth = march(disc, Load(times, force=np.full(times.size, force)), Newtonian(viscosity)).depth
    return force / (viscosity * np.diff(depth) / np.diff(times))


def _stiffness(indenter, rms, diameter):
    """Return κ at the dimensionless forces `FORCES`, for a surface of these lengths."""
    force = 4 * rms * diameter * FORCES
    return indent(indenter, until_force=force[-1]).at_force(force)[1] / diameter
