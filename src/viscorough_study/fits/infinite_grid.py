"""Fit the exponent of an infinitely fine grid: one power law with a correction, for all grids at once.

    vt/h = A X^β exp(B X^ω),    and the same law for the interface alone, vt/h − X/κ_c

X = F/(4GhL) is the reduced force, and κ_c is the reduced stiffness of the flat punch.

The theory of corrections to scaling has the factor 1 + B X^ω, which equals this exponential to first order. With the
exponential, ln(vt/h) is linear in ln A, β and B for a given ω, so all bootstrap resamples are fitted at once.

A fit depends on the realizations and on its range. The range starts at a number of elements in contact and ends at a
value of X. For every range, the 95 % interval of β over the realizations is computed. A further interval includes the
effect of the range: it extends from the lowest to the highest end of the intervals of all ranges.
"""

from itertools import product

import numpy as np
import pandas as pd

from viscorough.reference import exponent_beta
from viscorough_study.fits.intervals import described, equivalence, three_columns
from viscorough_study.fits.scaling_collapse import COLUMNS as COLLAPSE_COLUMNS
from viscorough_study.fits.scaling_collapse import QUANTITIES, collapse_table, curve_table, grids

OMEGA = np.round(np.arange(0.2, 1.51, 0.1), 1)  # trial values of the exponent ω of the correction
CURVES_END = 1.0  # largest X in the table `collapse_curves`
FINDINGS = {True: "agrees", False: "departs", None: "undecided"}
COLUMNS = {
    "source": ("discs by boundary elements, lines by the MDR", ""),
    **{name: COLLAPSE_COLUMNS[name] for name in ("hurst", "quantity")},
    "law": ("power: A X^β; corrected: A X^β exp(B X^ω)", ""),
    "elements_min": ("elements in contact at which the fit begins", "1"),
    "x_high": ("X at which the fit ends", "1"),
    "expected": ("H/(1 + H), Eq. 10", "1"),
    **described("beta", "exponent of an infinitely fine grid", ends="of its 95 % interval over realizations"),
    "ranges_low": ("lowest end of the intervals in all ranges", "1"),
    "ranges_high": ("highest end of the intervals in all ranges", "1"),
    "amplitude": ("A", "1"),
    "correction": ("B", "1"),
    **described("omega", "exponent ω of the correction"),
    "finding": (
        "agrees: the intervals in all ranges lie within the tolerance of H/(1 + H), departs: outside, else undecided; "
        "also undecided where ω is at an end of the range tried, so that the correction is not determined by the data",
        "",
    ),
}


def points(hurst_grids, quantity, *, elements_min, x_high):
    """Collect the points of the curves of all grids for one fit: return ln X, ln(quantity) and the weights.

    hurst_grids : list of fits.scaling_collapse.Grid
    quantity, elements_min, x_high : arguments of the method `curve` of each grid

    ln X and the weights have the shape (points,). ln(quantity) has the shape (1 + resamples, points): the first row
    belongs to the ensemble, the others to its bootstrap resamples. The weight of a point is the number of realizations
    on its grid. The result is None if fewer than two grids have a curve.
    """
    parts = [
        (*curve, np.full(curve[0].size, float(grid.realizations)))
        for grid in hurst_grids
        if (curve := grid.curve(quantity, x_high, elements_min))
    ]
    if len(parts) < 2:
        return None
    return tuple(np.concatenate(arrays, axis=-1) for arrays in zip(*parts, strict=True))


def fit(log_x, log_y, weights, *, corrected):
    """Fit the law y = A X^β exp(B X^ω) to every row of log_y; return (ln A, β, B, ω) of each row, shape (rows, 4).

    log_x, weights : ln X and weights of the points, shape (points,)
    log_y : ln y, shape (rows, points)
    corrected : False to fit the law without the correction exp(B X^ω); B and ω are then nan
    """
    root = np.sqrt(weights)
    target = (log_y * root).T
    best, explained = np.full((len(log_y), 4), np.nan), np.full(len(log_y), -np.inf)
    for omega in OMEGA if corrected else OMEGA[:1]:
        columns = [root, log_x * root] + ([np.exp(omega * log_x) * root] if corrected else [])
        basis, triangle = np.linalg.qr(np.stack(columns, axis=1))
        parts = basis.T @ target
        squares = np.sum(parts**2, axis=0)
        better = squares > explained
        best[better, : len(columns)] = np.linalg.solve(triangle, parts).T[better]
        best[better, 3] = omega if corrected else np.nan
        explained[better] = squares[better]
    return best


def limit_table(grids_by_source, *, elements_min, x_high, tolerance):
    """Fit the exponents of an infinitely fine grid; return a pandas.DataFrame with the columns of `COLUMNS`.

    grids_by_source : {"discs" or "lines": their grids, from fits.scaling_collapse.grids}
    elements_min : list of starts of the range of a fit, given as numbers of elements in contact
    x_high : {"power" or "corrected", the name of a law: list of ends of the range, given as X}
    tolerance : tolerance of β

    Each law is fitted from every start to every end. The table states the values of the fit from the first start to the
    first end. The fits in the other ranges only affect the columns ranges_low and ranges_high.
    """
    rows = []
    cases = [(source, *case) for source, by_hurst in grids_by_source.items() for case in by_hurst.items()]
    for (source, hurst, hurst_grids), quantity, law in product(cases, QUANTITIES, x_high):
        fits = []
        for start, end in product(elements_min, x_high[law]):
            if values := points(hurst_grids, quantity, elements_min=start, x_high=end):
                fitted = _columns(fit(*values, corrected=law == "corrected"))
                fits.append({"elements_min": start, "x_high": end} | fitted)
        if not fits:
            continue
        low, high = min(row["beta_low"] for row in fits), max(row["beta_high"] for row in fits)
        expected, undetermined = exponent_beta(hurst), fits[0]["omega"] in OMEGA[[0, -1]]
        agrees = None if undetermined else equivalence((low - expected, high - expected), -tolerance, tolerance)
        row = {"source": source, "hurst": hurst, "quantity": quantity, "law": law}
        row |= fits[0] | {"expected": expected, "ranges_low": low, "ranges_high": high}
        rows.append(row | {"finding": FINDINGS[agrees]})
    return pd.DataFrame(rows, columns=list(COLUMNS))


def _columns(coefficients):
    """Return {column: value} of one fit.

    coefficients : result of `fit`; the first row belongs to the ensemble, the other rows to its resamples
    """
    ends = np.quantile(coefficients[1:], [0.025, 0.975], axis=0)
    amplitude, beta, correction, omega = np.vstack([coefficients[:1], ends]).T
    row = {"amplitude": np.exp(amplitude[0]), "correction": correction[0]}
    return row | three_columns("beta", beta) | three_columns("omega", omega)


def collapse_tables(discs, lines, *, ranges, conventions, tolerance, **options):
    """Return three tables about all grids: {"collapse": table, "infinite_grid": table, "collapse_curves": table}.

    - collapse: test of the collapse of discs, of lines, and of controls, which are discs whose spectrum has a roll-off;
      columns: scaling_collapse.COLUMNS
    - infinite_grid: exponents of discs and lines on an infinitely fine grid; columns: `COLUMNS`
    - collapse_curves: mean curves of discs; columns: scaling_collapse.CURVES

    discs, lines : pools (viscorough_study.ensembles.pool) of realizations on grids from coarse to fine
    ranges : section `collapse` of the settings
    conventions : {"average": kind of mean over the realizations, "rms_convention": where h is measured}
    tolerance : tolerance of exponents
    options : fraction_min and seed of scaling_collapse.grids
    """
    options |= {"elements_min": min(ranges["elements_min"]), "resamples": ranges["resamples"]}
    ends = {"power": ranges["x_high"], "corrected": ranges["corrected_x_high"]}
    pools = {"discs": discs, "controls": discs, "lines": lines}
    by_source = {source: grids(pool, source, conventions=conventions, **options) for source, pool in pools.items()}
    curves = curve_table(by_source["discs"], CURVES_END)
    collapses = collapse_table(by_source, x_high=ranges["x_high"], tolerance=tolerance)
    del by_source["controls"]
    limits = limit_table(by_source, elements_min=ranges["elements_min"], x_high=ends, tolerance=tolerance)
    return {"collapse": collapses, "infinite_grid": limits, "collapse_curves": curves}
