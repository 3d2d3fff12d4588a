"""Select fits of the power law by choices that the paper leaves open (conventions), and convert ζ between two laws.

The paper does not state the region in which the rms height h is measured, the kind of average over realizations, or the
windows (ranges of X) of its fits. These three conventions (`FITTED`) change the mean curve or the window, so each
combination needs a fit.

The paper also prints some laws with a factor 1/Γ(2 − α) and others without this factor (`GAMMA`). Without the factor
the law is vt/h = X^β/ζ. With the factor (Eq. 9) the law is vt/h = X^β/(ζ Γ(1 + β)), where 1 + β = 2 − α. So ζ with the
factor is 1/Γ(1 + β) times ζ without the factor, and a single fit serves for both forms of the law.

β, λ, the residuals and the window are equal for both forms. The tables of fits therefore contain these values only
once, and ζ only without the factor. The 95 % interval of ζ is in the tables for both forms, in the columns that
`interval_columns` names. The ends of this interval are percentiles of bootstrap samples, and each sample is scaled with
the β of the sample. So the interval for one form does not follow from the interval for the other form.
"""

import numpy as np
from scipy.special import gamma as gamma_function

from viscorough import reference

# The two readings of the paper's surfaces, which the paper does not describe: {reading: columns of a table of fits}.
# A: the period of the square equals the diameter, and h is the rms height of the disc. B: the disc is cut from a square
# of twice its diameter, and h is the rms height of the square.
READINGS = {
    "A": {"group": "base", "rms_convention": "disc"},
    "B": {"group": "longer_period", "rms_convention": "square"},
}
# Group of the discs without long waves, whose curves follow no power law.
CONTROL = "roll_off"
FITTED = {
    "rms_convention": ("disc", "square", "ensemble"),  # for lines the value is "line"
    "average": ("arithmetic", "geometric"),
    "window_rule": ("default", "lower_half", "upper_half", "kappa"),
}
GAMMA = ("without", "with")


def zeta_scale(beta, gamma):
    """Return the factor that converts ζ of the law without 1/Γ(2 − α) to ζ of another form of the law.

    gamma : "with" for the law with 1/Γ(2 − α), "without" to leave ζ unchanged (factor 1)
    Returns an array of the shape of β.
    """
    return 1 / gamma_function(1 + beta) if gamma == "with" else np.ones_like(beta)


def interval_columns(gamma):
    """Return the names of the two columns with the lower and the upper end of the interval of ζ.

    gamma : "with" or "without", for ζ of the law with or without the factor 1/Γ(2 − α)
    """
    suffix = "_with_gamma" * (gamma == "with")
    return f"zeta_low{suffix}", f"zeta_high{suffix}"


def convert_zeta(fits, gamma):
    """Convert ζ and its interval to the law with or without the factor 1/Γ(2 − α), in all rows of a table of fits.

    fits : pandas.DataFrame with the columns of viscorough_study.fits.fit_table
    gamma : "with" or "without", for the law with or without the factor
    Returns a DataFrame with the converted columns zeta, zeta_low and zeta_high, the converted ζ at β = H/(1 + H) in the
    columns zeta_fixed, zeta_fixed_low and zeta_fixed_high, and a column `gamma`. The columns zeta_low_with_gamma and
    zeta_high_with_gamma are dropped.
    """
    low, high = interval_columns(gamma)
    zeta = fits["zeta"] * zeta_scale(fits["beta"], gamma)
    scale = zeta_scale(reference.exponent_beta(fits["hurst"]), gamma)
    fixed = {name: fits[name] * scale for name in ("zeta_fixed", "zeta_fixed_low", "zeta_fixed_high")}
    converted = fits.assign(zeta=zeta, zeta_low=fits[low], zeta_high=fits[high], gamma=gamma, **fixed)
    return converted.drop(columns=list(interval_columns("with")))


def reading_of(group, rms_convention):
    """Return the reading of the paper's surfaces to which a fit belongs, "" if to none. Lines belong to reading A."""
    own = {"group": group, "rms_convention": "disc" if rms_convention == "line" else rms_convention}
    return next((reading for reading, columns in READINGS.items() if columns == own), "")


def select(table, values):
    """Select rows from a table of fits, sort them by ascending H, and convert ζ by `convert_zeta`.

    values : {column: value that a row must have}, and {"gamma": argument of `convert_zeta`}
    """
    for column, value in values.items():
        if column != "gamma":
            table = table[table[column] == value]
    return convert_zeta(table, values["gamma"]).sort_values("hurst", kind="stable")


def fits(table, conventions, **values):
    """Return the rows of a table of fits that were made with the given conventions, sorted by ascending H.

    conventions : {convention: value}, such as {"average": "geometric"}. The value of "gamma" is "with" or "without",
        for ζ of the law with or without the factor 1/Γ(2 − α)
    values : {column or convention: value} that rows must also have; they replace conventions of the same name
    Fits of ensembles without a region (b) have no exponent, and their rows are omitted.
    """
    return select(table, conventions | values).dropna(subset="beta")


def source_values(source):
    """Return {column: value} by which `fits` selects the fits of discs, or the fits of lines.

    source : "discs" or "lines". In all fits of lines, rms_convention (where h is measured) is "line", so this value is
        required for lines.
    """
    return {"source": source} | ({"rms_convention": "line"} if source == "lines" else {})
