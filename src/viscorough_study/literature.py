"""What others found on rough contacts (resources/literature), with the numbers of this study beside it."""

import numpy as np
import pandas as pd

from viscorough import reference
from viscorough_study.conventions import fits

COLUMNS = {
    "year": ("year of publication", "1"),
    "source": ("authors", ""),
    "place": ("journal, volume and page", ""),
    "when": ("before or after the paper", ""),
    "statement": ("what was found, in our words", ""),
    "sure": ("how the statement is known: abstract, the paper, which quotes it, or memory", ""),
    "quantity": ("quantity of this study beside it: alpha (1 − β of discs), u0 (u₀/h of the interface), or none", ""),
    "hurst": ("Hurst exponent H of the values", "1"),
    "theirs_low": ("lower end of the stated range, or the law at this H", "1"),
    "theirs_high": ("upper end of the stated range, or the law at this H", "1"),
    "value": ("value of this study", "1"),
    "low": ("lower end of its 95 % interval", "1"),
    "high": ("upper end of its 95 % interval", "1"),
}
NONE = [(np.nan, np.nan, np.nan, np.nan)]  # H, value, low and high where nothing of this study stands beside it


def literature(entries, scaling, interface, conventions):
    """A row for every source and Hurst exponent; a pandas.DataFrame with the columns of `COLUMNS`, by year.

    entries : content of resources/literature/stiffness.yaml; scaling, interface : the tables of these names
    conventions : those of the figures
    """
    ours = {
        "alpha": _alpha(fits(scaling, conventions, source="discs", case_group="base")),
        "u0": _u0(interface, conventions["average"]),
        "none": NONE,
    }
    rows = []
    for entry in sorted(entries, key=lambda entry: entry["year"]):
        known = {name: entry[name] for name in ("year", "source", "place", "when", "statement", "sure")}
        for hurst, value, low, high in ours[entry["ours"]]:
            theirs = entry.get("theirs", {"low": np.nan, "high": np.nan})
            if "law" in entry:
                theirs = dict.fromkeys(("low", "high"), getattr(reference, entry["law"])(hurst))
            values = {"hurst": hurst, "value": value, "low": low, "high": high}
            values |= {f"theirs_{end}": theirs[end] for end in ("low", "high")}
            rows.append(known | {"quantity": entry["ours"]} | values)
    return pd.DataFrame(rows, columns=list(COLUMNS))


def _alpha(rows):
    """H, 1 − β and its interval of every fit."""
    return [(row.hurst, 1 - row.beta, 1 - row.beta_high, 1 - row.beta_low) for row in rows.itertuples()] or NONE


def _u0(interface, average):
    """H, u₀/h and its interval of the base discs."""
    rows = interface[(interface["source"] == "discs") & (interface["case_group"] == "base")]
    rows = rows[rows["average"] == average].sort_values("hurst")
    return rows[["hurst", "u0", "u0_low", "u0_high"]].to_numpy().tolist() or NONE
