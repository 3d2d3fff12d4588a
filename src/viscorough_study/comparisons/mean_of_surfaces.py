"""Error and cost of every model of the mean of many surfaces: grids, the MDR and the law.

The truth is the geometric mean of all discs on the finest grid. The velocity of a mean over n surfaces has the error
√⟨b² + s²/n⟩: the deviation b of the model, as far as the scatter of its realizations does not explain it, and the
scatter s of single surfaces, both of ln(vt/h) at fixed X = Ft/(4ηhL), with the mean over X from 0.01 to 1. A model
without surfaces has the error b. The time is n times the time of one curve (performance.one_surface).
"""

import numpy as np
import pandas as pd

from viscorough.law.calibrated_law import penetration_law
from viscorough.reference import exponent_beta
from viscorough_study.ensembles.pool import elements_across, ensembles, select
from viscorough_study.fits.conventions import fits
from viscorough_study.run.names import GRID, LAW, MDR, MDR_FITTED, MDR_PI, PAPER

X = (0.01, 1.0)
SURFACES = (1, 4, 16, 64, 256)
TOLERANCE = 1e-2  # of the curves whose time is taken: finer ones have the same mean (docs/verification.md)
COLUMNS = {
    "hurst": ("Hurst exponent", "1"),
    "quantity": ("velocity, or exponent β of the power law", ""),
    "model": ("grid (boundary elements), MDR with λ = π or λ fitted, law, or H/(1 + H)", ""),
    "across": ("elements across the discs; missing for other models", "1"),
    "surfaces": ("surfaces in the mean; 0 for a model that needs none", "1"),
    "processor_s": ("processor time of all surfaces; missing where a curve was not timed", "s"),
    "error": ("relative error of the mean", "1"),
}


def mean_accuracy(discs, lines, size_discs, mdr_lambda, scaling, one_surface, *, conventions):
    """Error and cost of every model of the mean; a pandas.DataFrame with the columns of `COLUMNS`.

    discs, lines, size_discs : pools; mdr_lambda, scaling, one_surface : tables; conventions : of the figures
    """
    rms = conventions["rms_convention"]
    base = ensembles(select(discs, group="base"), "hurst", rms_convention=rms)
    reduced = ensembles(lines, "hurst", rms_convention="line")
    grids = ensembles(select(size_discs, group="sizes"), "hurst", "elements", rms_convention=rms)
    rows = []
    for hurst, truth in base.items():
        times = one_surface[one_surface["hurst"] == _nearest(one_surface["hurst"], hurst)].query(
            "quantity == 'velocity'"
        )
        exact, x = _Mean(truth), truth["x"].values
        velocity = [
            (GRID, across, exact.deviation(_Mean(grid)), _Mean(grid).scatter, _grid_time(times, across))
            for (exponent, elements), grid in grids.items()
            if exponent == hurst and (across := elements_across(elements)) < exact.across
        ]
        velocity.append((GRID, exact.across, 0.0, exact.scatter, _grid_time(times, exact.across)))
        if hurst in reduced:
            line = _Mean(reduced[hurst])
            seconds = _line_time(times, float(reduced[hurst]["elements"].values.flat[0]))
            velocity.append((MDR_PI, np.nan, exact.deviation(line), line.scatter, seconds))
            fitted = mdr_lambda[(mdr_lambda["hurst"] == hurst) & mdr_lambda["x"].between(*X)]
            if len(fitted):
                deviation = np.sqrt(np.mean(np.log(fitted["velocity_ratio"]) ** 2))
                velocity.append((MDR_FITTED, np.nan, deviation, line.scatter, seconds))
        rows += [
            (hurst, "velocity", model, across, number, number * seconds, np.hypot(deviation, scatter / np.sqrt(number)))
            for model, across, deviation, scatter, seconds in velocity
            for number in SURFACES
        ]
        here = (x >= X[0]) & (x <= X[1])
        law = np.log(penetration_law(hurst).velocity(x[here])) - np.log(truth["velocity_arithmetic"].values[here])
        rows.append((hurst, "velocity", LAW, np.nan, 0, 0.0, np.sqrt(np.nanmean(law**2))))
        rows += _exponent_rows(hurst, scaling, conventions, lines, times)
    return pd.DataFrame(rows, columns=list(COLUMNS))


class _Mean:
    """Mean and scatter of ln(vt/h) of an ensemble, at the X of the comparison."""

    def __init__(self, ensemble):
        here = (ensemble["x"].values >= X[0] * 0.999) & (ensemble["x"].values <= X[1] * 1.001)
        self.logarithm = np.log(ensemble["velocity_geometric"].values[here])
        self.variance = ensemble["velocity_spread"].values[here] ** 2
        self.number = ensemble["realizations_defined"].values[here]
        self.across = elements_across(float(ensemble["elements"].values.flat[0]))

    @property
    def scatter(self):
        """Standard deviation of ln(vt/h) of single surfaces."""
        return float(np.sqrt(np.nanmean(self.variance)))

    def deviation(self, other):
        """Deviation of another mean, without the part that the scatter of both explains."""
        by_chance = self.variance / self.number + other.variance / other.number
        return float(np.sqrt(max(np.nanmean((other.logarithm - self.logarithm) ** 2 - by_chance), 0.0)))


def _nearest(values, value):
    values = np.asarray(values)
    return values[np.abs(values - value).argmin()]


def _grid_time(times, across):
    """Processor time of a curve with so many elements across; nan if none was timed."""
    timed = times.query("model == @GRID and across == @across and value == @TOLERANCE")["processor_s"]
    return timed.iloc[0] if len(timed) else np.nan


def _line_time(times, points):
    """Processor time of a line, proportional to its points beyond the longest one that was timed."""
    timed = times[times["model"] == MDR]
    nearest = timed.loc[np.abs(np.log(timed["value"] / points)).idxmin()]
    return nearest["processor_s"] * max(1.0, points / nearest["value"])


def _exponent_rows(hurst, scaling, conventions, lines, times):
    """Errors of the exponent β in region (b), relative to that of the discs; none without such a region."""
    discs = fits(scaling, conventions, source="discs", case_group="base").set_index("hurst")["beta"]
    if not np.isfinite(exact := discs.get(hurst, np.nan)):
        return
    betas = {PAPER: exponent_beta(hurst), LAW: penetration_law(hurst).beta}
    for model, beta in betas.items():
        yield hurst, "exponent", model, np.nan, 0, 0.0, abs(beta / exact - 1)
    reduced = fits(scaling, conventions | {"rms_convention": "line"}, source="lines").set_index("hurst")
    if hurst in reduced.index and np.isfinite(beta := reduced.loc[hurst, "beta"]):
        number = int((lines["hurst"].values == hurst).sum())
        points = float(lines["elements"].values.flat[0])
        yield hurst, "exponent", MDR_PI, np.nan, number, number * _line_time(times, points), abs(beta / exact - 1)
