"""The prefactor ζ under every combination of what the paper leaves open, against Eqs. (4) and (11)."""

from itertools import product

import numpy as np
import pandas as pd

from viscorough import reference

CONVENTIONS = ["rms_convention", "average", "window_rule", "gamma", "diameter_convention"]
FACTORS = (1, 2)
LAWS = {"eq4": reference.zeta_elastic, "eq11": reference.zeta_viscous}
COLUMNS = {
    "rms_convention": ("h: rms height of the disc or of the square, or the highest peak", ""),
    "average": ("mean over the realizations at fixed X", ""),
    "window_rule": ("rule of the window of the fit", ""),
    "gamma": ("law with or without the factor 1/Γ(2−α)", ""),
    "diameter_convention": ("L in X and κ is the diameter or the radius", ""),
    "factor": ("factor in force and stiffness over modulus: 2 if F is twice, or G half, of what was meant", "1"),
    "hurst": ("Hurst exponent H", "1"),
    "zeta": ("prefactor ζ", "1"),
    "zeta_low": ("lower end of the 95 % interval of ζ", "1"),
    "zeta_high": ("upper end of the 95 % interval of ζ", "1"),
    "eq4": ("ζ over π(3 − H)/10, Eq. 4", "1"),
    "eq11": ("ζ over 2 − H, Eq. 11", "1"),
    "worst_eq4": ("largest |ln| of the ratio to Eq. 4 over all Hurst exponents", "1"),
    "worst_eq11": ("largest |ln| of the ratio to Eq. 11 over all Hurst exponents", "1"),
}


def prefactors(scaling):
    """ζ of the base discs under every combination of conventions; a pandas.DataFrame with the columns of `COLUMNS`.

    scaling : table of viscorough_study.power_law
    A factor c in F/G scales X and κ alike, so that ζ is c^β times as large, as it is if L means the radius. `worst` is
    nan for a combination of conventions under which not every Hurst exponent has a window.
    """
    discs = scaling[(scaling["source"] == "discs") & (scaling["case_group"] == "base")]
    parts = []
    for factor in FACTORS:
        part = discs[[*CONVENTIONS, "hurst"]].assign(factor=factor)
        for name in ("zeta", "zeta_low", "zeta_high"):
            part[name] = discs[name] * factor ** discs["beta"]
        parts.append(part)
    table = pd.concat(parts, ignore_index=True)
    combination = table.groupby([*CONVENTIONS, "factor"], sort=False)
    for name, law in LAWS.items():
        table[name] = table["zeta"] / law(table["hurst"])
        logarithm = np.abs(np.log(table[name]))
        worst = logarithm.groupby([table[column] for column in [*CONVENTIONS, "factor"]]).transform("max")
        complete = combination["zeta"].transform(lambda values: values.notna().all())
        table[f"worst_{name}"] = worst.where(complete)
    return table[list(COLUMNS)]


def nearest(table, law):
    """Conventions, as a dict with `factor`, of the combination nearest to a law ("eq4" or "eq11"); None without any."""
    if table[f"worst_{law}"].isna().all():
        return None
    best = table.loc[table[f"worst_{law}"].idxmin()]
    return {name: best[name] for name in [*CONVENTIONS, "factor"]}


def rows_of(table, conventions):
    """Rows of one combination of conventions, by ascending Hurst exponent."""
    for name, value in conventions.items():
        table = table[table[name] == value]
    return table.sort_values("hurst")


def combinations(table):
    """All combinations of conventions in a table, as dicts."""
    names = [*CONVENTIONS, "factor"]
    present = [list(dict.fromkeys(table[name])) for name in names]
    return [dict(zip(names, values, strict=True)) for values in product(*present)]
