"""The recommended penetration law of region (b), vt/h = X^β/ζ, calibrated with boundary elements at the paper's scale.

The numbers are those of data/calibration.csv, a copy of results/tables/calibration.csv from `make paper`. Conventions:
geometric mean at fixed X, h the rms height of the disc, L its diameter, no factor Γ, fitted over the whole region (b).
The depth, which starts before region (b), needs one number more: the claim `depth` of docs/claims.csv, in
data/depth_ratio.csv.
"""

import csv
from dataclasses import dataclass
from functools import cache
from importlib import resources
from itertools import product

import numpy as np

COLUMNS = {
    "source": ("discs (boundary elements) or lines (reduction of dimensionality)", ""),
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


@dataclass(frozen=True)
class PenetrationLaw:
    """vt/h = X^beta/zeta for x_low <= X <= x_high, X = Ft/(4ηhL) (paper, Eqs. 1 to 3 and 10).

    All quantities are dimensionless.

    hurst : Hurst exponent H
    beta, zeta : exponent β and prefactor ζ
    beta_interval, zeta_interval : (lower, upper) ends of their 95 % confidence intervals, from the ensembles of the
        calibration
    depth_ratio, depth_ratio_interval : depth over X^β/(ζβ) at the geometric centre of region (b); its 95 % interval
    x_low, x_high : ends of region (b) in X
    """

    hurst: float
    beta: float
    beta_interval: tuple
    zeta: float
    zeta_interval: tuple
    depth_ratio: float
    depth_ratio_interval: tuple
    x_low: float
    x_high: float

    def velocity(self, x):
        """vt/h at X, any shape. Raises ValueError outside the range of X in which the law was calibrated."""
        return self._velocity(self._inside(x), self.beta, self.zeta)

    def velocity_interval(self, x):
        """(lower, upper) ends of vt/h over the intervals of β and ζ, taken as independent of each other: arrays.

        This is the uncertainty of the mean of many surfaces; single ones scatter more. Raises ValueError as `velocity`.
        """
        x = self._inside(x)
        ends = [self._velocity(x, *law) for law in product(self.beta_interval, self.zeta_interval)]
        return np.min(ends, axis=0), np.max(ends, axis=0)

    def depth(self, x):
        """u/h at X, any shape: ∫dX/κ = X^β/(ζβ), less what depth and force of the first contact leave.

        The law holds from x_low on, and does not start at depth zero there (Eq. 6 of the paper assumes so). What is
        left is one constant, by which u is `depth_ratio` times X^β/(ζβ) at the geometric centre of region (b).
        Raises ValueError as `velocity`.
        """
        return self._depth(self._inside(x), self.beta, self.zeta, self.depth_ratio)

    def depth_interval(self, x):
        """(lower, upper) ends of u/h over the intervals of β, ζ and the ratio; see `velocity_interval`."""
        x = self._inside(x)
        intervals = self.beta_interval, self.zeta_interval, self.depth_ratio_interval
        ends = [self._depth(x, *law) for law in product(*intervals)]
        return np.min(ends, axis=0), np.max(ends, axis=0)

    def _velocity(self, x, beta, zeta):
        return x**beta / zeta

    def _depth(self, x, beta, zeta, ratio):
        centre = np.sqrt(self.x_low * self.x_high)
        return (x**beta - (1 - ratio) * centre**beta) / (zeta * beta)

    def _inside(self, x):
        """X as an array. Raises ValueError outside region (b)."""
        x = np.asarray(x, dtype=float)
        if not np.all((x >= self.x_low) & (x <= self.x_high)):
            raise ValueError(
                f"X of the law for H = {self.hurst:g}: from {x.min():.3g} to {x.max():.3g}; "
                f"allowed: {self.x_low:.3g} to {self.x_high:.3g}, region (b) of a disc of 257 elements across"
            )
        return x


@cache
def calibration():
    """The calibrated numbers of discs, {column of COLUMNS: array over ascending H}."""
    with resources.files("viscorough").joinpath("data/calibration.csv").open(encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row.pop("source") == "discs"]
    rows.sort(key=lambda row: float(row["hurst"]))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


@cache
def depth_ratios():
    """Depth over X^β/(ζβ) at the centre of region (b): {"hurst", "ratio", "low", "high": array over ascending H}."""
    with resources.files("viscorough").joinpath("data/depth_ratio.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def penetration_law(hurst):
    """PenetrationLaw of a self-affine surface with Hurst exponent H.

    Between the calibrated exponents, β, ζ, the ratio of depths and their intervals are interpolated linearly in H, as
    is ln X at the ends of region (b).
    Raises ValueError for a Hurst exponent outside the calibrated range.
    """
    table = calibration()
    low, high = table["hurst"][[0, -1]]
    if not low <= hurst <= high:
        raise ValueError(f"hurst of the penetration law: must be from {low:g} to {high:g}, not {hurst!r}")

    def linear(name):
        return float(np.interp(hurst, table["hurst"], table[name]))

    def ratio(name):
        return float(np.interp(hurst, depth_ratios()["hurst"], depth_ratios()[name]))

    def logarithmic(name):
        return float(np.exp(np.interp(hurst, table["hurst"], np.log(table[name]))))

    return PenetrationLaw(
        hurst=float(hurst),
        beta=linear("beta"),
        beta_interval=(linear("beta_low"), linear("beta_high")),
        zeta=linear("zeta"),
        zeta_interval=(linear("zeta_low"), linear("zeta_high")),
        depth_ratio=ratio("ratio"),
        depth_ratio_interval=(ratio("low"), ratio("high")),
        x_low=logarithmic("x_low"),
        x_high=logarithmic("x_high"),
    )
