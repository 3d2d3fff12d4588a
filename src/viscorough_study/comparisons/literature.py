"""Compare published results on rough contacts (resources/literature) with the results of this study."""

import numpy as np
import pandas as pd
from scipy.special import exprel

from viscorough import reference
from viscorough_study.fits.conventions import fits
from viscorough_study.fits.intervals import described_ends

COLUMNS = {
    "year": ("year of publication", "1"),
    "source": ("authors", ""),
    "place": ("journal, volume and page", ""),
    "statement": ("finding, in our words", ""),
    "sure": ("basis of the statement: abstract, the paper, or quoted by others", ""),
    "quantity": (
        "quantity compared: alpha (1 − β of discs), u0 (u₀/h of the interface), gamma (u₀/h over that of Persson's law "
        "without a factor), area and gap (contact and mean gap of a line over those of its disc at X = 0.01), or none",
        "",
    ),
    "hurst": ("Hurst exponent H of the values", "1"),
    **described_ends("theirs", "of the stated range, or of the law at this H"),
    "value": ("value of this study", "1"),
    "low": ("lower end of its 95 % interval", "1"),
    "high": ("upper end of its 95 % interval", "1"),
}
# Columns that describe a value of this study. `across`, the number of elements across the discs, is needed only for
# comparisons with Persson's law.
OURS = ["hurst", "value", "low", "high", "across"]
NONE = dict.fromkeys(OURS, np.nan)
X_COMPARED = 0.01  # reduced force X, in region (b), at which lines are compared with their discs


def literature(scaling, interface, reduction, *, entries, conventions):
    """Compare published values with the values of this study; return a pandas.DataFrame with `COLUMNS`.

    The table has a row for every publication, quantity and Hurst exponent, and is sorted by year.

    scaling : table of fitted power laws; interface : table of fits.interface
    reduction : table of comparisons.mdr_comparison
    entries : published findings, content of resources/literature/stiffness.yaml
    conventions : choices that the paper leaves open, {name of the choice: value used in the figures}
        (fits.conventions)
    """
    fitted = fits(scaling, conventions, source="discs", group="base")
    alpha = {"alpha": 1 - fitted["beta"], "alpha_low": 1 - fitted["beta_high"], "alpha_high": 1 - fitted["beta_low"]}
    u0 = _values(interface[interface["source"] == "discs"], "u0")
    at_x = reduction[np.log(reduction["x"] / X_COMPARED).abs() < 1e-6]
    ours = {
        "alpha": _values(fitted.assign(**alpha), "alpha"),
        "u0": u0,
        "gamma": [row | {name: row[name] / _persson(row) for name in ("value", "low", "high")} for row in u0],
        "area": _values(at_x, "area_ratio"),
        "gap": _values(at_x, "gap_ratio"),
    }
    rows = []
    for entry in sorted(entries, key=lambda entry: entry["year"]):
        for quantity in entry["ours"] or ["none"]:
            common = entry | {"quantity": quantity}
            rows += [common | _theirs(entry, row) | row for row in ours.get(quantity) or [NONE]]
    return pd.DataFrame(rows)[list(COLUMNS)]


def _values(table, name):
    """Return the values and intervals of one column as dicts with the keys `OURS`, sorted by ascending H.

    table : table with the columns `name` (values), `name`_low and `name`_high (intervals)
    """
    table = table.rename(columns={name: "value", f"{name}_low": "low", f"{name}_high": "high"})
    return table.reindex(columns=OURS).sort_values("hurst").to_dict("records")


def cited(source, year):
    """Return a citation in running text: the authors (`source`) and the year.

    If there are more than three authors, only the first is named, followed by "et al.".
    """
    names = source.replace(" and ", ", ").split(", ")
    return f"{source if len(names) < 4 else names[0] + ' et al.'} {year}"


def persson_u0(hurst, band):
    """Return u₀/h of Persson's law p ∝ exp(−u/u₀) at small pressures p, where u is the mean separation.

    Later work multiplied this law by a fitted factor γ, which is not included. The surface has the spectrum
    C ∝ q^(−2−2H) at wave numbers q from q₀ to ζq₀. The theory gives the elastic energy U = (π/2)E* ∫ q² C P dq per unit
    area, where P = erf(w p/E*), and w(q) = (π ∫ q³ C dq)^(−1/2) is integrated from q₀ to q. With p du = −dU, the result
    at small pressures is

        u₀ = √π ∫ q² C w dq = h √(H/π) ∫₁^ζ x^(−2H) [(x^(2−2H) − 1)/(2 − 2H)]^(−1/2) dx / √(1 − ζ^(−2H)).

    hurst : H in (0, 1]; band : ζ, the ratio of the longest to the shortest wavelength, above 1
    Source: B. N. J. Persson, Phys. Rev. Lett. 99, 125502 (2007).
    """
    from scipy.integrate import quad  # this import takes long

    def integrand(s):  # with x = exp(s²) the integrand is regular at x = 1, and defined for H = 1
        return 2 * np.exp((1 - 2 * hurst) * s**2) / np.sqrt(exprel((2 - 2 * hurst) * s**2))

    integral, _ = quad(integrand, 0, np.sqrt(np.log(band)))
    return np.sqrt(hurst / np.pi) * integral / np.sqrt(-np.expm1(-2 * hurst * np.log(band)))


def _theirs(entry, row):
    """Return {"theirs_low", "theirs_high"}: the range that a publication states, or that its law gives.

    entry : the publication in stiffness.yaml
    row : a value of this study; a law is evaluated at the Hurst exponent and for the grid of this value
    """
    theirs = entry.get("theirs") or entry.get("factor") or {"low": 1.0, "high": 1.0}
    laws = {"exponent_alpha": reference.exponent_alpha(row["hurst"]), "persson_u0": _persson(row)}
    scale = laws.get(entry.get("law"), 1.0 if "theirs" in entry else np.nan)
    return {"theirs_low": scale * theirs["low"], "theirs_high": scale * theirs["high"]}


def _persson(row):
    """Return u₀/h of Persson's law without the factor γ, for all wavelengths that the grid of `row` resolves.

    These wavelengths extend from the diameter of the disc to the width of two elements. The result is nan if `row`
    names no grid.
    """
    return persson_u0(row["hurst"], row["across"] / 2) if np.isfinite(row["across"]) else np.nan
