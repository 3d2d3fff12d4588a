"""The recommended penetration law, calibrated with boundary elements on the paper's grid: region (b) and beyond.

Two springs in series, the interface and the flat punch of the whole disc, have vt/h = X + g(X) with X =
Ft/(4ηhL). The contribution of the interface is

    g = g_m (X/X_m)^b exp(2b(1 − √(X/X_m))):

a power law with the exponent b at small X; a maximum g_m at X_m, around which the stiffness of the interface is
proportional to the force, as in elastic contacts whose force is exponential in the separation; at large X it vanishes,
and vt/h = X, region (c). The constants b, g_m, X_m are those of data/interface.csv, a copy of
results/tables/interface.csv from `make paper`, which also has the error of the law. β and ζ of the paper's power law in
region (b) are those of data/calibration.csv, a copy of results/tables/calibration.csv.

Conventions: geometric mean at fixed X, h the rms height of the disc, L its diameter, no factor Γ; the power law is
fitted over the whole region (b). Grids: 257 elements across; at small X the law contains their finest waves, and b is
the exponent of these curves, not of an infinitely fine grid. Where the curves end before X = 30, the law beyond rests
on its form alone, and on vt/h = X at complete contact.
"""

import csv
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from importlib import resources

import numpy as np
from scipy.special import gamma as gamma_function
from scipy.special import gammainc

from viscorough.types import Array, Numbers

X_LOW, X_HIGH = 1e-3, 30.0  # the widest range of the law; from X_HIGH on, vt/h is X to 2 %
LARGEST_DEVIATION = 0.05  # of the law from the mean vt/h of the calibration, in its range

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


def interface_velocity(x: Numbers, exponent: float, peak: float, peak_x: float) -> Array:
    """g(X), the interface's part of vt/h: peak (X/peak_x)^exponent exp(2 exponent (1 − √(X/peak_x))); any shape."""
    scaled = x / peak_x
    return peak * scaled**exponent * np.exp(2 * exponent * (1 - np.sqrt(scaled)))


def interface_depth(x: Numbers, exponent: float, peak: float, peak_x: float) -> Array:
    """∫₀^X g dX/X, the interface's part of u/h: 2 peak (e/2b)^(2b) γ(2b, 2b√(X/peak_x)), b = exponent; any shape.

    γ(a, w) = ∫₀^w s^(a−1) e^(−s) ds is the lower incomplete gamma function.
    """
    twice = 2 * exponent
    incomplete = gammainc(twice, twice * np.sqrt(x / peak_x)) * gamma_function(twice)
    return 2 * peak * (np.e / twice) ** twice * incomplete


@dataclass(frozen=True)
class PenetrationLaw:
    """vt/h = X + g(X) for x_low <= X <= x_high, X = Ft/(4ηhL), and X^beta/zeta in region (b) (paper, Eqs. 1 to 3, 10).

    All quantities are dimensionless. The law deviates by at most 5 % from the mean vt/h of every ensemble of the
    calibration, and by at most `error` from the ends of the 95 % intervals of these means.

    hurst : Hurst exponent H
    beta, zeta : exponent β and prefactor ζ of the power law in region (b), independent of all other attributes
    beta_interval, zeta_interval : (lower, upper) ends of their 95 % confidence intervals, from the ensembles of the
        calibration
    region : (lower, upper) end of region (b) in X
    exponent, peak, peak_x : constants b, g_m and X_m of g, see `interface_velocity`
    depth_offset, depth_offset_interval : u/h less the integral of the law from X = 0 on, because of the approach before
        the first contact spots; its 95 % interval
    error : relative error of vt/h, as a mean of many surfaces
    x_low, x_high : range of the law in X
    """

    hurst: float
    beta: float
    beta_interval: tuple
    zeta: float
    zeta_interval: tuple
    region: tuple
    exponent: float
    peak: float
    peak_x: float
    depth_offset: float
    depth_offset_interval: tuple
    error: float
    x_low: float
    x_high: float

    def velocity(self, x: Numbers) -> Array:
        """vt/h at X, any shape. Raises ValueError outside the range of X in which the law was calibrated."""
        x = self._inside(x)
        return x + interface_velocity(x, self.exponent, self.peak, self.peak_x)

    def velocity_interval(self, x: Numbers) -> tuple[Array, Array]:
        """(lower, upper) ends of vt/h, by the relative error of the law: arrays.

        This is the uncertainty of the mean of many surfaces; single ones scatter more. Raises ValueError as `velocity`.
        """
        velocity = self.velocity(x)
        return velocity * (1 - self.error), velocity * (1 + self.error)

    def depth(self, x: Numbers) -> Array:
        """u/h = ∫ vt/h dX/X at X, any shape. Raises ValueError as `velocity`.

        Below x_low the law does not hold: the grid of the calibration limits the approach before the first contacts.
        What this changes is one constant, `depth_offset`.
        """
        return self._depth(self._inside(x), self.depth_offset)

    def depth_interval(self, x: Numbers) -> tuple[Array, Array]:
        """(lower, upper) ends of u/h over the interval of the offset and the error of vt/h; see `velocity_interval`."""
        x = self._inside(x)
        low, high = (self._depth(x, offset) for offset in self.depth_offset_interval)
        return low * (1 - self.error), high * (1 + self.error)

    def _depth(self, x: Array, offset: float) -> Array:
        return offset + x + interface_depth(x, self.exponent, self.peak, self.peak_x)

    def _inside(self, x: Numbers) -> Array:
        """X as an array. Raises ValueError outside the range of the law."""
        x = np.asarray(x, dtype=float)
        if not np.all((x >= self.x_low) & (x <= self.x_high)):
            raise ValueError(
                f"X of the law for H = {self.hurst:g}: from {x.min():.3g} to {x.max():.3g}; "
                f"allowed: {self.x_low:.3g} to {self.x_high:.3g}, in which discs of 257 elements across calibrated it"
            )
        return x


def _read(name: str, chosen: Callable[[dict[str, str]], bool], numbers: Sequence[str]) -> dict[str, Array]:
    """Columns of a table in data/, {name: array over ascending H}, of the rows that are chosen."""
    with resources.files("viscorough").joinpath(f"data/{name}").open(encoding="utf-8") as file:
        rows = sorted(filter(chosen, csv.DictReader(file)), key=lambda row: float(row["hurst"]))
    return {name: np.array([float(row[name] or "nan") for row in rows]) for name in numbers}


@cache
def calibration() -> dict[str, Array]:
    """The power law of discs in region (b), {column of COLUMNS but the source: array over ascending H}."""
    return _read(
        "calibration.csv", lambda row: row["source"] == "discs", [name for name in COLUMNS if name != "source"]
    )


@cache
def interface_calibration() -> dict[str, Array]:
    """The law beyond region (b), {column of data/interface.csv: array over the H of `calibration`}."""
    names = ("hurst", "exponent", "peak", "peak_x", "law_low", "error", "depth_offset", "depth_low", "depth_high")
    chosen = {"source": "discs", "average": "geometric", "across": "257"}

    def table(group: str) -> dict[str, Array]:
        return _read("interface.csv", lambda row: row.items() >= (chosen | {"case_group": group}).items(), names)

    tables = table("base"), table("sizes")
    # Exponents that only the grids from coarse to fine have, such as H = 1.
    further = ~np.isin(tables[1]["hurst"], tables[0]["hurst"]) & np.isin(tables[1]["hurst"], calibration()["hurst"])
    joined = {name: np.append(tables[0][name], tables[1][name][further]) for name in names}
    order = np.argsort(joined["hurst"])
    return {name: values[order] for name, values in joined.items()}


def penetration_law(hurst: float) -> PenetrationLaw:
    """PenetrationLaw of a self-affine surface with Hurst exponent H.

    Between the calibrated exponents all constants and intervals are interpolated linearly in H, of places in X their
    logarithms.

    Parameters
    ----------
    hurst : float
        Hurst exponent H, 0.1 to 1.

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
    if not low <= hurst <= high:
        raise ValueError(f"hurst of the penetration law: must be from {low:g} to {high:g}, not {hurst!r}")

    def linear(name: str, columns: dict[str, Array] = table) -> float:
        return float(np.interp(hurst, columns["hurst"], columns[name]))

    def logarithmic(name: str, columns: dict[str, Array] = table) -> float:
        place = np.interp(hurst, columns["hurst"], np.arange(len(columns["hurst"])))
        first = min(int(place), len(columns["hurst"]) - 2)
        below, above = columns[name][first : first + 2]
        return float(below * (above / below) ** (place - first))  # exactly the same value where both ends have it

    return PenetrationLaw(
        hurst=float(hurst),
        beta=linear("beta"),
        beta_interval=(linear("beta_low"), linear("beta_high")),
        zeta=linear("zeta"),
        zeta_interval=(linear("zeta_low"), linear("zeta_high")),
        region=(logarithmic("x_low"), logarithmic("x_high")),
        exponent=linear("exponent", beyond),
        peak=linear("peak", beyond),
        peak_x=logarithmic("peak_x", beyond),
        depth_offset=linear("depth_offset", beyond),
        depth_offset_interval=(linear("depth_low", beyond), linear("depth_high", beyond)),
        error=linear("error", beyond),
        x_low=logarithmic("law_low", beyond),
        x_high=X_HIGH,
    )
