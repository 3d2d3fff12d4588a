"""Select and convert fits by the conventions that the paper leaves open.

The paper does not state the region in which the rms height h is measured, the average over realizations, or the windows
of its fits. It prints some laws with a factor 1/Γ(2 − α) and others without. The first three conventions (`FITTED`)
change the mean curve or the window: each combination needs a fit. The factor (`GAMMA`) only rescales a fit of vt/h =
X^β/ζ: in the law with the factor (Eq. 9), vt/h = X^β/(ζ Γ(1 + β)) with 1 + β = 2 − α, so ζ is 1/Γ(1 + β) times its
value without the factor.

β, λ, the residual and the window do not depend on the reading. ζ follows from its value in the plain reading, without
the factor. So the tables of fits contain them once. The 95 % interval of ζ does not follow from the plain reading: its
ends are percentiles of bootstrap samples, each scaled with its own β. It is stored for both readings, in the columns
that `interval_columns` names.
"""

import numpy as np
from scipy.special import gamma as gamma_function

FITTED = {
    "rms_convention": ("disc", "square", "ensemble"),  # lines have "line"
    "average": ("arithmetic", "geometric"),
    "window_rule": ("default", "lower_half", "upper_half", "kappa"),
}
GAMMA = ("without", "with")
VALUES = FITTED | {"gamma": GAMMA}  # convention: its allowed values


def zeta_scale(beta, gamma):
    """Return ζ in a reading of the law over ζ in the plain reading; of the shape of β. gamma : one of `GAMMA`"""
    return 1 / gamma_function(1 + beta) if gamma == "with" else np.ones_like(beta)


def interval_columns(gamma):
    """Return names of the columns with the lower and the upper end of the interval of ζ in a reading of the law."""
    reading = "_with_gamma" * (gamma == "with")
    return f"zeta_low{reading}", f"zeta_high{reading}"


def in_reading(fits, gamma):
    """Convert fits to one reading of the law: ζ and its interval.

    fits : pandas.DataFrame with the columns of viscorough_study.fits.fit_table
    Returns a DataFrame with a column for the reading, and without the interval of the other reading.
    """
    low, high = interval_columns(gamma)
    zeta = fits["zeta"] * zeta_scale(fits["beta"], gamma)
    converted = fits.assign(zeta=zeta, zeta_low=fits[low], zeta_high=fits[high], gamma=gamma)
    return converted.drop(columns=list(interval_columns("with")))


def as_text(conventions):
    """Return conventions as text, such as "rms_convention disc, average geometric"."""
    return ", ".join(f"{name} {value}" for name, value in conventions.items())


def select(table, values):
    """Return rows of a table of fits with these values of columns, converted to the requested reading of the law.

    values : {column or convention: value}, with the reading as gamma
    """
    for column, value in values.items():
        if column != "gamma":
            table = table[table[column] == value]
    return in_reading(table, values["gamma"]).sort_values("hurst", kind="stable")


def fits(table, conventions, **values):
    """Return rows of a table of fits in these conventions and with these values, by ascending H.

    conventions, values : {column or convention: value}; `values` replaces conventions of the same name
    Rows without a region (b), and so without an exponent, are omitted.
    """
    return select(table, conventions | values).dropna(subset="beta")


def source_values(source):
    """Return {column: value} that selects discs or lines; lines have a single rms convention."""
    return {"source": source} | ({"rms_convention": "line"} if source == "lines" else {})
