"""The recommended penetration law, calibrated with boundary elements on the paper's grid: region (b) and beyond.

Interface and flat punch of the whole disc are two springs in series, so vt/h = X + g(X) with X = Ft/(4ηhL). The
contribution of the interface is

    g = (g₁^(−3/2) + (cX)^(−3/2))^(−2/3),    g₁ = A X^b (1 + X/s)^(−m) (1 + (X/d)²)^(−4).

At small X, g₁ is a power law with the exponent b. Around X = 1 it has a broad maximum: the stiffness of the interface
is then proportional to the force, as in elastic contacts with a force that is exponential in the separation. At larger
X it falls, and it vanishes at complete contact, so that vt/h = X. While a single element touches (region a), g = cX,
with a constant c that depends only on the number of elements across.

The constants A, b, s, m, d are in data/law.csv, a copy of results/tables/law.csv from `make law`. With them the two
integrals of g over ln X and over X equal the means of the exact integrals (sum_rules), and g is closest to the mean of
curves to complete contact. The table also has the range of X with g within 5 % of the mean over other discs. The
interval of single surfaces, data/law_scatter.csv, is a copy of results/tables/law_scatter.csv from `make law-errors`. β
and ζ of the paper's power law in region (b) are in data/calibration.csv, a copy of results/tables/calibration.csv from
`make paper`.

Conventions: h is the rms height of the disc and L its diameter; there is no factor Γ. The law describes arithmetic
means at fixed X, since compliances in series add. The power law is fitted to geometric means over the whole region (b),
like in the figures. The grids have 257 elements across. At small X their finest waves determine the law, so b is the
exponent of these curves and not of an infinitely fine grid.
"""

import csv
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib import resources
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from viscorough.basics.argument_names import spelled
from viscorough.basics.arrays import real_number, real_numbers
from viscorough.basics.elasticity import one_element_stiffness
from viscorough.basics.types import Array, Numbers

# Elements across the discs of the calibration.
ACROSS = 257
# Largest deviation of g from its mean over discs outside the calibration, within the range of the law.
LARGEST_DEVIATION = 0.05
# Exponents that are common to all H: 3/2 of the transition from region (a), and 4 of the last factor of g₁.
_ONSET, _LAST = 1.5, 4.0
# Length and number of steps in ln X for the integral of g: it starts at e^-40 X, far inside region (a).
_STEP, _STEPS = 0.05, 800
CONSTANTS = {
    "amplitude": "A of the law of g",
    "exponent": "b of the law of g, its exponent at small X",
    "bend": "s of the law of g, X at which it leaves this power law",
    "fall": "m of the law of g, by which the exponent falls there",
    "cutoff": "d of the law of g, X beyond which it vanishes",
}

COLUMNS = {
    "source": ("discs (boundary elements) or lines (method of dimensionality reduction)", ""),
    "hurst": ("Hurst exponent H", "1"),
    **{
        f"{name}{end}": (f"{text}{meaning}", "1")
        for name, text in {"beta": "exponent β", "zeta": "prefactor ζ", "lambda": "λ of C1D = λ q C2D"}.items()
        for end, meaning in {"": "", "_low": ", lower end of 95 %", "_high": ", upper end of 95 %"}.items()
    },
    "x_low": ("lower end of region (b) in X = F/(4GhL) = Ft/(4ηhL)", "1"),
    "x_high": ("upper end of region (b) in X", "1"),
    "realizations": ("realizations", "1"),
}
SCATTER_COLUMNS = {
    "hurst": ("Hurst exponent H", "1"),
    "x": ("dimensionless force or time X", "1"),
    **{
        f"{name}_{end}": (f"{side} end of the interval of {text} of a single surface, over the law", "1")
        for name, text in {"velocity": "vt/h", "depth": "u/h"}.items()
        for end, side in {"low": "lower", "high": "upper"}.items()
    },
}


def interface_velocity(
    x: Numbers, amplitude: float, exponent: float, bend: float, fall: float, cutoff: float, *, across: int = ACROSS
) -> Array:
    """Return g(X), the interface's part of vt/h, X > 0 of any shape; the module has the formula and its constants.

    across : elements across the disc, which determine region (a)
    """
    x = np.asarray(x, dtype=float)
    interface = amplitude * x**exponent * (1 + x / bend) ** -fall * (1 + (x / cutoff) ** 2) ** -_LAST
    one_element = x * (1 / one_element_stiffness(across) - 1)
    return interface / (1 + (interface / one_element) ** _ONSET) ** (1 / _ONSET)


def interface_depth(x: Numbers, *constants: float, across: int = ACROSS) -> Array:
    """Return ∫₀^X g dX/X, the interface's part of u/h, by Simpson's rule.

    constants, across : arguments of `interface_velocity`
    """
    from scipy.integrate import simpson  # this import takes long

    logarithm = _STEP * np.arange(-_STEPS, 1)
    x = np.multiply.outer(np.asarray(x, dtype=float), np.exp(logarithm))
    return simpson(interface_velocity(x, *constants, across=across), dx=_STEP)


@dataclass(frozen=True)
class PenetrationLaw:
    """vt/h = X + g(X) for x_low <= X <= x_high, X = Ft/(4ηhL), and X^beta/zeta in region (b) (paper, Eqs. 1 to 3, 10).

    All quantities are dimensionless. Means over surfaces are arithmetic, at fixed X. The range was chosen so that g is
    within 5 % of its mean over discs that were not used for the calibration; see `penetration_law` for its error on
    further discs.

    hurst : Hurst exponent H
    beta, zeta : exponent β and prefactor ζ of the power law in region (b), independent of all other attributes
    beta_interval, zeta_interval : (lower, upper) ends of their 95 % confidence intervals, from the ensembles of the
        calibration
    region : (lower, upper) end of region (b) in X
    amplitude, exponent, bend, fall, cutoff : constants A, b, s, m and d of g, see `interface_velocity`
    velocity_error, depth_error : largest relative distances of vt/h and u/h from the ends of the 95 % intervals of
        their means over discs that were not used for the calibration
    x_low, x_high : range of the law in X
    """

    hurst: float
    beta: float
    beta_interval: tuple
    zeta: float
    zeta_interval: tuple
    region: tuple
    amplitude: float
    exponent: float
    bend: float
    fall: float
    cutoff: float
    velocity_error: float
    depth_error: float
    x_low: float
    x_high: float

    def __repr__(self) -> str:
        """Show H, range and power law instead of all constants."""
        (low, high), (least, most), (begin, end) = self.beta_interval, self.zeta_interval, self.region
        return (
            f"Penetration law vt/h = X + g(X) for H = {self.hurst:g}, X from {self.x_low:.3g} to {self.x_high:.3g}\n"
            f"power law X^beta/zeta from X = {begin:.3g} to {end:.3g}: beta {self.beta:.4g} [{low:.4g}, {high:.4g}], "
            f"zeta {self.zeta:.4g} [{least:.4g}, {most:.4g}]"
        )

    def velocity(self, x: "ArrayLike") -> Array:
        """Return vt/h at X, any shape. Raises ValueError outside the calibrated range of X."""
        x = self._inside(x)
        return x + interface_velocity(x, *self.constants)

    def depth(self, x: "ArrayLike") -> Array:
        """Return u/h = ∫ vt/h dX/X at X, any shape. Raises ValueError like `velocity`."""
        x = self._inside(x)
        return x + interface_depth(x, *self.constants)

    def velocity_interval(self, x: "ArrayLike") -> Array:
        """Return (lower, upper) ends of vt/h at X for 95 % of single surfaces, shape (2, shape of X).

        Raises ValueError like `velocity`.
        """
        x = self._inside(x)
        return self.velocity(x) * relative_interval(scatter_calibration(), "velocity", self.hurst, x)

    def depth_interval(self, x: "ArrayLike") -> Array:
        """Return (lower, upper) ends of u/h at X for 95 % of single surfaces, shape (2, shape of X).

        Raises ValueError like `velocity`.
        """
        x = self._inside(x)
        return self.depth(x) * relative_interval(scatter_calibration(), "depth", self.hurst, x)

    @property
    def constants(self) -> tuple[float, ...]:
        """Return A, b, s, m and d of g, in the order of `CONSTANTS`."""
        return self.amplitude, self.exponent, self.bend, self.fall, self.cutoff

    def _inside(self, x: "ArrayLike") -> Array:
        """Return X as an array. Raises ValueError outside the range of the law."""
        x = real_numbers("X of the law", x)
        if not np.all((x >= self.x_low) & (x <= self.x_high)):
            raise ValueError(
                f"X of the law for H = {self.hurst:g}: from {x.min():.3g} to {x.max():.3g}; "
                f"allowed: {self.x_low:.3g} to {self.x_high:.3g}, in which discs of {ACROSS} elements across confirm it"
            )
        return x


def _read(name: str, chosen: Callable[[dict[str, str]], bool], numbers: Sequence[str]) -> dict[str, Array]:
    """Return columns of a table in data/, {name: array over ascending H}, of the chosen rows."""
    with resources.files("viscorough.law").joinpath(f"data/{name}").open(encoding="utf-8") as file:
        rows = sorted(filter(chosen, csv.DictReader(file)), key=lambda row: float(row["hurst"]))
    return {name: np.array([float(row[name] or "nan") for row in rows]) for name in numbers}


@cache
def calibration() -> dict[str, Array]:
    """Return the power law of discs in region (b), {column of COLUMNS except the source: array over ascending H}."""
    names = [name for name in COLUMNS if name != "source"]
    return _read("calibration.csv", lambda row: row["source"] == "discs", names)


@cache
def interface_calibration() -> dict[str, Array]:
    """Return the law beyond region (b), {column of data/law.csv: array over the H of `calibration`}."""
    names = ("hurst", *CONSTANTS, "velocity_error", "depth_error", "x_low", "x_high")
    return _read("law.csv", lambda row: int(row["across"]) == ACROSS, names)


@cache
def scatter_calibration() -> dict[str, Array]:
    """Return the intervals of single surfaces, {column of SCATTER_COLUMNS: array over ascending H, then X}."""
    return _read("law_scatter.csv", lambda row: True, list(SCATTER_COLUMNS))


def relative_interval(table: Mapping[str, Any], quantity: str, hurst: float, x: Numbers) -> Array:
    """Return the ends of the interval of single surfaces, each divided by the law, shape (2, shape of X).

    table : columns of SCATTER_COLUMNS; quantity : "velocity" (vt/h) or "depth" (u/h)

    The logarithms of the ends are interpolated linearly in H and in ln X.
    """
    hursts, abscissae = np.unique(table["hurst"]), np.unique(table["x"])
    ends = []
    for end in ("low", "high"):
        logarithms = np.log(np.asarray(table[f"{quantity}_{end}"])).reshape(hursts.size, abscissae.size)
        at_hurst = [np.interp(hurst, hursts, column) for column in logarithms.T]
        ends.append(np.exp(np.interp(np.log(x), np.log(abscissae), at_hurst)))
    return np.array(ends)


def penetration_law(hurst: float) -> PenetrationLaw:
    """Return the PenetrationLaw of a self-affine surface with Hurst exponent H.

    Between the calibrated exponents all constants and intervals are interpolated linearly in H; for positions in X the
    logarithms are interpolated.

    A further sample of discs of 257 elements across, also at exponents in between, had means of vt/h within 12 % of
    the law, of g within 16 % and of u/h within 7 %, with standard errors of 5 % at small X. The depth depends on the
    grid: at X = 0.003 the law exceeds the mean u/h of discs of 129 elements across by 12 % at H = 0.85 and by 37 % at
    H = 0.1 (docs/verification.md).

    Parameters
    ----------
    hurst : float
        Hurst exponent H, from 0.1 to 1 [1].

    Returns
    -------
    PenetrationLaw

    Raises
    ------
    ValueError
        For a Hurst exponent outside the calibrated range.

    Examples
    --------
    >>> import viscorough
    >>> law = viscorough.penetration_law(0.7)
    >>> round(law.beta, 1), bool(law.velocity(1.0) > 0)
    (0.4, True)
    """
    table, beyond = calibration(), interface_calibration()
    low, high = table["hurst"][[0, -1]]
    name = spelled("--hurst", "hurst of the penetration law")
    hurst = real_number(name, hurst)
    if not low <= hurst <= high:
        raise ValueError(f"{name}: must be from {low:g} to {high:g}, not {hurst!r}")

    def linear(name: str, columns: dict[str, Array] = table) -> float:
        return float(np.interp(hurst, columns["hurst"], columns[name]))

    def logarithmic(name: str, columns: dict[str, Array] = table) -> float:
        place = np.interp(hurst, columns["hurst"], np.arange(len(columns["hurst"])))
        first = min(int(place), len(columns["hurst"]) - 2)
        below, above = columns[name][first : first + 2]
        return float(below * (above / below) ** (place - first))  # exactly the same value if both ends have it

    return PenetrationLaw(
        hurst=hurst,
        beta=linear("beta"),
        beta_interval=(linear("beta_low"), linear("beta_high")),
        zeta=linear("zeta"),
        zeta_interval=(linear("zeta_low"), linear("zeta_high")),
        region=(logarithmic("x_low"), logarithmic("x_high")),
        **{name: linear(name, beyond) for name in ("amplitude", "exponent", "fall", "velocity_error", "depth_error")},
        **{name: logarithmic(name, beyond) for name in ("bend", "cutoff", "x_low", "x_high")},
    )
