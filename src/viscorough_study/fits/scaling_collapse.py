"""Test by a collapse of curves whether one scaling law holds on all grids, and find its exponents, without a fit.

X = F/(4GhL) is the reduced force. With N elements across, contact of a single element gives vt/h ∝ XN for every
surface. The law vt/h ∝ X^(H/(1+H)) can begin at this contact on every grid only if (vt/h) N^H is a single function of
X N^(1+H) below the crossover to the punch. The same holds for any exponent β, with H' = β/(1 − β) instead of H. The
exponents with which the curves of all grids collapse form an interval.

The collapse is tested by the spread of the curves of all grids around their common curve. This spread is compared with
the spread expected if all grids had this common curve. The expected spread is computed from bootstrap samples: the mean
of each sample of a grid is shifted so that the mean of the grid lies on the common curve (a bootstrap test with the
null hypothesis imposed). The weight of a grid is its number of realizations, since weights from the scatter of few
realizations would be too uncertain.

Two quantities are tested: vt/h itself, and the contribution of the interface, vt/h − X/κ_c, where κ_c is the stiffness
of the punch in series. In both quantities, h is the rms height of all waves of the spectrum, the limit for N → ∞. The
paper's h contains only the waves of the grid. At small H, waves that no grid contains have a large part of the rms
height.
"""

from dataclasses import dataclass
from itertools import product

import numpy as np
import pandas as pd
from scipy.interpolate import make_interp_spline
from scipy.special import zeta

from viscorough.reference import exponent_beta
from viscorough_study.ensembles.flat_punch import ensembles_on_grids
from viscorough_study.ensembles.pool import select
from viscorough_study.fits.power_law import ROUNDING, log_means

QUANTITIES = {"whole": "vt/h", "interface": "vt/h less X/κ_c of the punch"}
FINDINGS = ("collapses", "does not collapse", "undecided")
STEP = 0.01  # difference between successive trial exponents β
# The mean square height of a disc is a sum over waves up to this wave number (waves per diameter). For larger wave
# numbers, an integral replaces the sum.
LATTICE = 256
TRIED = 0.15  # largest difference between trial exponents β and H/(1 + H)
THINNED = 2  # the test uses only every second abscissa
FEWEST = {"abscissae": 5, "realizations": 3}  # a grid with fewer abscissae or realizations is not used
COLUMNS = {
    "source": ("discs by boundary elements, lines by the MDR, controls: discs whose spectrum has a roll-off", ""),
    "hurst": ("Hurst exponent", "1"),
    "quantity": ("; ".join(f"{name}: {text}" for name, text in QUANTITIES.items()), ""),
    "x_high": ("X up to which curves are compared, from elements_min elements in contact on", "1"),
    "expected": ("H/(1 + H), Eq. 10", "1"),
    "p_value": ("share of independent realizations of one curve with a larger spread around their common curve", "1"),
    "beta_low": ("lowest exponent with which the curves collapse at the 5 % level; empty if there is none", "1"),
    "beta_high": ("highest exponent with which the curves collapse at the 5 % level", "1"),
    "finding": ("one of: " + "; ".join(FINDINGS), ""),
}

CURVES = {
    "hurst": ("Hurst exponent", "1"),
    "number": ("elements across discs", "1"),
    "quantity": COLUMNS["quantity"],
    "x": ("X = F/(4GhL), with h over all waves of the spectrum; of H = 0 over those of the grid", "1"),
    "velocity": ("the quantity at X, mean over the realizations", "1"),
}


@dataclass(frozen=True)
class Grid:
    """Mean curves of the ensemble on one grid, at the abscissae X with enough elements in contact.

    number : N, the elements across discs, or the points of lines
    realizations : number of realizations in the ensemble
    log_x : ln X, equally spaced
    log_velocity : ln of the mean vt/h, shape (resamples + 1, abscissae); the first row belongs to the ensemble, the
        other rows to its bootstrap resamples
    count : median number of elements in contact at each abscissa
    punch : κ_c, the stiffness κ of a flat disc on this grid; 1 for lines
    share : mean square height of the waves of the grid, divided by the mean square height of all waves; see
        `variance_share`
    """

    number: int
    realizations: int
    log_x: np.ndarray
    log_velocity: np.ndarray
    count: np.ndarray
    punch: float
    share: float

    def curve(self, quantity, x_high, elements_min=0):
        """Return (ln X, ln of a quantity) along the mean curves up to X = x_high, or None for too few abscissae.

        The first row of the second array belongs to the ensemble, the other rows belong to its resamples. The rms
        height h in X and in the quantity contains all waves of the spectrum.

        quantity : key of `QUANTITIES`
        elements_min : the curve starts at the first abscissa with at least this median number of elements in contact

        For n realizations, the variance of the mean is n/(n − 1) times the variance of the bootstrap means. Therefore
        the deviations of the resamples from the ensemble are multiplied by √(n/(n − 1)).
        """
        log_x, values = self.log_x, self.log_velocity
        if quantity == "interface":
            values = np.exp(values) - np.exp(log_x) / self.punch
            values = np.log(np.where(values > 0, values, np.nan))
        shift = np.log(self.share) / 2
        kept = (log_x <= np.log(x_high) + ROUNDING) & np.isfinite(values).all(axis=0)
        kept &= np.logical_or.accumulate(self.count >= elements_min)
        if kept.sum() < FEWEST["abscissae"]:
            return None
        values = values[:, kept] + shift
        values[1:] = values[0] + (values[1:] - values[0]) * np.sqrt(self.realizations / (self.realizations - 1))
        return log_x[kept] + shift, values


def curve_table(grids_by_hurst, x_high):
    """Return the mean curves of all grids up to X = x_high as a table with the columns of `CURVES`.

    grids_by_hurst : {H: list of Grid}, from `grids`
    """
    parts = [pd.DataFrame(columns=list(CURVES))]
    for hurst, hurst_grids in grids_by_hurst.items():
        for grid, quantity in product(hurst_grids, QUANTITIES):
            if curve := grid.curve(quantity, x_high):
                values = {"x": np.exp(curve[0]), "velocity": np.exp(curve[1][0])}
                parts.append(pd.DataFrame({"hurst": hurst, "number": grid.number, "quantity": quantity, **values}))
    return pd.concat(parts[1:] or parts, ignore_index=True)


def variance_share(hurst, number, source):
    """Return the mean square height of the waves of a grid, divided by the mean square height of all waves.

    The waves of a disc have wave vectors k with 1 <= |k| <= N/2 in the plane and the weight |k|^(−2−2H). The waves of a
    line have 1 <= k <= N/2 and the weight k^(−1−2H). The function returns 1 for H = 0, where the sum over all waves
    diverges, and for controls, whose spectrum is not self-affine.

    number : N, the elements across a disc or the points of a line
    source : "discs", "controls" (discs whose spectrum has a roll-off) or "lines"
    """
    if hurst == 0 or source == "controls":
        return 1.0
    if source == "lines":
        return 1 - zeta(1 + 2 * hurst, number // 2 + 1) / zeta(1 + 2 * hurst)
    square = np.arange(-LATTICE, LATTICE + 1)[:, None] ** 2 + np.arange(-LATTICE, LATTICE + 1) ** 2
    square = square[(square > 0) & (square <= LATTICE**2)]
    weight = square ** (-1.0 - hurst)
    end = np.array([number / 2, np.inf])
    beyond = np.pi / hurst * (LATTICE ** (-2 * hurst) - np.maximum(end, LATTICE) ** (-2 * hurst))
    grid_sum, total = np.array([weight[square <= end[0] ** 2].sum(), weight.sum()]) + beyond
    return grid_sum / total


def grids(pool, source, *, conventions, elements_min, fraction_min, resamples, seed):
    """Average the realizations of a pool on every grid: return {H: list of Grid, from coarse to fine}.

    Grids with fewer than three realizations are omitted.

    pool : dataset of realizations (viscorough_study.ensembles.pool)
    source : "discs", "controls" (discs whose spectrum has a roll-off) or "lines"
    conventions : {"average": kind of mean, "rms_convention": definition of the rms height}
    elements_min : abscissae begin where the median number of elements in contact first reaches this number
    fraction_min : smallest fraction of the realizations that must reach an abscissa
    resamples, seed : number of resamples and seed of the bootstrap
    """
    group, grids_by_hurst = "controls" if source == "controls" else "sizes", {}
    generator = np.random.default_rng(seed)
    on_grids = ensembles_on_grids(select(pool, group=group), source, conventions["rms_convention"])
    for hurst, number, punch, ensemble in sorted(on_grids, key=lambda grid: grid[:2]):
        enough = np.logical_or.accumulate(ensemble["contact_count_median"].values >= elements_min)
        if ensemble.sizes["realization"] < FEWEST["realizations"] or not enough.any():
            continue
        kept = enough & (ensemble["fraction_defined"].values >= fraction_min)
        velocity = ensemble["velocity"].values[:, kept]
        means = log_means(velocity, conventions["average"], resamples, generator)
        share = variance_share(hurst, number, source)
        x, count = (ensemble[name].values[kept] for name in ("x", "contact_count_median"))
        grids_by_hurst.setdefault(hurst, []).append(Grid(number, len(velocity), np.log(x), means, count, punch, share))
    return grids_by_hurst


def collapse_table(grids_by_source, *, x_high, tolerance):
    """Test whether the curves of all grids collapse; return a pandas.DataFrame with the columns of `COLUMNS`.

    The table has a row for every combination of source, Hurst exponent, quantity and upper end of the range of X.

    grids_by_source : {"discs", "controls" or "lines": {H: list of Grid}}, from `grids`
    x_high : list of the upper ends of the range of X
    tolerance : tolerance of β
    """
    rows = []
    for source, grids_by_hurst in grids_by_source.items():
        for (hurst, hurst_grids), quantity, end in product(grids_by_hurst.items(), QUANTITIES, x_high):
            labels = {"source": source, "hurst": hurst, "quantity": quantity, "x_high": end}
            rows.append(labels | collapse(hurst_grids, hurst, quantity, end, tolerance=tolerance))
    return pd.DataFrame(rows, columns=list(COLUMNS))


def collapse(hurst_grids, hurst, quantity, x_high, *, tolerance):
    """Test whether the curves of one quantity on all grids collapse up to X = x_high; return {column: value}.

    hurst_grids : list of Grid with the Hurst exponent `hurst`
    quantity : key of `QUANTITIES`
    tolerance : tolerance of β
    """
    curves = [(grid, grid.curve(quantity, x_high)) for grid in hurst_grids]
    curves = [(grid, tuple(values[..., ::THINNED] for values in curve)) for grid, curve in curves if curve is not None]
    expected = exponent_beta(hurst)
    row = {"expected": expected, "finding": FINDINGS[2]}
    if len(curves) < 2:
        return row
    tried = expected + np.arange(-TRIED, TRIED + STEP / 2, STEP)
    accepted = [beta for beta in tried if 0 <= beta < 0.9 and p_value(curves, beta) >= 0.05]
    low, high = min(accepted, default=np.nan), max(accepted, default=np.nan)
    row |= {"p_value": p_value(curves, expected), "beta_low": low, "beta_high": high}
    if row["p_value"] < 0.05:
        row["finding"] = FINDINGS[1]
    elif low >= expected - tolerance and high <= expected + tolerance:
        row["finding"] = FINDINGS[0]
    return row


def p_value(curves, beta):
    """Return the p-value of the collapse: if it is small, the curves of the grids do not lie on a common curve.

    The p-value is the fraction of bootstrap samples that spread at least as much as the curves. The samples are shifted
    so that all grids have the same mean curve (see the module).

    curves : list of (Grid, its curve); a curve is (ln X, ln of the quantity), as `Grid.curve` returns it
    beta : exponent with which the curves are collapsed
    Returns nan if the collapsed curves have no abscissa in common.
    """
    power = beta / (1 - beta)  # H' in the module's docstring
    scaled = [log_x + (1 + power) * np.log(grid.number) for grid, (log_x, _) in curves]
    step = scaled[0][1] - scaled[0][0]
    common_x = np.arange(min(x[0] for x in scaled), max(x[-1] for x in scaled), step)
    moved, weights = [], []
    for x, (grid, (_, log_y)) in zip(scaled, curves, strict=True):
        values = make_interp_spline(x, log_y, k=1, axis=1)(common_x) + power * np.log(grid.number)
        # Subtract the curve of the ensemble from its resamples. Then the resamples of all grids scatter about 0.
        values[1:] -= values[0]
        moved.append(values)
        inside = (common_x >= x[0] - ROUNDING * step) & (common_x < x[-1] - ROUNDING * step)
        weights.append(grid.realizations * inside)
    moved, weights = np.array(moved), np.array(weights)[:, None]
    shared = np.count_nonzero(weights, axis=0)[0] > 1
    if not shared.any():
        return np.nan
    moved, weights = moved[..., shared], weights[..., shared]
    common = np.sum(weights * moved, axis=0) / weights.sum(axis=0)
    spreads = np.sqrt(np.sum(weights * (moved - common) ** 2, axis=(0, 2)) / weights.sum())
    return np.mean(spreads[1:] >= spreads[0])
