"""Build the stress tests: indenters, loads, and parameters for all methods."""

from dataclasses import dataclass
from functools import partial

import numpy as np

from viscorough import reference
from viscorough.media.kinds import Maxwell, Newtonian, StandardLinearSolid
from viscorough.surfaces.indenter import Indenter
from viscorough.surfaces.self_affine import self_affine_disc

NOT_SELF_AFFINE = "the indenter is no isotropic self-affine surface, which a line with its spectrum stands for"
COMPLETE = "all elements touch: region (c), beyond the power law"
ROLL_OFF = "the spectrum rolls off: there is no power law"


@dataclass(frozen=True)
class StressTest:
    """A stress test: an indenter, its load, and the parameters of the methods.

    group, name : kind of test, and name of the test
    hurst : Hurst exponent that the models (the power law, and a random line of the MDR) assume for the indenter
    fractions : contact fractions at the first and the last depth of the comparison
    body : body of revolution with a power-law profile that the indenter represents, for which the MDR is exact; or None
    tolerance : tolerance of loading curves; steps : number of explicit time steps
    stated : documented reason why models do not apply to this test; empty if they apply
    medium : medium of the half-space under the force `load`; None for a constant force on a Newtonian medium
    load : samples (time, force) of the force on `medium`; the forces are scaled by a common factor
    """

    group: str
    name: str
    indenter: Indenter
    hurst: float = 1.0
    fractions: tuple = (0.02, 0.5)
    body: reference.PowerLawBody | None = None
    tolerance: float = 1e-6
    steps: int = 256
    stated: str = ""
    medium: object = None
    load: tuple = ()


def stress_tests(seed, across, grids, hurst_min):
    """Yield all stress tests of the failure map, group by group.

    seed : SeedSequence of the rough discs; across : number of elements across the maps
    grids : numbers of elements across the discs of the group "grid"
    hurst_min : the paper states that Eq. 5 holds for H above this limit (resources/paper/numbers.yaml)
    """
    disc = partial(self_affine_disc, elements_across=across, seed=seed)
    usual = {"indenter": disc(0.7), "hurst": 0.7}
    yield from _disc_tests(disc, usual, grids, hurst_min)
    yield from _shape_tests(across)
    yield from _load_tests(usual)


def _disc_tests(disc, usual, grids, hurst_min):
    """Yield tests of rough discs that differ in time steps, Hurst exponent, grid, contact fractions, or units.

    disc : function that generates a disc from a Hurst exponent
    usual : the disc that most tests use, as the arguments `indenter` and `hurst` of StressTest
    """
    rough = usual["indenter"]
    for steps, name in ((256, "256 steps"), (16, "16 steps"), (1, "one step")):
        yield StressTest("step size", name, **usual, steps=steps)
    for hurst in (0.0, 0.2, 1.0):
        stated = f"Eq. 5 is said to hold above H = {hurst_min:g}" if hurst <= hurst_min else ""
        yield StressTest("Hurst exponent", f"H = {hurst:g}", disc(hurst), hurst, stated=stated)
    rolled_off = disc(0.7, roll_off_wavelength=0.2, roll_off_level=1.0)
    yield StressTest("Hurst exponent", "H = 0.7, roll-off", rolled_off, 0.7, stated=ROLL_OFF)
    for n in grids:
        fractions = (0.05, 0.5) if n < 65 else (30 / n**2, 300 / n**2)
        yield StressTest("grid", f"{n} elements across", disc(0.7, elements_across=n), 0.7, fractions, steps=64)
    yield StressTest("contact", "up to 2 elements", **usual, fractions=(1 / rough.elements, 2 / rough.elements))
    yield StressTest("contact", "past all elements", **usual, fractions=(0.9, 1.1), stated=COMPLETE)
    yield StressTest("units", "heights 1e-12, spacing 1e12", Indenter(1e-12 * rough.heights, 1e12 * rough.spacing), 0.7)
    yield StressTest("tolerance", "1e-14", **usual, tolerance=1e-14)


def _shape_tests(across):
    """Yield tests of bodies of revolution, and of indenters that are not self-affine.

    x and y extend from −1 to 1. Heights are 0.1 times the functions of x and y.
    """
    x = (np.arange(across) - (across - 1) / 2) * 2 / across
    radius = np.hypot(x[:, None], x)

    def shaped(name, heights, **options):
        return StressTest("shape", name, Indenter(0.1 * heights, 2 / across), stated=NOT_SELF_AFFINE, **options)

    sphere = Indenter(-0.1 * radius**2 / 2, 2 / across)
    yield StressTest("shape", "sphere", sphere, body=reference.PowerLawBody(0.05, 2))
    yield shaped("ridge", np.tile(-(x**2), (across, 1)))
    yield shaped("tilted plane", x[:, None] + x / 2)
    yield shaped("steep: slope 20", -200 * radius)
    yield shaped("terraces", -np.floor(6 * radius))
    yield shaped("exactly flat", np.zeros((across, across)))


def _load_tests(usual):
    """Yield tests of one disc under forces that vary, in a Newtonian medium and in viscoelastic media.

    Times are from 0 to 1; a repeated time marks a step of the force.
    usual : the disc, as the arguments `indenter` and `hurst` of StressTest
    """
    pulses = ((0, 0), (0.1, 1), (0.2, 0), (0.5, 0), (0.6, 1), (0.7, 0), (0.9, 0), (1, 1))
    pull = ((0, 1), (0.4, 1), (0.6, -0.1), (1, 1))
    unloading = ((0, 0), (0.4, 1), (0.5, 0.3), (1, 0.3))
    yield StressTest("load", "pulses with rests", **usual, medium=Newtonian(1.0), load=pulses)
    yield StressTest("load", "negative for a while", **usual, medium=Newtonian(1.0), load=pull)
    yield StressTest("load", "Maxwell, step", **usual, medium=Maxwell(1.0, 0.5), load=((0, 1), (1, 1)))
    solid = StandardLinearSolid(3.0, 1.0, 0.3)
    yield StressTest("load", "solid, unloading", **usual, medium=solid, load=unloading)
