"""Compare error and cost of every model of the mean velocity of many surfaces.

The models are boundary elements on several grids, lines of the MDR, and the law of the library. The exact mean is the
geometric mean over all discs on the finest grid. The law describes arithmetic means, so it is compared with the
arithmetic mean over the same discs.

If a model averages the velocities of n surfaces, its error is √⟨b² + s²/n⟩, where ⟨ ⟩ is the mean over X = Ft/(4ηhL)
from 0.01 to 1. At each X, s is the standard deviation of ln(vt/h) among single surfaces, and b is the deviation of the
model's mean of ln(vt/h) from the exact mean, less the part that the scatter of the realizations explains. A model that
needs no surfaces has the error b. The law has no error for a Hurst exponent or X outside its calibration. The processor
time is n times the time of one curve (performance.one_surface).
"""

import numpy as np
import pandas as pd

from viscorough.law.calibrated_law import law_covers, penetration_law
from viscorough.reference import exponent_beta
from viscorough_study.ensembles.pool import elements_across, ensembles, select
from viscorough_study.fits.conventions import fits
from viscorough_study.run.names import GRID, LAW, MDR, MDR_FITTED, MDR_PI, MEAN_X, PAPER

SURFACES = (1, 4, 16, 64, 256)
# Use the processor times of loading curves with this tolerance. Curves with finer tolerances have the same mean
# (docs/verification.md).
TOLERANCE = 1e-2
COLUMNS = {
    "hurst": ("Hurst exponent", "1"),
    "quantity": ("velocity, or exponent β of the power law", ""),
    "model": ("grid (boundary elements), MDR with λ = π or λ fitted, law, or H/(1 + H)", ""),
    "across": ("elements across the discs; missing for other models", "1"),
    "surfaces": ("surfaces in the mean; 0 for a model that needs none", "1"),
    "processor_s": ("processor time of all surfaces; missing where a curve was not timed", "s"),
    "error": ("relative error of the mean", "1"),
    "reference_error": ("standard error of the exact mean, over the discs on the finest grid; missing for β", "1"),
}


def mean_accuracy(discs, coarse, lines, mdr_lambda, scaling, one_surface, *, conventions):
    """Compute error and cost of every model of the mean; return a pandas.DataFrame with the columns of `COLUMNS`.

    discs, coarse, lines : pools (ensembles.pool) of discs, of discs on coarser grids, and of MDR lines
    mdr_lambda, scaling, one_surface : tables of results with these names
    conventions : choices that the paper leaves open, {name of the choice: value used in the figures}
        (fits.conventions)
    """
    rms = conventions["rms_convention"]
    base = ensembles(select(discs, group="base"), "hurst", rms_convention=rms)
    reduced = ensembles(lines, "hurst", rms_convention="line")
    grids = ensembles(coarse, "hurst", "elements", rms_convention=rms)
    rows, standard_errors = [], {}
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
            fitted = mdr_lambda[(mdr_lambda["hurst"] == hurst) & mdr_lambda["x"].between(*MEAN_X)]
            if len(fitted):
                deviation = np.sqrt(np.mean(np.log(fitted["velocity_ratio"]) ** 2))
                velocity.append((MDR_FITTED, np.nan, deviation, line.scatter, seconds))
        rows += [
            (hurst, "velocity", model, across, number, number * seconds, np.hypot(deviation, scatter / np.sqrt(number)))
            for model, across, deviation, scatter, seconds in velocity
            for number in SURFACES
        ]
        here = (x >= MEAN_X[0]) & (x <= MEAN_X[1])
        law = penetration_law(hurst).velocity(x[here]) if law_covers(hurst, x[here]) else np.nan
        deviation = np.log(law / truth["velocity_arithmetic"].values[here])
        rows.append((hurst, "velocity", LAW, np.nan, 0, 0.0, _root_mean(deviation**2)))
        rows += _exponent_rows(hurst, scaling, conventions, lines, times)
        standard_errors[hurst] = exact.standard_error
    table = pd.DataFrame(rows, columns=[name for name in COLUMNS if name != "reference_error"])
    reference = table["hurst"].map(standard_errors).where(table["quantity"] == "velocity")
    return table.assign(reference_error=reference)


class _Mean:
    """Mean and scatter of ln(vt/h) over the surfaces of an ensemble, at the values of X from 0.01 to 1."""

    def __init__(self, ensemble):
        here = (ensemble["x"].values >= MEAN_X[0] * 0.999) & (ensemble["x"].values <= MEAN_X[1] * 1.001)
        self.logarithm = np.log(ensemble["velocity_geometric"].values[here])
        self.variance = ensemble["velocity_spread"].values[here] ** 2
        self.number = ensemble["realizations_defined"].values[here]
        self.across = elements_across(float(ensemble["elements"].values.flat[0]))

    @property
    def scatter(self):
        """Return the standard deviation of ln(vt/h) among single surfaces, as a root mean square over all X."""
        return _root_mean(self.variance)

    @property
    def standard_error(self):
        """Return the standard error of the mean of ln(vt/h), as a root mean square over all X."""
        return _root_mean(self.variance / self.number)

    def deviation(self, other):
        """Return the root mean square over all X of the difference between another mean and this mean.

        The part of the difference that the scatter of the two ensembles explains is subtracted.
        """
        by_chance = self.variance / self.number + other.variance / other.number
        return _root_mean((other.logarithm - self.logarithm) ** 2 - by_chance)


def _root_mean(squares):
    """Return the root of the mean of the defined squares; 0 if the mean is negative, nan if none is defined."""
    defined = squares[np.isfinite(squares)]
    return float(np.sqrt(max(defined.mean(), 0.0))) if defined.size else np.nan


def _nearest(values, value):
    values = np.asarray(values)
    return values[np.abs(values - value).argmin()]


def _grid_time(times, across):
    """Return the processor time of a loading curve on a grid with `across` elements across; nan if none was timed."""
    timed = times.query("model == @GRID and across == @across and value == @TOLERANCE")["processor_s"]
    return timed.iloc[0] if len(timed) else np.nan


def _line_time(times, points):
    """Estimate the processor time of an MDR line with the given number of points from the lines that were timed.

    The timed line with the nearest number of points is used. If the requested line has more points, the time is
    increased in proportion to the number of points.
    """
    timed = times[times["model"] == MDR]
    nearest = timed.loc[np.abs(np.log(timed["value"] / points)).idxmin()]
    return nearest["processor_s"] * max(1.0, points / nearest["value"])


def _exponent_rows(hurst, scaling, conventions, lines, times):
    """Yield a table row for each model, with the error of its exponent β in region (b), relative to β of the discs.

    The law has no error for a Hurst exponent outside its calibration.
    No rows are yielded if the discs have no region (b).
    """
    discs = fits(scaling, conventions, source="discs", group="base").set_index("hurst")["beta"]
    if not np.isfinite(exact := discs.get(hurst, np.nan)):
        return
    betas = {PAPER: exponent_beta(hurst), LAW: penetration_law(hurst).beta if law_covers(hurst) else np.nan}
    for model, beta in betas.items():
        yield hurst, "exponent", model, np.nan, 0, 0.0, abs(beta / exact - 1)
    reduced = fits(scaling, conventions | {"rms_convention": "line"}, source="lines").set_index("hurst")
    if hurst in reduced.index and np.isfinite(beta := reduced.loc[hurst, "beta"]):
        number = int((lines["hurst"].values == hurst).sum())
        points = float(lines["elements"].values.flat[0])
        yield hurst, "exponent", MDR_PI, np.nan, number, number * _line_time(times, points), abs(beta / exact - 1)
