"""The recommended penetration law of region (b), vt/h = X^β/ζ, calibrated with boundary elements at the paper's scale.

The numbers are those of data/calibration.csv, a copy of results/tables/calibration.csv from `make paper`. Conventions:
geometric mean at fixed X, h the rms height of the disc, L its diameter, no factor Γ, fitted over the whole region (b).
"""

import csv
from dataclasses import dataclass
from functools import cache
from importlib import resources

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
    x_low, x_high : ends of region (b) in X
    """

    hurst: float
    beta: float
    beta_interval: tuple
    zeta: float
    zeta_interval: tuple
    x_low: float
    x_high: float

    def velocity(self, x):
        """vt/h at X, any shape. Raises ValueError outside the range of X in which the law was calibrated."""
        x = np.asarray(x, dtype=float)
        if not np.all((x >= self.x_low) & (x <= self.x_high)):
            raise ValueError(
                f"X of the law for H = {self.hurst:g}: from {x.min():.3g} to {x.max():.3g}; "
                f"allowed: {self.x_low:.3g} to {self.x_high:.3g}, region (b) of a disc of 257 elements across"
            )
        return x**self.beta / self.zeta


@cache
def calibration():
    """The calibrated numbers of discs, {column of COLUMNS: array over ascending H}."""
    with resources.files("viscorough").joinpath("data/calibration.csv").open(encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row.pop("source") == "discs"]
    rows.sort(key=lambda row: float(row["hurst"]))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def penetration_law(hurst):
    """PenetrationLaw of a self-affine surface with Hurst exponent H.

    Between the calibrated exponents, β, ζ and their intervals are interpolated linearly in H, as is ln X at
    the ends of region (b).
    Raises ValueError for a Hurst exponent outside the calibrated range.
    """
    table = calibration()
    low, high = table["hurst"][[0, -1]]
    if not low <= hurst <= high:
        raise ValueError(f"hurst of the penetration law: must be from {low:g} to {high:g}, not {hurst!r}")

    def linear(name):
        return float(np.interp(hurst, table["hurst"], table[name]))

    def logarithmic(name):
        return float(np.exp(np.interp(hurst, table["hurst"], np.log(table[name]))))

    return PenetrationLaw(
        hurst=float(hurst),
        beta=linear("beta"),
        beta_interval=(linear("beta_low"), linear("beta_high")),
        zeta=linear("zeta"),
        zeta_interval=(linear("zeta_low"), linear("zeta_high")),
        x_low=logarithmic("x_low"),
        x_high=logarithmic("x_high"),
    )
