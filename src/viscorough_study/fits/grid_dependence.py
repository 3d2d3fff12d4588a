"""Test the effect of the grid on Eq. 1: compare κ at given u/h, and vt/h and u/h at given X, on several grids.

X = F/(4GhL) is the reduced force. According to Eq. 1, F/(ηLv) = κ is a function of u/h and H alone. The paper expects
an influence of the grid in region (a) only. The grid can act at two ends of a curve:

- At the lower end, a single element touches up to X ∝ N^−(1+H) for N elements across. This leaves a term ∝ N^−H in u/h.
- At the upper end, finer grids have a larger rms slope, so complete contact begins at larger X.

If u/h at given X changes with the grid, but vt/h at the same X does not, then the lower end is the cause.
"""

import numpy as np
import pandas as pd
from scipy.integrate import cumulative_trapezoid
from scipy.special import stdtrit

from viscorough_study.ensembles.pool import elements_across, ensembles, select
from viscorough_study.fits.intervals import UNDEFINED, described, three_columns

DEPTHS = (0.5, 1.0, 2.0)  # values of u/h at which κ is compared
FORCES = (0.01, 0.1, 1.0)  # values of the reduced force X at which vt/h and u/h are compared
# Lower bound of the standard deviation of ln κ, ln(vt/h) or ln(u/h) among discs on the same grid. If all discs are
# equal, the standard deviation is 0, and without this bound their mean would have an infinite weight in the fit.
ROUNDING = 1e-12
COLUMNS = {
    "hurst": ("Hurst exponent", "1"),
    "quantity": ("κ, vt/h or u/h, and where", ""),
    "across": ("elements across the discs", "1"),
    "realizations": ("discs", "1"),
    "touching": ("median of the elements in contact", "1"),
    "value": ("geometric mean over the discs", "1"),
    "compared": ("1 if enough elements touch for the grid to count in the trend, else 0", "1"),
    **described("factor", "by which a tenfold number of elements changes the quantity, over the grids compared"),
}


def grid_dependence(discs, *, elements_min, rms_convention):
    """Compare the grids: return a pandas.DataFrame with a row for every Hurst exponent, quantity and grid.

    Its columns are `COLUMNS`.

    discs : pool (viscorough_study.ensembles.pool) of discs on grids from coarse to fine
    elements_min : a grid is used for the trend if the median number of elements in contact is at least this number
    rms_convention : name of the definition of the rms height h
    """
    rows = []
    pool = ensembles(select(discs, group="sizes"), "hurst", "elements", rms_convention=rms_convention)
    for (hurst, elements), ensemble in sorted(pool.items()):
        labels = {"hurst": hurst, "elements": elements, "across": elements_across(elements)}
        for quantity, (values, touching) in _quantities(ensemble).items():
            row = {"quantity": quantity, "realizations": values.size, "touching": np.median(touching)}
            row |= {"value": np.exp(np.log(values).mean()), "variance": np.log(values).var()}
            rows.append(labels | row)
    table = pd.DataFrame(rows)
    table["compared"] = (table["touching"] >= elements_min).astype(int)
    groups = [
        grids.assign(**three_columns("factor", _factor(grids[grids["compared"] == 1])))
        for _, grids in table.groupby(["hurst", "quantity"], sort=False)
    ]
    return pd.concat(groups)[list(COLUMNS)]


def _quantities(ensemble):
    """Return {quantity: (values, numbers of elements in contact)}, two arrays with one entry for every disc.

    The depth is u/h = ∫dX/κ. Below the first abscissa, κ is assumed to be constant.
    """
    x, stiffness = ensemble["x"].values, ensemble["stiffness"].values
    depth = x[0] / stiffness[:, :1] + cumulative_trapezoid(1 / stiffness, x, axis=1, initial=0)
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
    """Interpolate four logarithms along the curve of a disc to the point at which X or u/h has the value `given`.

    abscissa : ln X or ln(u/h) along the curve
    curve : ln X, ln(u/h), ln κ and ln(elements in contact) along the curve, shape (4, abscissae)
    All four results are nan if the curve does not reach this point.
    """
    return [np.interp(np.log(given), abscissa, ordinate, left=np.nan, right=np.nan) for ordinate in curve]


def _factor(grids):
    """Return the factor by which ten times as many elements change a quantity, with its interval: (value, low, high).

    grids : rows of one quantity, one for each grid; the result is nan for fewer than three grids

    For each grid, the mean of ln(quantity) over the discs is computed. A straight line is fitted to these means as a
    function of the logarithm of the number of elements. The weight of a mean is its number of discs. The interval of
    the slope is widened if the means scatter about the line more than expected from the scatter between discs.

    The scatter of ln(quantity) between discs is the same on all grids. The variance is therefore pooled over all grids,
    since the few discs of a single grid do not determine it. The interval follows Student's t with the pooled degrees
    of freedom.
    """
    if len(grids) < 3:
        return UNDEFINED
    number, logarithms = grids["realizations"].to_numpy(), np.log(grids["value"])
    freedom = np.sum(number - 1)
    scatter = max(np.sqrt(np.sum(grids["variance"] * number) / max(freedom, 1)), ROUNDING)
    x, errors = np.log10(grids["elements"]), scatter / np.sqrt(number)
    line, covariance = np.polyfit(x, logarithms, 1, w=1 / errors, cov="unscaled")
    excess = np.sum(((logarithms - np.polyval(line, x)) / errors) ** 2) / (len(grids) - 2)
    half = stdtrit(freedom, 0.975) * np.sqrt(covariance[0, 0] * max(excess, 1.0))
    return np.exp(line[0] + np.array([0.0, -half, half]))
