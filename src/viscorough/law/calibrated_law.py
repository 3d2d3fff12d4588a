"""Penetration law of rough discs, calibrated with boundary-element computations on the paper's grid.

The law covers region (b) of the paper, where the velocity follows a power law, and larger X up to complete contact. A
rough disc acts like two springs in series, the rough interface and the flat punch of the whole disc. Their compliances
add, so that

    vt/h = X + g(X),    X = Ft/(4ηhL),

with the term X of the punch and the term g of the interface,

    g = (g₁^(−3/2) + (cX)^(−3/2))^(−2/3),    g₁ = A X^b (1 + X/s)^(−m) (1 + (X/d)²)^(−4).

- While a single element touches (region a), g = cX. The constant c depends only on the number of elements across the
  disc.
- At small X beyond region (a), g follows g₁, a power law with the exponent b.
- Around X = 1, g has a broad maximum. The stiffness of the interface is then proportional to the force, as in elastic
  contacts whose force is exponential in the separation of the surfaces.
- At larger X, g falls. It vanishes at complete contact, so that vt/h = X.

Sources of the numbers:

- The constants A, b, s, m and d are in data/law.csv, a copy of results/tables/law.csv from `make law`. They are chosen
  so that the integrals ∫g d ln X and ∫g dX equal the means of the exact integrals (contact.complete_contact), and
  so that g is as close as possible to the mean over computed curves up to complete contact. The table also has the
  range of X in which g is within 5 % of the mean over other discs.
- β and ζ of the paper's power law in region (b) are in data/calibration.csv, a copy of
  results/tables/calibration.csv from `make paper`.

Conventions: h is the rms height of the disc, and L its diameter. The law has no factor 1/Γ(2−α). It describes
arithmetic means over surfaces at fixed X, since compliances in series add. The power law of region (b) is fitted to
geometric means over the whole region, as in the figures. The grids have 257 elements across. At small X their finest
waves determine the law, so b is the exponent for this grid, not for an infinitely fine grid.
"""

import csv
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from importlib import resources

import numpy as np
from numpy.typing import ArrayLike

from viscorough.basics.arrays import real_number, real_numbers
from viscorough.basics.elasticity import one_element_stiffness
from viscorough.basics.types import Array, Numbers

# Number of elements across the discs with which the law was calibrated.
ACROSS = 257
# Within its range, the law's g deviates by at most this share from the mean g of discs that were not used to calibrate
# the law.
LARGEST_DEVIATION = 0.05
# Exponents of the law that do not depend on H: 3/2 at the transition from region (a), and 4 in the last factor of g₁.
_ONSET, _LAST = 1.5, 4.0
# Length and number of the steps in ln X by which g is integrated up to X. The integral starts at e^-40 X, far inside
# region (a).
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


def interface_velocity(
    x: Numbers, amplitude: float, exponent: float, bend: float, fall: float, cutoff: float, *, across: int = ACROSS
) -> Array:
    """Return g(X), the term of the interface in vt/h, for X > 0 of any shape.

    amplitude, exponent, bend, fall, cutoff : constants A, b, s, m and d of the formula in the module's docstring
    across : number of elements across the disc, which determines g in region (a)
    """
    x = np.asarray(x, dtype=float)
    interface = amplitude * x**exponent * (1 + x / bend) ** -fall * (1 + (x / cutoff) ** 2) ** -_LAST
    one_element = x * (1 / one_element_stiffness(across) - 1)
    return interface / (1 + (interface / one_element) ** _ONSET) ** (1 / _ONSET)


def interface_depth(x: Numbers, *constants: float, across: int = ACROSS) -> Array:
    """Return ∫₀^X g dX/X, the contribution of the interface to the depth u/h, by Simpson's rule.

    constants, across : arguments of `interface_velocity`, which returns g
    """
    from scipy.integrate import simpson  # imported only if needed, since the import takes long

    logarithm = _STEP * np.arange(-_STEPS, 1)
    x = np.multiply.outer(np.asarray(x, dtype=float), np.exp(logarithm))
    return simpson(interface_velocity(x, *constants, across=across), dx=_STEP)


@dataclass(frozen=True)
class PenetrationLaw:
    """Law vt/h = X + g(X) for x_low <= X <= x_high, with X = Ft/(4ηhL), and power law vt/h = X^beta/zeta.

    The power law holds in region (b) (paper, Eqs. 1 to 3, 10). All quantities are dimensionless. The law gives
    arithmetic means over surfaces at fixed X. Its range of X was chosen so that g is within 5 % of the mean g of discs
    that were not used for the calibration. `penetration_law` states the errors for yet another sample of discs.

    hurst : Hurst exponent H
    beta, zeta : exponent β and prefactor ζ of the power law in region (b), independent of all other attributes
    beta_interval, zeta_interval : (lower, upper) ends of the 95 % confidence intervals of β and ζ, from the ensembles
        of the calibration
    region : (lower, upper) ends of region (b) in X
    amplitude, exponent, bend, fall, cutoff : constants A, b, s, m and d of g, see `interface_velocity`
    velocity_error, depth_error : largest relative errors of vt/h and u/h in the range of the law. They follow from a
        95 % interval at each X, the interval of the mean over discs that were not used for the calibration. The error
        is the distance of the law from the farther end of this interval
    x_low, x_high : ends of the range of X in which the law holds
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
        """Return two lines of text: H and the range of the law; the power law of region (b). Constants are left out."""
        (low, high), (least, most), (begin, end) = self.beta_interval, self.zeta_interval, self.region
        return (
            f"Penetration law vt/h = X + g(X) for H = {self.hurst:g}, X from {self.x_low:.3g} to {self.x_high:.3g}\n"
            f"power law X^beta/zeta from X = {begin:.3g} to {end:.3g}: beta {self.beta:.4g} [{low:.4g}, {high:.4g}], "
            f"zeta {self.zeta:.4g} [{least:.4g}, {most:.4g}]"
        )

    def velocity(self, x: "ArrayLike") -> Array:
        """Return the velocity vt/h at X, an array of any shape. Raises ValueError outside the range of the law."""
        x = self._inside(x)
        return x + interface_velocity(x, *self.constants)

    def depth(self, x: "ArrayLike") -> Array:
        """Return the depth u/h = ∫ (vt/h) dX/X at X, an array of any shape. Raises ValueError like `velocity`."""
        x = self._inside(x)
        return x + interface_depth(x, *self.constants)

    @property
    def constants(self) -> tuple[float, ...]:
        """Return the constants A, b, s, m and d of g, in the order of `CONSTANTS`."""
        return self.amplitude, self.exponent, self.bend, self.fall, self.cutoff

    def _inside(self, x: "ArrayLike") -> Array:
        """Return X as an array. Raises ValueError if a value lies outside the range of the law."""
        x = real_numbers("X of the law", x)
        if not np.all((x >= self.x_low) & (x <= self.x_high)):
            raise ValueError(
                f"X of the law for H = {self.hurst:g}: from {x.min():.3g} to {x.max():.3g}; "
                f"allowed: {self.x_low:.3g} to {self.x_high:.3g}, in which discs of {ACROSS} elements across confirm it"
            )
        return x


def _read(name: str, chosen: Callable[[dict[str, str]], bool], numbers: Sequence[str]) -> dict[str, Array]:
    """Return columns of a table in the folder data/: {name: array of numbers}.

    name : name of the file
    chosen : function of a row that returns whether the row is used; used rows are sorted by increasing H
    numbers : names of the columns
    """
    with resources.files("viscorough.law").joinpath(f"data/{name}").open(encoding="utf-8") as file:
        rows = sorted(filter(chosen, csv.DictReader(file)), key=lambda row: float(row["hurst"]))
    return {name: np.array([float(row[name] or "nan") for row in rows]) for name in numbers}


@cache
def calibration() -> dict[str, Array]:
    """Return the power laws of discs in region (b): {column: array with a number for each H}; H increases.

    The columns are the keys of COLUMNS, except "source".
    """
    names = [name for name in COLUMNS if name != "source"]
    return _read("calibration.csv", lambda row: row["source"] == "discs", names)


@cache
def interface_calibration() -> dict[str, Array]:
    """Return the constants, errors and range of the law: {column of data/law.csv: array}.

    Each array has a number for each Hurst exponent of `calibration`.
    """
    names = ("hurst", *CONSTANTS, "velocity_error", "depth_error", "x_low", "x_high")
    return _read("law.csv", lambda row: int(row["across"]) == ACROSS, names)


def law_covers(hurst: float, x: Numbers | None = None) -> bool:
    """Return True if the law is calibrated for the Hurst exponent and, if `x` is given, confirmed at all these X."""
    low, high = _calibrated_hurst()
    if x is None or not low <= hurst <= high:
        return low <= hurst <= high
    law = penetration_law(hurst)
    return bool(np.all((np.asarray(x) >= law.x_low) & (np.asarray(x) <= law.x_high)))


def _calibrated_hurst() -> tuple[float, float]:
    """Return the smallest and the largest Hurst exponent for which the law is calibrated."""
    low, high = calibration()["hurst"][[0, -1]]
    return float(low), float(high)


def penetration_law(hurst: float) -> PenetrationLaw:
    """Return the PenetrationLaw of a self-affine surface with Hurst exponent H.

    Between the calibrated Hurst exponents, constants and intervals are interpolated linearly in H. For constants that
    are values of X, the logarithms are interpolated.

    The law was tested on a further sample of discs of 257 elements across, also at Hurst exponents between the
    calibrated exponents. docs/verification.md states the largest differences. The depth depends
    on the grid: at small X the law exceeds the mean u/h of discs of 129 elements across by more than a tenth.

    Parameters
    ----------
    hurst : float
        Hurst exponent H, from 0.1 to 1.

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
    low, high = _calibrated_hurst()
    hurst = real_number("argument hurst", hurst)
    if not low <= hurst <= high:
        raise ValueError(f"argument hurst: must be from {low:g} to {high:g} for the penetration law, not {hurst!r}")

    def linear(name: str, columns: dict[str, Array] = table) -> float:
        return float(np.interp(hurst, columns["hurst"], columns[name]))

    def logarithmic(name: str, columns: dict[str, Array] = table) -> float:
        place = np.interp(hurst, columns["hurst"], np.arange(len(columns["hurst"])))
        first = min(int(place), len(columns["hurst"]) - 2)
        below, above = columns[name][first : first + 2]
        # If below == above, this is exactly that value, without rounding.
        return float(below * (above / below) ** (place - first))

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
