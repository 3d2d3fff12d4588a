"""The prefactor ζ in every combination of the conventions that the paper leaves open, against Eqs. (4) and (11)."""

from itertools import product

import numpy as np
import pandas as pd

from viscorough import reference
from viscorough_study.conventions import FACTORS, NAMES, factor_scale, in_every_reading

COMBINED = [*NAMES, "factor"]  # columns that name a combination
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
    "zeta_low": ("lower end of the 95 % interval of ζ; with a factor, scaled like ζ", "1"),
    "zeta_high": ("upper end of the 95 % interval of ζ; with a factor, scaled like ζ", "1"),
    "eq4": ("ζ over π(3 − H)/10, Eq. 4", "1"),
    "eq11": ("ζ over 2 − H, Eq. 11", "1"),
    "worst_eq4": ("largest |ln| of the ratio to Eq. 4 over all Hurst exponents", "1"),
    "worst_eq11": ("largest |ln| of the ratio to Eq. 11 over all Hurst exponents", "1"),
}


def prefactors(scaling):
    """ζ of the base discs in every combination of conventions; a pandas.DataFrame with the columns of `COLUMNS`.

    scaling : table of viscorough_study.fit_table
    `worst_eq4` and `worst_eq11` are nan for a combination in which not every Hurst exponent has a window.
    """
    discs = in_every_reading(scaling[(scaling["source"] == "discs") & (scaling["case_group"] == "base")])
    table = pd.concat([_with_factor(discs, factor) for factor in FACTORS], ignore_index=True)
    combination = [table[name] for name in COMBINED]
    complete = table["zeta"].notna().groupby(combination).transform("all")
    for name, law in LAWS.items():
        table[name] = table["zeta"] / law(table["hurst"])
        worst = np.abs(np.log(table[name])).groupby(combination).transform("max")
        table[f"worst_{name}"] = worst.where(complete)
    return table[list(COLUMNS)]


def _with_factor(fits, factor):
    scale = factor_scale(fits["beta"], factor)
    scaled = {name: fits[name] * scale for name in ("zeta", "zeta_low", "zeta_high")}
    return fits.assign(factor=factor, **scaled)


def ranked(table, law):
    """Combinations of conventions, as dicts, from the nearest to a law ("eq4" or "eq11") to the farthest.

    Those in which not every Hurst exponent has a window are left out.
    """
    complete = table[table[f"worst_{law}"].notna()].sort_values(f"worst_{law}", kind="stable")
    return complete[COMBINED].drop_duplicates().to_dict("records")


def rows_of(table, combination):
    """Rows of one combination of conventions, by ascending Hurst exponent."""
    for name, value in combination.items():
        table = table[table[name] == value]
    return table.sort_values("hurst")


def combinations(table):
    """All combinations of conventions in a table, as dicts."""
    present = [list(dict.fromkeys(table[name])) for name in COMBINED]
    return [dict(zip(COMBINED, values, strict=True)) for values in product(*present)]
