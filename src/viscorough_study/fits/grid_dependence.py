"""Whether the grid enters Eq. 1: κ at given u/h, and vt/h and u/h at given X, on grids from coarse to fine.

The paper takes F/(ηLv) = κ as a function of u/h and H alone, with an influence of the discretization in region (a)
only. The grid can enter at two ends of a curve: at the lower end, one element touches up to X ∝ N^−(1+H) for N elements
across, which leaves a term ∝ N^−H in u/h; at the upper end, complete contact recedes as the rms slope grows. Where u/h
at given X changes with the grid and vt/h at the same X does not, it is the lower end.
"""

import numpy as np
import pandas as pd
from scipy.special import stdtrit

from viscorough_study.ensembles.pool import elements_across, ensembles, select
from viscorough_study.fits.intervals import UNDEFINED, described, line_slope, three_columns

DEPTHS = (0.5, 1.0, 2.0)  # u/h at which κ is compared
FORCES = (0.01, 0.1, 1.0)  # X at which vt/h and u/h are compared
ROUNDING = 1e-12  # least scatter of a logarithm, so that equal discs have a finite weight
COLUMNS = {
    "hurst": ("Hurst exponent", "1"),
    "quantity": ("κ, vt/h or u/h, and where", ""),
    "across": ("elements across the discs", "1"),
    "realizations": ("discs", "1"),
    "touching": ("median of the elements in contact", "1"),
    **described("value", "geometric mean over the discs"),
    "compared": ("1 if enough elements touch for the grid to count in the trend, else 0", "1"),
    **described("factor", "by which a tenfold number of elements changes the quantity, over the grids compared"),
}


def grid_dependence(discs, *, elements_min, rms_convention):
    """A row for every Hurst exponent, quantity and grid; a pandas.DataFrame with the columns of `COLUMNS`.

    discs : pool of grids from coarse to fine; elements_min : in contact, from which on a grid is compared
    The logarithm of a quantity scatters over the discs of all grids alike: its variance is pooled over the grids
    compared, since a few discs do not tell it, and intervals are those of Student's t with the pooled degrees of
    freedom.
    """
    grids = {}
    pool = ensembles(select(discs, group="sizes"), "hurst", "elements", rms_convention=rms_convention)
    for (hurst, elements), ensemble in pool.items():
        for quantity, (values, touching) in _quantities(ensemble).items():
            grids.setdefault((hurst, quantity), []).append((elements, np.log(values), np.median(touching)))
    rows = []
    for (hurst, quantity), members in grids.items():
        members.sort(key=lambda grid: grid[0])
        trend = _trend([grid for grid in members if grid[2] >= elements_min])
        for elements, logarithms, touching in members:
            values = np.exp(_mean(logarithms, trend["scatter"], trend["freedom"]))
            row = {"hurst": hurst, "quantity": quantity, "across": elements_across(elements), "touching": touching}
            row |= {"realizations": logarithms.size, "compared": int(touching >= elements_min)}
            rows.append(row | three_columns("value", values) | three_columns("factor", trend["factor"]))
    return pd.DataFrame(rows, columns=list(COLUMNS))


def _quantities(ensemble):
    """{quantity: (its value, elements in contact) for every disc}; u/h = ∫dX/κ, with κ constant below the first X."""
    x, stiffness = ensemble["x"].values, ensemble["stiffness"].values
    steps = (1 / stiffness[:, 1:] + 1 / stiffness[:, :-1]) / 2 * np.diff(x)
    depth = np.cumsum(np.column_stack([x[0] / stiffness[:, 0], steps]), axis=1)
    curves = [np.broadcast_to(x, depth.shape), depth, stiffness, ensemble["contact_count"].values]
    curves = np.log(np.stack(curves, axis=1))
    found = {}
    for given in DEPTHS:
        at = np.exp([_at(curve[1], curve, given) for curve in curves])
        found[f"κ at u/h = {given:g}"] = at[:, 2], at[:, 3]
    for given in FORCES:
        at = np.exp([_at(curve[0], curve, given) for curve in curves])
        found[f"vt/h at X = {given:g}"] = given / at[:, 2], at[:, 3]
        found[f"u/h at X = {given:g}"] = at[:, 1], at[:, 3]
    return found


def _at(abscissa, curve, given):
    """Logarithms of X, u/h, κ and the elements in contact where the abscissa is log(given); nan beyond the curve."""
    return [np.interp(np.log(given), abscissa, ordinate, left=np.nan, right=np.nan) for ordinate in curve]


def _trend(members):
    """Factor for ten times as many elements, with its interval; pooled scatter of a disc, and its degrees of freedom.

    members : (elements, logarithms, ...) of each grid
    A line is fitted to the means, weighted by the number of discs; its interval is widened where the means scatter
    about it more than the discs explain. The factor is nan for fewer than three grids.
    """
    freedom = sum(logarithms.size - 1 for _, logarithms, _ in members)
    scatter = np.sqrt(sum(logarithms.var() * logarithms.size for _, logarithms, _ in members) / max(freedom, 1))
    scatter, factor = max(scatter, ROUNDING), UNDEFINED
    if len(members) > 2:
        x = np.log10([elements for elements, _, _ in members])
        means = np.array([logarithms.mean() for _, logarithms, _ in members])
        slope, error = line_slope(x, means, scatter / np.sqrt([logarithms.size for _, logarithms, _ in members]))
        half = stdtrit(freedom, 0.975) * error
        factor = tuple(np.exp(slope + np.array([0.0, -half, half])))
    return {"factor": factor, "scatter": scatter, "freedom": freedom}


def _mean(logarithms, scatter, freedom):
    """Mean and its 95 % interval by the pooled scatter."""
    half = stdtrit(freedom, 0.975) * scatter / np.sqrt(logarithms.size) if freedom else np.nan
    return logarithms.mean() + np.array([0.0, -half, half])
