"""The conventions that the paper leaves open, and the conversion of fits between readings of the law.

The paper states neither where the rms height h is measured, nor how realizations are averaged, nor over which window
its power laws are fitted, and it prints some laws with a factor 1/Γ(2 − α) that others lack. The first three
conventions (`FITTED`) change the mean curve or the window: each combination needs a fit. The others (`READINGS`) only
rescale a fit of vt/h = X^β/ζ. One of them is not open: the paper says that L is the diameter. The tables include the
radius to show the effect of a misprint, but no claim is judged by it (`left_open`).

- With L the radius, X = F/(4GhL) and κ = k/(4GL) are doubled while vt/h is not. The window doubles, and ζ is 2^β times
  its value with the diameter.
- In the law with the factor (Eq. 9), vt/h = X^β/(ζ Γ(1 + β)), where 1 + β = 2 − α, ζ is 1/Γ(1 + β) times its value
  without.

Twice the force, or half the modulus, has the same effect as the radius.

β, λ, the residual and the decades of the window do not depend on the reading, and window and ζ follow from those of
the plain reading (no factor, L the diameter), so the tables of fits contain them once. The 95 % interval of ζ does not:
its ends are percentiles of bootstrap samples, each scaled with its own β. It is stored for every reading, in the
columns that `interval_columns` names.
"""

from itertools import product

import pandas as pd
from scipy.special import gamma as gamma_function

FITTED = {
    "rms_convention": ("disc", "square", "peak", "ensemble"),  # of lines: "line"
    "average": ("arithmetic", "geometric"),
    "window_rule": ("default", "lower_half", "upper_half", "kappa"),
}
READINGS = {"gamma": ("without", "with"), "diameter_convention": ("diameter", "radius")}
VALUES = FITTED | READINGS  # convention: its allowed values
NAMES = list(VALUES)
LENGTH = {"diameter": 1.0, "radius": 0.5}  # L over the diameter
CONTRADICTING = {"diameter_convention": ("radius",)}  # values that the text of the paper excludes
PLAIN = {"gamma": "without", "diameter_convention": "diameter"}


def readings():
    """All readings of the law, as dicts {convention: value}, the plain one first."""
    return [dict(zip(READINGS, values, strict=True)) for values in product(*READINGS.values())]


def zeta_scale(beta, *, gamma, diameter_convention):
    """ζ in a reading of the law over ζ in the plain reading; of the shape of β.

    Raises ValueError for a value that is not one of `READINGS`.
    """
    for name, value in {"gamma": gamma, "diameter_convention": diameter_convention}.items():
        if value not in READINGS[name]:
            raise ValueError(f"{name}: must be one of {', '.join(READINGS[name])}, not {value!r}")
    scale = (1 / LENGTH[diameter_convention]) ** beta
    return scale / gamma_function(1 + beta) if gamma == "with" else scale


def interval_columns(*, gamma, diameter_convention):
    """Names of the columns with the lower and the upper end of the interval of ζ in a reading of the law."""
    reading = "_with_gamma" * (gamma == "with") + "_radius" * (diameter_convention == "radius")
    return f"zeta_low{reading}", f"zeta_high{reading}"


def in_reading(fits, *, gamma, diameter_convention):
    """Fits converted to one reading of the law: ζ, its interval and the window.

    fits : pandas.DataFrame with the columns of viscorough_study.fits.fit_table
    Returns a DataFrame with columns for the reading, and without the intervals of the other readings.
    """
    reading = {"gamma": gamma, "diameter_convention": diameter_convention}
    low, high = interval_columns(**reading)
    changed = {
        "zeta": fits["zeta"] * zeta_scale(fits["beta"], **reading),
        "zeta_low": fits[low],
        "zeta_high": fits[high],
        **{name: fits[name] / LENGTH[diameter_convention] for name in ("x_low", "x_high")},
    }
    others = {name for other in readings() for name in interval_columns(**other)} - {"zeta_low", "zeta_high"}
    return fits.assign(**changed, **reading).drop(columns=list(others))


def in_every_reading(fits):
    """Fits in all readings of the law; the readings of one fit are in consecutive rows."""
    parts = [in_reading(fits, **reading) for reading in readings()]
    return pd.concat(parts).sort_index(kind="stable").reset_index(drop=True)


def left_open(table):
    """Rows of a table whose conventions do not contradict the paper."""
    for name, values in CONTRADICTING.items():
        table = table[~table[name].isin(values)]
    return table


def as_text(conventions):
    """Conventions as text, such as "rms_convention disc, average geometric"."""
    return ", ".join(f"{name} {value}" for name, value in conventions.items())


def select(table, wanted):
    """Rows of a table of fits with these values of columns, converted to the requested reading of the law.

    wanted : {column or convention: value}, with both conventions of `READINGS`
    """
    for column, value in wanted.items():
        if column not in READINGS:
            table = table[table[column] == value]
    return in_reading(table, **{name: wanted[name] for name in READINGS}).sort_values("hurst", kind="stable")


def fits(table, conventions, **wanted):
    """Rows of a table of fits in these conventions and with these values, by ascending H.

    conventions, wanted : {column or convention: value}; `wanted` replaces conventions of the same name
    Rows without a region (b), and so without an exponent, are omitted.
    """
    return select(table, conventions | wanted).dropna(subset="beta")


def source_values(source):
    """{column: value} that selects discs or lines; lines have a single rms convention."""
    return {"source": source} | ({"rms_convention": "line"} if source == "lines" else {})
