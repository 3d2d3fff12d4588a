"""Select and convert fits by the conventions that the paper leaves open.

The paper does not state the region in which the rms height h is measured, the average over realizations, or the windows
of its fits. These three conventions (`FITTED`) change the mean curve or the window, so each combination needs a fit.

The paper also prints some laws with a factor 1/Γ(2 − α) and others without. A reading of the law is its form with or
without this factor (`GAMMA`); the plain reading is the form without. The reading only rescales a fit. The plain reading
is vt/h = X^β/ζ; with the factor (Eq. 9) it is vt/h = X^β/(ζ Γ(1 + β)), where 1 + β = 2 − α. So ζ with the factor is
1/Γ(1 + β) times ζ without.

β, λ, the residual and the window are equal in both readings, and ζ with the factor follows from ζ without. The tables
of fits therefore contain these values once, in the plain reading. The 95 % interval of ζ does not follow from its value
in the plain reading: its ends are percentiles of bootstrap samples, each scaled with the β of this sample. The tables
contain this interval in both readings, in the columns that `interval_columns` names.
"""

import numpy as np
from scipy.special import gamma as gamma_function

FITTED = {
    "rms_convention": ("disc", "square", "ensemble"),  # fits of lines have the value "line"
    "average": ("arithmetic", "geometric"),
    "window_rule": ("default", "lower_half", "upper_half", "kappa"),
}
GAMMA = ("without", "with")
VALUES = FITTED | {"gamma": GAMMA}  # {convention: its allowed values}


def zeta_scale(beta, gamma):
    """Return the ratio of ζ in a reading of the law to ζ in the plain reading, with the shape of β.

    gamma : the reading, an entry of `GAMMA`
    """
    return 1 / gamma_function(1 + beta) if gamma == "with" else np.ones_like(beta)


def interval_columns(gamma):
    """Return the names of the columns with the lower and the upper end of the interval of ζ in a reading of the law.

    gamma : the reading, an entry of `GAMMA`
    """
    reading = "_with_gamma" * (gamma == "with")
    return f"zeta_low{reading}", f"zeta_high{reading}"


def in_reading(fits, gamma):
    """Convert ζ and its interval to one reading of the law, for all rows of a table of fits.

    fits : pandas.DataFrame with the columns of viscorough_study.fits.fit_table
    gamma : the reading, an entry of `GAMMA`
    Returns a DataFrame with zeta, zeta_low and zeta_high in this reading, and a column `gamma` that names the reading.
    The columns of the interval with the factor are dropped.
    """
    low, high = interval_columns(gamma)
    zeta = fits["zeta"] * zeta_scale(fits["beta"], gamma)
    converted = fits.assign(zeta=zeta, zeta_low=fits[low], zeta_high=fits[high], gamma=gamma)
    return converted.drop(columns=list(interval_columns("with")))


def as_text(conventions):
    """Return conventions as text, such as "rms_convention disc, average geometric"."""
    return ", ".join(f"{name} {value}" for name, value in conventions.items())


def select(table, values):
    """Return the rows of a table of fits that have given values, converted to one reading of the law, by ascending H.

    values : {column: value that a row must have}, and under "gamma" the reading, an entry of `GAMMA`
    """
    for column, value in values.items():
        if column != "gamma":
            table = table[table[column] == value]
    return in_reading(table, values["gamma"]).sort_values("hurst", kind="stable")


def fits(table, conventions, **values):
    """Return the rows of a table of fits that were made with given conventions, by ascending H.

    conventions : {convention: value}, with the reading of the law as "gamma"
    values : {column or convention: value} that rows must also have; they replace conventions of the same name
    Fits of ensembles without a region (b) have no exponent, and their rows are omitted.
    """
    return select(table, conventions | values).dropna(subset="beta")


def source_values(source):
    """Return {column: value} that selects the fits of "discs" or "lines"; lines have a single rms convention."""
    return {"source": source} | ({"rms_convention": "line"} if source == "lines" else {})
