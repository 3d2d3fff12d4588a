"""Build the stress-test cases: indenters, loads, and parameters for all methods."""

from dataclasses import dataclass
from functools import partial

import numpy as np

from viscorough import reference
from viscorough.media.kinds import KelvinVoigt, Maxwell, Prony, StandardLinearSolid
from viscorough.surfaces.indenter import Indenter
from viscorough.surfaces.self_affine import self_affine_disc

NOT_SELF_AFFINE = "the indenter is no isotropic self-affine surface, which a line with its spectrum stands for"
ROLL_OFF = "the spectrum rolls off: there is no power law"


@dataclass(frozen=True)
class StressCase:
    """A stress-test case: an indenter, its load, and the parameters of the methods.

    group, name : kind of case, and name of the case
    hurst : Hurst exponent that the models (the power law, and a random line of the MDR) assume for the indenter
    fractions : contact fractions at the first and the last depth of the comparison
    body : body of revolution with a power-law profile that the indenter represents, for which the MDR is exact; or None
    tolerance : tolerance of the elastic loading path; steps : number of explicit time steps
    force : values of the force F at equal intervals of time; constant by default
    stated : documented reason why models do not apply to this case; empty if they apply
    medium : viscoelastic medium; None for a Newtonian medium
    medium_load : samples (time, force) of the load in `medium`; the forces are scaled by a common factor
    """

    group: str
    name: str
    indenter: Indenter
    hurst: float = 1.0
    fractions: tuple = (0.02, 0.5)
    body: reference.PowerLawBody | None = None
    tolerance: float = 1e-6
    steps: int = 256
    force: tuple = (1.0, 1.0)
    stated: str = ""
    medium: object = None
    medium_load: tuple = ()


def stress_cases(seed, across, grids, hurst_min):
    """Yield all stress-test cases of the failure map, group by group.

    seed : SeedSequence of the rough discs; across : number of elements across the maps
    grids : numbers of elements across the discs of the group "grid"
    hurst_min : the paper states that Eq. 5 holds for H above this limit (resources/paper/numbers.yaml)
    """
    disc = partial(self_affine_disc, elements_across=across, seed=seed)
    usual = {"indenter": disc(0.7), "hurst": 0.7}
    yield from _disc_cases(disc, usual, grids, hurst_min)
    yield from _tied_cases(across, seed)
    yield from _shape_cases(across)
    yield from _question_cases(usual)
    yield from _medium_cases(usual)


def _disc_cases(disc, usual, grids, hurst_min):
    """Yield cases of rough discs that differ in time steps, Hurst exponent, grid, or contact fractions.

    disc : function that generates a disc from a Hurst exponent
    usual : the disc that most cases use, as the arguments `indenter` and `hurst` of StressCase
    """
    elements = usual["indenter"].elements
    for steps, name in ((4096, "4096 steps"), (256, "256 steps"), (16, "16 steps"), (1, "one step")):
        yield StressCase("step size", name, **usual, steps=steps)
    for hurst in (0.0, 0.2, 0.4, 0.7, 1.0):
        stated = f"Eq. 5 is said to hold above H = {hurst_min:g}" if hurst <= hurst_min else ""
        yield StressCase("Hurst exponent", f"H = {hurst:g}", disc(hurst), hurst, stated=stated)
    rolled_off = disc(0.7, roll_off_wavelength=0.2, roll_off_level=1.0)
    yield StressCase("Hurst exponent", "H = 0.7, roll-off", rolled_off, 0.7, stated=ROLL_OFF)
    for n in grids:
        fractions = (0.05, 0.5) if n < 65 else (30 / n**2, 300 / n**2)
        steps = 256 if n < 257 else 64
        yield StressCase("grid", f"{n} elements across", disc(0.7, elements_across=n), 0.7, fractions, steps=steps)
    yield StressCase("contact", "up to 2 elements", **usual, fractions=(1 / elements, 2 / elements))
    yield StressCase("contact", "95 % to all but one", **usual, fractions=(0.95, 1 - 1 / elements))
    yield StressCase("contact", "to all elements", **usual, fractions=(0.5, 1.0))
    yield StressCase("contact", "past all elements", **usual, fractions=(0.9, 1.1))


def _shape(across, function):
    """Return an indenter whose heights are 0.1 times a function of x and y.

    x and y extend from −1 to 1.
    across : number of elements along x and along y
    """
    x = (np.arange(across) - (across - 1) / 2) * 2 / across
    return Indenter(0.1 * (function(x[:, None], x) + np.zeros((across, across))), 2 / across)


def _tied_cases(across, seed):
    """Yield cases of indenters with many elements of exactly the same height."""

    def tied(name, heights, **options):
        return StressCase("ties", name, Indenter(heights, 1.0), stated=NOT_SELF_AFFINE, **options)

    apart = np.full((across, across), np.nan)
    apart[0, 0], apart[-1, -1] = 0, -0.1
    yield tied("exactly flat", np.zeros((across, across)))
    yield tied("one element", [[1.0]])
    yield tied("two, far apart", apart, fractions=(0.5, 1.0))
    yield tied("plateau on a hill", _shape(across, lambda x, y: -np.maximum(np.hypot(x, y), 0.3)).heights * 10)
    yield tied("terraces", _shape(across, lambda x, y: -np.floor(6 * np.hypot(x, y))).heights)
    yield tied("one step", _shape(across, lambda x, y: -1.0 * (x > 0.1)).heights)
    yield tied("checkered", -0.5 * (np.indices((across, across)).sum(axis=0) % 2), fractions=(0.5, 1.0))
    yield tied("whole numbers", np.random.default_rng(seed).integers(0, 4, (across, across)))


def _shape_cases(across):
    def shaped(name, function, **options):
        return StressCase("shape", name, _shape(across, function), stated=NOT_SELF_AFFINE, **options)

    sphere, cone = reference.PowerLawBody(0.05, 2), reference.PowerLawBody(0.1, 1)
    yield StressCase("shape", "sphere", _shape(across, lambda x, y: -(x**2 + y**2) / 2), body=sphere)
    yield StressCase("shape", "cone", _shape(across, lambda x, y: -np.hypot(x, y)), body=cone)
    yield shaped("ridge", lambda x, y: -(x**2))
    yield shaped("wedge", lambda x, y: -abs(x))
    yield shaped("two spheres", lambda x, y: -np.minimum((x - 0.5) ** 2, (x + 0.5) ** 2) - y**2)
    yield shaped("tip off the centre", lambda x, y: -((x - 0.6) ** 2) - (y + 0.5) ** 2, fractions=(0.02, 0.3))
    yield shaped("elongated", lambda x, y: -(x**2) - (y / 8) ** 2)
    yield shaped("tilted plane", lambda x, y: x + y / 2)
    yield shaped("steep: slope 20", lambda x, y: -200 * np.hypot(x, y))


def _question_cases(usual):
    """Yield cases of one disc: with extreme heights or spacings, under varying forces, and with several tolerances.

    usual : the disc, as the arguments `indenter` and `hurst` of StressCase
    """
    rough = usual["indenter"]
    for name, height, length in (
        ("heights times 1e12", 1e12, 1.0),
        ("heights times 1e-12", 1e-12, 1.0),
        ("spacing times 1e12", 1.0, 1e12),
        ("spacing times 1e-12", 1.0, 1e-12),
        ("heights 1e-12, spacing 1e12", 1e-12, 1e12),
    ):
        yield StressCase("scale", name, Indenter(height * rough.heights, length * rough.spacing), 0.7)
    for name, force in (
        ("ramp", (0.0, 1.0)),
        ("step", (0.1, 0.1, 0.1, 1.0, 1.0, 1.0)),
        ("pulses with rests", (0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0)),
        ("zero at first", (0.0, 0.0, 0.0, 0.0, 1.0, 1.0)),
        ("negative for a while", (1.0, 1.0, -0.1, 1.0)),
    ):
        yield StressCase("force in time", name, **usual, force=force)
    for tolerance in (1e-1, 1e-3, 1e-10, 1e-12, 1e-14):
        yield StressCase("tolerance", f"{tolerance:g}", **usual, tolerance=tolerance)


def _medium_cases(usual):
    """Yield cases of one disc in viscoelastic media, each with a load history.

    Times are from 0 to 1; a repeated time marks a step of the force.
    usual : the disc, as the arguments `indenter` and `hurst` of StressCase
    """
    step, ramp = ((0, 1), (1, 1)), ((0, 0), (0.5, 0.4), (1, 1))
    hold, unloading = ((0, 0), (0.1, 1), (1, 1)), ((0, 0), (0.4, 1), (0.5, 0.3), (1, 0.3))
    solid = StandardLinearSolid(3.0, 1.0, 0.3)
    for name, medium, load in (
        ("Maxwell, step", Maxwell(1.0, 0.5), step),
        ("Kelvin-Voigt, ramp", KelvinVoigt(1.0, 0.5), ramp),
        ("solid, two steps", solid, ((0, 0.5), (0.5, 0.5), (0.5, 1), (1, 1))),
        ("Prony series, hold", Prony(0.5, (2.0, 1.0, 1.0), (0.03, 0.3, 3.0)), hold),
        ("relaxation time 1e-6", StandardLinearSolid(3.0, 1.0, 1e-6), hold),
        ("relaxation time 1e6", StandardLinearSolid(3.0, 1.0, 1e6), hold),
        ("moduli 1 and 1e-10", Prony(1e-10, (1.0,), (1e-4,)), hold),
        ("Maxwell, unloading", Maxwell(1.0, 0.5), unloading),
        ("solid, unloading", solid, unloading),
    ):
        yield StressCase("medium", name, **usual, medium=medium, medium_load=load)
