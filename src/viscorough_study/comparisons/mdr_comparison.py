"""Compare the method of dimensionality reduction (MDR) with boundary elements, surface by surface.

The MDR represents a surface by a line of springs with the spectrum C1D = π q C2D (Eq. 13). Here C2D is the spectrum of
the same realization of the surface, averaged over all wave vectors of equal length q. The method does not specify the
phases of the waves of a line, so they are independent and random.

The literature finds that the method fails for contact area and separation (Lyashenko, Pastewka & Persson, Tribology
Letters 52, 223 (2013)). The contact fraction of a line equals its κ on every grid. The contact fraction of a disc falls
as the grid resolves finer waves. The ratio of the two contact fractions therefore depends on the grid. The mean gap of
a disc requires the deflections of the half-space, which are computed only if X is an integer power of ten.
"""

import numpy as np
import pandas as pd

from viscorough.contact.loading_path import indent
from viscorough.contact.one_contact import contact_at
from viscorough.mdr import line_of_surface, reduce
from viscorough.surfaces.indenter import Indenter
from viscorough.surfaces.self_affine import cut_disc, self_affine_square
from viscorough_study.ensembles.averages import abscissa
from viscorough_study.fits.intervals import described, mean_with_interval, three_columns
from viscorough_study.run.seeds import mdr_comparison_key, realization_seed

COLUMNS = {
    "hurst": ("Hurst exponent H", "1"),
    "x": ("dimensionless force F/(4GhL) or time Ft/(4ηhL)", "1"),
    **described("stiffness_ratio", "geometric mean of κ of the lines over that of the discs"),
    "stiffness_scatter": ("standard deviation of ln κ of a line over its disc", "1"),
    **described("area_ratio", "geometric mean of the contact fraction of the lines over that of the discs"),
    "force_ratio": (
        "geometric mean of X of a line over that of its disc, at equal u/h, where the disc has this X",
        "1",
    ),
    **described("gap_ratio", "geometric mean of the mean gap of the lines over that of the discs, at powers of ten"),
    "correlation": ("correlation of ln κ of discs and their lines over the realizations", "1"),
    "chance": ("bound within which 95 % of the correlations of as many unrelated pairs lie, ±", "1"),
    "realizations": ("realizations", "1"),
}
FORCE_MARGIN = 1.01  # the loading curve of a disc ends at this multiple of the largest force of the comparison


def compare_reduction(*, hursts, elements, realizations, tolerance, seed, **abscissae):
    """Compare MDR lines with discs of the same spectrum; return a pandas.DataFrame with the columns of `COLUMNS`.

    Each disc has diameter and rms height 1, and is cut from a periodic square whose side is one period.

    hursts : Hurst exponents; realizations : number of discs for each Hurst exponent
    elements : number of elements across a disc
    tolerance : tolerance of the loading curves of the discs; seed : root of the surfaces' seeds
    abscissae : x_low, x_high and per_decade; range and number per decade of the values of X = F/(4GhL)
    The table omits an X if any loading curve of the same Hurst exponent ends at a smaller X.
    """
    x, tables = abscissa(abscissae["x_low"], abscissae["x_high"], abscissae["per_decade"]), []
    force = 4 * x  # F/G = 4hLX, with h = L = 1
    force_with_gap = np.where(is_power_of_ten(x), force, np.nan)
    for hurst in hursts:
        compared = []
        for number in range(realizations):
            surface_seed, line_seed = realization_seed(seed, *mdr_comparison_key(hurst, number)).spawn(2)
            square = self_affine_square(hurst, elements, seed=surface_seed)
            square /= np.nanstd(cut_disc(square, elements))
            disc = Indenter(cut_disc(square, elements), 1 / elements)
            line = line_of_surface(square, 1 / elements, line_seed)
            curves = indent(disc, tolerance=tolerance, until_force=FORCE_MARGIN * force[-1]), reduce(line)
            pairs = zip((disc, line), curves, strict=True)
            gaps = [np.log(mean_gaps(indenter, curve, force_with_gap, tolerance)) for indenter, curve in pairs]
            compared.append([*_compare(*curves, force), gaps[1] - gaps[0]])
        tables.append(_table(hurst, x, np.array(compared)))
    return pd.concat(tables, ignore_index=True)


def _compare(disc, line, force):
    """Compare a line with its disc; return the logarithms of four quantities, each of shape (forces,).

    The quantities are κ of the disc, κ of the line, the ratio of their contact fractions (line to disc), and the ratio
    of their forces (line to disc) at equal depths. The first three are taken at equal forces.
    disc, line : loading curves; force : F/G on the disc, shape (forces,)
    """
    (depth, stiffness), log_force = disc.at_force(force), np.log(force)
    fractions = [np.interp(log_force, np.log(curve.force), np.log(curve.contact_fraction)) for curve in (disc, line)]
    # Below the first point of the line's loading curve, the force is proportional to the depth.
    straight = np.minimum(np.log(depth / line.depth[0]), 0)
    line_force = straight + np.interp(np.log(depth), np.log(line.depth), np.log(line.force))
    logarithms = np.log([stiffness / 4, line.at_force(force)[1] / 4])
    return *logarithms, fractions[1] - fractions[0], line_force - log_force


def is_power_of_ten(x):
    """Return an array of the shape of x: True if an element of x is an integer power of ten within rounding."""
    exponent = np.log10(x)
    return np.abs(exponent - np.rint(exponent)) < 1e-9


def mean_gaps(indenter, curve, force, tolerance):
    """Return the gap between indenter and deformed surface, averaged over all elements; shape (forces,) [length].

    indenter : map or line; curve : its LoadingCurve; force : F/G, shape (forces,)
    tolerance : tolerance of the contact problems of a map
    The contact problems of a map are solved at the depths that the curve has at the given forces. The mean gap of a
    line is ⟨g⟩ − u + F/(4GL), where g is the gap before loading and u the depth: springs in contact deflect by u − g,
    and the mean deflection of all springs is F/(4GL). The gap is nan if the force is nan or beyond the end of the
    curve.
    """
    depth, _ = curve.at_force(force)
    if indenter.heights.ndim == 1:
        heights = indenter.heights
        return heights.max() - heights.mean() - depth + force / (4 * indenter.spacing * heights.size)
    gaps, reached = np.full(force.size, np.nan), np.isfinite(depth)
    if reached.any():
        contacts = contact_at(indenter, depth=depth[reached], tolerance=tolerance)
        gaps[reached] = [np.nanmean(contact.gap) for contact in contacts]
    return gaps


def _table(hurst, x, compared):
    """Return the table rows of one Hurst exponent, one row for each X.

    An X is omitted if any quantity except the mean gap is undefined.
    compared : for each disc the four results of `_compare`, and ln of the ratio of the mean gaps (line to disc); shape
        (realizations, 5, abscissae)
    """
    disc, line, fraction, force, gap = np.moveaxis(compared, 1, 0)
    number = len(compared)
    # The correlation is nan if all realizations have the same κ.
    with np.errstate(invalid="ignore", divide="ignore"):
        correlation = [np.corrcoef(pair)[0, 1] for pair in zip(disc.T, line.T, strict=True)]
    columns = {
        "hurst": hurst,
        "x": x,
        "stiffness_scatter": (line - disc).std(axis=0, ddof=1),
        "force_ratio": np.exp(force.mean(axis=0)),
        "correlation": correlation,
        # By Fisher's transform, 95 % of the correlations of independent pairs lie within ± this bound.
        "chance": np.tanh(1.96 / np.sqrt(number - 3)) if number > 3 else 1.0,
        "realizations": number,
    }
    for name, ratios in (("stiffness_ratio", line - disc), ("area_ratio", fraction), ("gap_ratio", gap)):
        columns |= three_columns(name, np.exp(mean_with_interval(ratios)))
    table = pd.DataFrame(columns)[list(COLUMNS)]
    return table[np.isfinite(table.loc[:, "stiffness_ratio":"force_ratio"]).all(axis=1)]
