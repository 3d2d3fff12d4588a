"""Measure error and computing time of every method that predicts the contact of one rough surface.

A method is called a model here. The models are boundary elements on several grids and with several tolerances, the
method of dimensionality reduction (MDR), and the calibrated penetration law of the library. The law has no error for a
Hurst exponent or X outside its calibration.

The error of a model is its deviation from the full map, the map of all points of the same surface. The error of the
velocity v is the root mean square of ln(v/v_full) at X = F/(4GhL) from 0.01 to 3, uniform in ln X, and over several
surfaces. The error of the contact area is defined in the same way. The error of pressures is only the error of the
solver on a given grid, because pressures of a self-affine surface have no limit as the grid becomes finer.
"""

import logging

import numpy as np
import pandas as pd
from threadpoolctl import threadpool_limits

from viscorough.contact.grid_error import every_nth_point
from viscorough.contact.loading_path import indent
from viscorough.contact.one_contact import contact_at
from viscorough.law.calibrated_law import law_covers, penetration_law
from viscorough.mdr import reduce
from viscorough.surfaces.lines import self_affine_line
from viscorough.surfaces.self_affine import self_affine_disc
from viscorough_study.performance import timing
from viscorough_study.run.kernels import compile_kernels
from viscorough_study.run.names import CONTACT, GRID, LAW, MDR
from viscorough_study.run.seeds import one_surface_key, realization_seed

X = (0.01, 3.0)
PER_DECADE = 50
STEPS = (16, 8, 4, 2)  # coarser grids consist of every n-th point of the full map, for these n
FEWEST_ACROSS = 17  # grids with fewer points across are not used
TOLERANCES = (1e-1, 1e-2, 1e-3)
FULL_TOLERANCE = 1e-3  # tolerance of the loading curve of the full map, the map of all points
POINTS = tuple(2**n for n in (8, 11, 14, 17))
# Pressures are compared at X = CONTACT_X, on the grid of every second point (CONTACT_STEP). The reference pressures
# are computed with the tolerance EXACT_TOLERANCE.
CONTACT_X, CONTACT_STEP, CONTACT_TOLERANCES, EXACT_TOLERANCE = 0.1, 2, (1e-1, 1e-2, 1e-3), 1e-8
SHORT, REPEATS = 0.1, 2  # a computation of less than SHORT seconds is repeated REPEATS times
COLUMNS = {
    "hurst": ("Hurst exponent", "1"),
    "quantity": ("velocity, contact area, or pressures", ""),
    "model": ("grid, MDR, law, or one contact", ""),
    "across": ("points across the map that is used; missing without a map", "1"),
    "parameter": ("parameter of the model", ""),
    "value": ("value of that parameter", "1"),
    "processor_s": ("processor time, median over the surfaces", "s"),
    "error": ("relative error, root mean square over X and over the surfaces", "1"),
    "stated": ("error that the curve of the full map states itself, mean over the surfaces; else missing", "1"),
    "surfaces": ("surfaces", "1"),
}
LABELS = ["hurst", "quantity", "model", "across", "parameter", "value"]


def measure_one_surface(*, hurst, elements, surfaces, seed):
    """Measure computing time and error of every model (see the module) on several surfaces for each Hurst exponent.

    Returns a pandas.DataFrame with the columns of `COLUMNS`, averaged over the surfaces.

    hurst : Hurst exponents; elements : number of elements across the full map
    surfaces : number of surfaces for each Hurst exponent; seed : root of the surfaces' seeds
    """
    compile_kernels()  # load compiled code now, so that its loading is not timed
    rows = []
    # Use one thread. Snakemake gives the job all cores, so that no other job disturbs the timing.
    with threadpool_limits(1):
        for exponent in hurst:
            for number in range(surfaces):
                logging.info("H = %g, surface %d", exponent, number)
                own_seed = realization_seed(seed, *one_surface_key(exponent, number))
                rows += [
                    {"hurst": exponent, "surface": number} | row for row in surface_rows(exponent, elements, own_seed)
                ]
    return averaged(pd.DataFrame(rows))


def averaged(table):
    """Average the rows of a table over the surfaces, and return the averaged table.

    Errors are averaged by the root mean square, times by the median, and stated errors by the arithmetic mean.
    """
    table = table.assign(square=table["error"] ** 2)
    means = {"processor_s": "median", "square": "mean", "stated": "mean", "surface": "nunique"}
    grouped = table.groupby(LABELS, sort=False, dropna=False)
    result = grouped.agg(means).reset_index().rename(columns={"surface": "surfaces"})
    return result.assign(error=np.sqrt(result["square"]))[list(COLUMNS)]


def surface_rows(hurst, elements, seed):
    """Measure error and computing time of every model (see the module) on one random surface; return rows of the table.

    Each row is a dict, whose keys are the columns in `COLUMNS` except for hurst and surfaces.
    """
    own_seed, line_seed = seed.spawn(2)
    disc = self_affine_disc(hurst, elements, seed=own_seed)  # a disc with h = L = 1
    x = np.geomspace(*X, round(PER_DECADE * np.log10(X[1] / X[0])))
    force = 4 * x
    until = {"until_fraction": 1.0, "until_force": 4 * X[1] * (1 + 1e-9)}
    full, full_time = _timed(lambda: indent(disc, tolerance=FULL_TOLERANCE, estimate_grid_error=True, **until))
    truth = _answers(full, force, disc)

    def rows(curve, seconds, model, across, parameter, value, stated=np.nan):
        shared = {"model": model, "across": across, "parameter": parameter, "value": value, "processor_s": seconds}
        answers = _answers(curve, force, disc)
        errors = {name: _deviation(answers[name], truth[name]) for name in truth}
        return [shared | {"quantity": name, "error": error, "stated": stated} for name, error in errors.items()]

    table = rows(full, full_time, GRID, elements, "tolerance", FULL_TOLERANCE, full.mean_grid_error)
    for step in STEPS:
        sampled = every_nth_point(disc, step)
        across = len(sampled.heights)
        if across < FEWEST_ACROSS:
            continue
        for tolerance in TOLERANCES:
            curve, seconds = _timed(lambda: indent(sampled, tolerance=tolerance, **until))  # noqa: B023
            table += rows(curve, seconds, GRID, across, "tolerance", tolerance)
    velocity_row = {"quantity": "velocity", "across": np.nan, "stated": np.nan}
    for points in POINTS:
        velocity, seconds = _timed(lambda: _reduced_velocity(hurst, points, force, line_seed))  # noqa: B023
        made = {"model": MDR, "parameter": "points", "value": points, "processor_s": seconds}
        table.append(velocity_row | made | {"error": _deviation(velocity, truth["velocity"])})
    velocity = penetration_law(hurst).velocity(x) if law_covers(hurst, x) else np.nan
    made = {"model": LAW, "parameter": "", "value": np.nan, "processor_s": 0.0}
    table.append(velocity_row | made | {"error": _deviation(velocity, truth["velocity"])})
    return table + _pressure_rows(every_nth_point(disc, CONTACT_STEP))


def _timed(function):
    """Call a function; return its result and its processor time.

    A short computation is repeated, and the shortest time is returned.
    """
    result, _, seconds = timing.timed(function)
    repeats = REPEATS if seconds < SHORT else 0
    return result, min([seconds, *(timing.timed(function)[2] for _ in range(repeats))])


def _answers(curve, force, disc):
    """Return the velocity vt and the contact area on a loading curve, as {quantity: values at the given forces}.

    force : F/G with h = L = 1; forces beyond an end of the curve are replaced by the force at this end
    """
    force = np.clip(force, curve.force[0], curve.force[-1])
    fraction = np.exp(np.interp(np.log(force), np.log(curve.force), np.log(curve.contact_fraction)))
    return {"velocity": force / curve.at_force(force)[1], "contact area": fraction}


def _deviation(values, truth):
    return float(np.sqrt(np.mean(np.log(values / truth) ** 2)))


def _reduced_velocity(hurst, points, force, seed):
    """Compute the velocities vt = (F/G)/(k/G) by the MDR, on one random line with the h, L and H of the surface."""
    line = self_affine_line(hurst, points, seed=seed)
    return force / reduce(line, until_force=force[-1] * (1 + 1e-9)).at_force(force)[1]


def _pressure_rows(sampled):
    """Compute the pressures of one contact with several tolerances; return a table row for each tolerance.

    sampled : the surface on a coarser grid
    """
    force = 4 * CONTACT_X
    exact = contact_at(sampled, force=force, tolerance=EXACT_TOLERANCE).pressure
    scale, rows = np.sqrt(np.nanmean(exact**2)), []
    shared = {"quantity": "pressures", "model": CONTACT, "across": len(sampled.heights), "parameter": "tolerance"}
    for tolerance in CONTACT_TOLERANCES:
        contact, seconds = _timed(lambda: contact_at(sampled, force=force, tolerance=tolerance))  # noqa: B023
        error = float(np.sqrt(np.nanmean((contact.pressure - exact) ** 2)) / scale)
        rows.append(shared | {"value": tolerance, "processor_s": seconds, "error": error, "stated": np.nan})
    return rows
