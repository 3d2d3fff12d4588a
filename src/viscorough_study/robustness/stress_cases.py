"""Difficulties that methods are driven into: indenters, and what is asked of them."""

from dataclasses import dataclass

import numpy as np

from viscorough import reference
from viscorough.indenter import Indenter
from viscorough.surfaces import self_affine_disc

NOT_SELF_AFFINE = "the indenter is no isotropic self-affine surface, which a line with its spectrum stands for"
SMALL = "Eq. 5 is said to hold above H = 0.4"
ROLL_OFF = "the spectrum rolls off: there is no power law"


@dataclass(frozen=True)
class Difficulty:
    """An indenter, and what is asked of it.

    hurst : the exponent that a user of the power law, and of a line with the same spectrum, would take
    fractions : contact fractions between which depths are asked for
    body : of revolution with a power-law profile, whose line is exact
    tolerance : of the elastic path; steps : of explicit marching
    force : F at equal times, whose impulses are those asked for; constant by default
    stated : why models are documented not to hold here
    periodic : the grid of the elastic path without padding, so that images of the indenter press as well
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
    periodic: bool = False


def difficulties(seed, across, grids):
    """Every difficulty of the atlas, on maps of `across` elements, and on `grids` where the size is the difficulty."""

    def disc(hurst, elements=across, **options):
        return self_affine_disc(hurst, elements, seed=seed, **options)

    def of(shape):
        """The map of a shape over x and y from −1 to 1, times 0.1; spacing 2 / across."""
        x = (np.arange(across) - (across - 1) / 2) * 2 / across
        return Indenter(0.1 * (shape(x[:, None], x) + np.zeros((across, across))), 2 / across)

    def shaped(name, shape, **options):
        return Difficulty("shape", name, of(shape), stated=NOT_SELF_AFFINE, **options)

    def tied(name, heights, **options):
        return Difficulty(
            "ties", name, Indenter(np.asarray(heights, dtype=float), 1.0), stated=NOT_SELF_AFFINE, **options
        )

    rough = disc(0.7)
    usual = {"indenter": rough, "hurst": 0.7}
    elements, random = rough.elements, np.random.default_rng(seed)
    checkered = np.add.outer(np.arange(across), np.arange(across)) % 2
    apart = np.full((across, across), np.nan)
    apart[0, 0], apart[-1, -1] = 0, -0.1

    yield Difficulty("step size", "4096 steps", **usual, steps=4096)
    yield Difficulty("step size", "256 steps", **usual)
    yield Difficulty("step size", "16 steps", **usual, steps=16)
    yield Difficulty("step size", "one step", **usual, steps=1)
    for hurst in (0.0, 0.2, 0.4, 0.7, 1.0):
        yield Difficulty("Hurst exponent", f"H = {hurst:g}", disc(hurst), hurst, stated=SMALL if hurst <= 0.4 else "")
    rolled = {"roll_off_wavelength": 0.2, "roll_off_level": 1.0}
    yield Difficulty("Hurst exponent", "H = 0.7, roll-off", disc(0.7, **rolled), 0.7, stated=ROLL_OFF)
    for n in grids:
        few = (0.05, 0.5) if n < 65 else (30 / n**2, 300 / n**2)
        yield Difficulty("grid", f"{n} elements across", disc(0.7, n), 0.7, few, steps=256 if n < 257 else 64)
    yield Difficulty("contact", "up to 2 elements", **usual, fractions=(1 / elements, 2 / elements))
    yield Difficulty("contact", "95 % to all but one", **usual, fractions=(0.95, 1 - 1 / elements))
    yield Difficulty("contact", "to all elements", **usual, fractions=(0.5, 1.0))
    yield Difficulty("contact", "past all elements", **usual, fractions=(0.9, 1.1))
    yield tied("exactly flat", np.zeros((across, across)))
    yield tied("one element", [[1.0]])
    yield tied("two, far apart", apart, fractions=(0.5, 1.0))
    yield tied("plateau on a hill", of(lambda x, y: -np.maximum(np.hypot(x, y), 0.3)).heights * 10)
    yield tied("terraces", of(lambda x, y: -np.floor(6 * np.hypot(x, y))).heights)
    yield tied("one step", of(lambda x, y: -1.0 * (x > 0.1)).heights)
    yield tied("checkered", -0.5 * checkered, fractions=(0.5, 1.0))
    yield tied("whole numbers", random.integers(0, 4, (across, across)))
    yield Difficulty("shape", "sphere", of(lambda x, y: -(x**2 + y**2) / 2), body=reference.PowerLawBody(0.05, 2))
    yield Difficulty("shape", "cone", of(lambda x, y: -np.hypot(x, y)), body=reference.PowerLawBody(0.1, 1))
    yield shaped("ridge", lambda x, y: -(x**2))
    yield shaped("wedge", lambda x, y: -abs(x))
    yield shaped("two spheres", lambda x, y: -np.minimum((x - 0.5) ** 2, (x + 0.5) ** 2) - y**2)
    yield shaped("tip off the centre", lambda x, y: -((x - 0.6) ** 2) - (y + 0.5) ** 2, fractions=(0.02, 0.3))
    yield shaped("elongated", lambda x, y: -(x**2) - (y / 8) ** 2)
    yield shaped("tilted plane", lambda x, y: x + y / 2)
    yield shaped("steep: slope 20", lambda x, y: -200 * np.hypot(x, y))
    low = (2 / elements, 20 / elements)
    yield Difficulty("no padding", "2 to 20 elements", **usual, fractions=low, periodic=True)
    yield Difficulty("no padding", "up to half of all", **usual, periodic=True)
    for name, height, length in (
        ("heights times 1e12", 1e12, 1.0),
        ("heights times 1e-12", 1e-12, 1.0),
        ("spacing times 1e12", 1.0, 1e12),
        ("spacing times 1e-12", 1.0, 1e-12),
        ("heights 1e-12, spacing 1e12", 1e-12, 1e12),
    ):
        scaled = Indenter(height * rough.heights, length * rough.spacing)
        yield Difficulty("scale", name, scaled, 0.7)
    for name, force in (
        ("ramp", (0.0, 1.0)),
        ("step", (0.1, 0.1, 0.1, 1.0, 1.0, 1.0)),
        ("pulses with rests", (0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0)),
        ("zero at first", (0.0, 0.0, 0.0, 0.0, 1.0, 1.0)),
        ("negative for a while", (1.0, 1.0, -0.1, 1.0)),
    ):
        yield Difficulty("force in time", name, **usual, force=force)
    for tolerance in (1e-1, 1e-3, 1e-10, 1e-12, 1e-14):
        yield Difficulty("tolerance", f"{tolerance:g}", **usual, tolerance=tolerance)
