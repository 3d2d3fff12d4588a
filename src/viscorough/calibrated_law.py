"""The recommended law of region (b), vt/h = X^β/ζ, with numbers calibrated by boundary elements at the paper's scale.

The numbers stand in data/calibration.csv, a copy of results/tables/calibration.csv of `make paper`: the geometric mean
at fixed X, h the rms height of the disc, L its diameter, no Γ, over the whole of region (b).
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

    beta_interval, zeta_interval : 95 %, of the ensembles that they come from
    """

    hurst: float
    beta: float
    beta_interval: tuple
    zeta: float
    zeta_interval: tuple
    x_low: float
    x_high: float

    def velocity(self, x):
        """vt/h at X, any shape. Raises ValueError outside the range of X, where the law was not seen to hold."""
        x = np.asarray(x, dtype=float)
        if not np.all((x >= self.x_low) & (x <= self.x_high)):
            raise ValueError(
                f"X of the law for H = {self.hurst:g}: from {x.min():.3g} to {x.max():.3g}; "
                f"allowed: {self.x_low:.3g} to {self.x_high:.3g}, region (b) of a disc of 257 elements across"
            )
        return x**self.beta / self.zeta


@cache
def calibration():
    """The calibrated numbers of discs: {column: values by ascending H}."""
    with resources.files("viscorough").joinpath("data/calibration.csv").open(encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row.pop("source") == "discs"]
    rows.sort(key=lambda row: float(row["hurst"]))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def penetration_law(hurst):
    """PenetrationLaw of a self-affine surface; between the calibrated Hurst exponents linear in H (X: in ln X).

    Raises ValueError for a Hurst exponent outside those that were calibrated.
    """
    table = calibration()
    low, high = table["hurst"][[0, -1]]
    if not low <= hurst <= high:
        raise ValueError(f"hurst of the penetration law: must be from {low:g} to {high:g}, not {hurst!r}")

    def at(name):
        return float(np.interp(hurst, table["hurst"], table[name]))

    def in_logarithm(name):
        return float(np.exp(np.interp(hurst, table["hurst"], np.log(table[name]))))

    return PenetrationLaw(
        hurst=float(hurst),
        beta=at("beta"),
        beta_interval=(at("beta_low"), at("beta_high")),
        zeta=at("zeta"),
        zeta_interval=(at("zeta_low"), at("zeta_high")),
        x_low=in_logarithm("x_low"),
        x_high=in_logarithm("x_high"),
    )
