"""Measure the coverage of the 95 % intervals of fitted media, by medium, number of rows and noise level.

    python benchmarks/identification.py --output results/tables/identification.csv

A sphere is pressed into every medium, the depth or the force is recorded at times at equal ratios over 3.5 decades, and
normal noise is added to it. `LOADS` names the histories of the force or of the depth. With --wrong-zero the recorded
depth has an error of its zero of 2 % of the largest depth, and drifts by 1 % of it; both are fitted.

The table has the columns of `COLUMNS`. Coverage is pointwise: all intervals of a record count, from its first row on.
Records that are refused, because noise alone makes the depth recede too far, have no intervals; they are counted.
"""

from functools import partial
from itertools import product
from multiprocessing import Pool

import click
import numpy as np
import pandas as pd
from measuring import output_option, run_timed, save_table
from tqdm import tqdm

from viscorough import (
    KelvinVoigt,
    Load,
    LoadingCurve,
    Maxwell,
    Newtonian,
    Prony,
    Springpot,
    StandardLinearSolid,
    identify_medium,
    kinetics,
)
from viscorough.reference import sphere

MEDIA = {
    "newtonian": Newtonian(3.0),
    "maxwell": Maxwell(2.0, 5.0),
    "kelvin-voigt": KelvinVoigt(2.0, 5.0),
    "solid": StandardLinearSolid(4.0, 1.5, 0.3),
    "prony": Prony(0.5, [10.0, 1.0, 3.0], [0.4, 1.0, 50.0]),
    "springpot": Springpot(2.0, 0.4),
}
ROWS, NOISE = (8, 12, 20, 50, 100, 200), (1e-5, 1e-4, 1e-3, 1e-2)
LOADS = ("step", "ramp", "unload", "hold", "retract")
SPAN, RAMP, CREEP, DEPTH, SEED = (0.02, 60.0), 2.0, 10.0, 3.0, 2013
UNLOAD, WRONG_ZERO, WRONG_DRIFT = 30.0, 0.02, 0.01
COLUMNS = {
    "medium": "name in `MEDIA`",
    "load": "step of the force at time 0; ramp up to time 2; the same and unloading from time 30 on (unload); ramp of "
    "the depth up to time 2 and hold; the same and retraction from time 30 on (retract)",
    "rows": "rows of the record",
    "noise": "standard deviation of the noise over the largest depth or force",
    "trials": "number of records",
    "coverage": "share of intervals that contain J, or ψ if the force is measured, or are stated as unknown",
    "known_coverage": "share of the known intervals that contain it; nan if none is known",
    "least_coverage": "least share over the times, of the intervals that contain it or are stated as unknown",
    "offset_coverage": "share of the intervals that contain the error of the zero of depth; nan if it is not fitted",
    "drift_coverage": "the same for the drift of the depth",
    "error": "median of the largest relative error of J from the first row to the last",
    "refused": "number of records that are refused",
    "unknown": "share of records whose intervals are stated as unknown",
    "width": "median width of the known intervals of J, as a depth, over the standard deviation of the noise",
    "scatter": "median of the scatter found over the standard deviation of the noise",
}


def sphere_curve():
    """Return the loading curve of a sphere of radius 1, beyond the depths of all records."""
    body, depth = sphere(1.0), np.geomspace(1e-9, 20, 300)
    count = 10 * np.arange(1, depth.size + 1)
    force, stiffness = body.force(depth), body.stiffness(depth)
    return LoadingCurve(depth, force, stiffness, count, 10**6, "closed form", 1e-9, 0, np.zeros(depth.size))


def noiseless(curve, medium, rows, load):
    """Force or Load, times, and exact depths or forces of a record; J F at its end is CREEP, or the depth DEPTH."""
    times = np.geomspace(*SPAN, rows)
    if load in ("hold", "retract"):
        last = [DEPTH] if load == "hold" else [DEPTH, 0.0]
        history = Load([0.0, RAMP, *[UNLOAD] * (load == "retract"), times[-1]], depth=[0.0, DEPTH, *last])
        return history, times, kinetics(curve, depth=history, medium=medium, times=times).force
    force = CREEP / float(medium.creep_compliance(times[-1]))
    if load == "ramp":
        force = Load([0.0, RAMP, times[-1]], force=[0.0, force, force])
    elif load == "unload":
        force = Load([0.0, RAMP, UNLOAD, times[-1]], force=[0.0, force, force, 0.1 * force])
    return force, times, kinetics(curve, force, medium, times).depth


def with_wrong_zero(load, times, values):
    """Return the record with an error of the zero of depth and a drift, and these: load, values, offset and drift."""
    if isinstance(load, Load) and load.by_depth:
        offset, drift = WRONG_ZERO * load.values.max(), WRONG_DRIFT * load.values.max() / times[-1]
        samples = np.union1d(load.time, times)
        depth = np.interp(samples, load.time, load.values) + offset + drift * samples
        return Load(samples, depth=depth), values, offset, drift
    offset, drift = WRONG_ZERO * values.max(), WRONG_DRIFT * values.max() / times[-1]
    return load, values + offset + drift * times, offset, drift


def coverage(case, *, trials, wrong_zero=False):
    """Return the row of `COLUMNS` for one case (medium, load, rows, noise)."""
    name, load, rows, noise = case
    curve, medium = sphere_curve(), MEDIA[name]
    history, times, values = noiseless(curve, medium, rows, load)
    deviation = noise * values.max()
    offset = drift = np.nan
    if wrong_zero:
        history, values, offset, drift = with_wrong_zero(history, times, values)
    random = np.random.default_rng([SEED, list(MEDIA).index(name), LOADS.index(load), rows, round(1e9 * noise)])
    holds, widths, scatters, errors, zeros, drifts = [], [], [], [], [], []
    for _ in range(trials):
        noisy = values + deviation * random.standard_normal(rows)
        try:
            found = identify_medium(curve, history, times, noisy, fit_offset=wrong_zero, fit_drift=wrong_zero)
        except ValueError as error:
            if "receded" not in str(error):
                raise
            continue
        shown = found.time >= times[0]
        exact = (medium.creep_compliance if found.measured == "depth" else medium.relaxation_modulus)(found.time[shown])
        low, high = found.low[shown], found.high[shown]
        scatters.append(found.scatter / deviation)
        holds.append(np.where(np.isnan(low), np.nan, (low <= exact) & (exact <= high)))
        compliance = np.interp(times, found.time, found.compliance)
        errors.append(abs(compliance / medium.creep_compliance(times) - 1).max())
        zeros.append(_within(offset, found.offset_interval))
        drifts.append(_within(drift, found.drift_interval))
        if found.measured == "depth":
            # At a step of the force, du/dJ = F/(k/G).
            stiffness = curve.at_force(np.minimum(exact * CREEP / exact[-1], curve.force[-1]))[1]
            widths.append((high - low) * CREEP / exact[-1] / stiffness / deviation)
    holds, unknown = np.array(holds), np.isnan(scatters)
    at_times = np.where(np.isnan(holds), 1.0, holds).mean(axis=0)
    has_intervals = not unknown.all()
    return {
        "medium": name,
        "load": load,
        "rows": rows,
        "noise": noise,
        "trials": trials,
        "coverage": at_times.mean(),
        "known_coverage": np.nanmean(holds) if has_intervals else np.nan,
        "least_coverage": at_times.min(),
        "offset_coverage": np.mean(zeros),
        "drift_coverage": np.mean(drifts),
        "error": np.median(errors),
        "refused": trials - len(holds),
        "unknown": unknown.mean(),
        "width": np.nanmedian(widths) if has_intervals and widths else np.nan,
        "scatter": np.nanmedian(scatters) if has_intervals else np.nan,
    }


def _within(value, interval):
    """1 if an interval contains the value, 0 if not, nan if there is none."""
    return np.nan if np.isnan(value) else float(interval[0] <= value <= interval[1])


@click.command(help=__doc__.splitlines()[0])
@output_option
@click.option("--trials", type=click.IntRange(1), default=300, show_default=True, help="Records of each case.")
@click.option("--rows", type=int, multiple=True, default=ROWS, show_default=True, help="Rows of the records.")
@click.option("--load", type=click.Choice(LOADS), multiple=True, default=("step",), show_default=True)
@click.option("--noise", type=float, multiple=True, default=NOISE, show_default=True, help="Over the largest value.")
@click.option("--wrong-zero", is_flag=True, help="Depths with a wrong zero and a drift, which are fitted.")
@click.option("--cores", type=click.IntRange(1), default=1, show_default=True, help="Processes.")
def main(output, trials, rows, load, noise, wrong_zero, cores):
    cases = list(product(MEDIA, load, rows, noise))
    with Pool(cores) as pool:
        done = pool.imap(partial(coverage, trials=trials, wrong_zero=wrong_zero), cases)
        table = pd.DataFrame(list(tqdm(done, "cases", len(cases), mininterval=2)), columns=list(COLUMNS))
    measures = [name for name in COLUMNS if name not in ("medium", "load", "rows", "noise", "trials")]
    save_table(table.round(dict.fromkeys(measures, 4)), output)
    least = table.loc[table["coverage"].idxmin()]
    click.echo("least coverage {coverage:.3f}: {medium}, {load}, {rows} rows, noise {noise:g}".format(**least))


if __name__ == "__main__":
    run_timed(main)
