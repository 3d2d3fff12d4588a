"""Prefactor ζ in every combination of the conventions that the paper leaves open, compared with Eqs. (4) and (11).

A combination names the surfaces (the disc's cut, corners of the spectrum, kind of amplitudes) and the conventions of
viscorough_study.fits.conventions. Over the Hurst exponents of a combination, the ratios of ζ to a law have

- a largest deviation, max |ln ratio|, by which combinations are ranked;
- an rms deviation √(mean ln² ratio);
- a common factor c = exp(mean ln ratio), the same for all H;
- an rms deviation from c times the law: the error of the law's shape in H, irrespective of its absolute value.
"""

import numpy as np

from viscorough import reference
from viscorough_study.fits.conventions import NAMES, in_every_reading, left_open
from viscorough_study.fits.intervals import described

COMBINED = ["case_group", *NAMES]  # columns that name a combination
LAWS = {"eq4": ("Eq. 4", reference.zeta_elastic), "eq11": ("Eq. 11", reference.zeta_viscous)}


def _law_columns():
    """Columns that compare ζ with each law."""
    columns = {name: (f"ζ over {title}", "1") for name, (title, _) in LAWS.items()}
    for name, (title, _) in LAWS.items():
        columns |= {
            f"worst_{name}": (f"largest |ln| of the ratio to {title} over all Hurst exponents", "1"),
            f"deviation_{name}": (f"rms over all Hurst exponents of ln of the ratio to {title}", "1"),
            f"common_{name}": (f"common factor of all Hurst exponents: geometric mean of the ratios to {title}", "1"),
            f"shape_{name}": (f"rms over all Hurst exponents of ln of the ratio to common factor times {title}", "1"),
        }
    return columns


COLUMNS = {
    "case_group": ("base, or name of the variant of the surfaces", ""),
    "period": ("period of the square that the disc is cut from, in diameters", "1"),
    "corners": ("whether the spectrum has waves beyond the Nyquist circle", ""),
    "amplitudes": ("random or fixed amplitudes of the waves", ""),
    "rms_convention": ("h: rms height of the disc, of the square or of the ensemble, or the highest peak", ""),
    "average": ("mean over the realizations at fixed X", ""),
    "window_rule": ("rule of the window of the fit", ""),
    "gamma": ("law with or without the factor 1/Γ(2−α)", ""),
    "diameter_convention": ("L in X and κ: the diameter or, contradicting the paper, the radius", ""),
    "status": ("left open by the paper, or contradicts the paper", ""),
    "hurst": ("Hurst exponent H", "1"),
    **described("zeta", "prefactor ζ", ends="of the 95 % interval of ζ"),
    **_law_columns(),
}


def prefactors(scaling, surfaces):
    """ζ of the discs in every combination of conventions; a pandas.DataFrame with the columns of `COLUMNS`.

    scaling : table of viscorough_study.fits.fit_table
    surfaces : {case_group: {"period", "corners", "amplitudes"}} of the groups to be compared
    The columns over all Hurst exponents are nan for a combination in which one of them has no window.
    """
    discs = scaling[(scaling["source"] == "discs") & scaling["case_group"].isin(list(surfaces))]
    table = in_every_reading(discs)
    for name in ("period", "corners", "amplitudes"):
        table[name] = [surfaces[group][name] for group in table["case_group"]]
    table["corners"] = np.where(table["corners"], "yes", "no")
    open_rows = table.index.isin(left_open(table).index)
    table["status"] = np.where(open_rows, "left open by the paper", "contradicts the paper")
    for name, (_, law) in LAWS.items():
        table[name] = table["zeta"] / law(table["hurst"])
        logarithm = np.log(table[name])
        mean = _over_hursts(table, logarithm)
        table[f"worst_{name}"] = _over_hursts(table, logarithm.abs(), "max")
        table[f"deviation_{name}"] = np.sqrt(_over_hursts(table, logarithm**2))
        table[f"common_{name}"] = np.exp(mean)
        table[f"shape_{name}"] = np.sqrt(_over_hursts(table, (logarithm - mean) ** 2))
    return table[list(COLUMNS)]


def _over_hursts(table, values, statistic="mean"):
    """Mean or maximum of values over the Hurst exponents of each combination, nan if one is missing."""
    combination = [table[name] for name in COMBINED]
    complete = values.notna().groupby(combination).transform("all")
    return values.groupby(combination).transform(statistic).where(complete)


def ranked(table, law):
    """Combinations of conventions, as dicts, by ascending deviation from a law ("eq4" or "eq11").

    Combinations in which a Hurst exponent has no window are omitted.
    """
    complete = table[table[f"worst_{law}"].notna()].sort_values(f"worst_{law}", kind="stable")
    return complete[COMBINED].drop_duplicates().to_dict("records")


def combination_rows(table, combination):
    """Rows of one combination of conventions, by ascending Hurst exponent."""
    for name, value in combination.items():
        table = table[table[name] == value]
    return table.sort_values("hurst")


def combinations(table):
    """All combinations of conventions in a table, as dicts."""
    return table[COMBINED].drop_duplicates().to_dict("records")
