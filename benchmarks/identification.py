"""Coverage of the 95 % intervals of identified media, for media, numbers of rows and sizes of the noise.

    python benchmarks/identification.py --output results/tables/identification.csv

A sphere is pressed into every medium by a step or a ramp of the force, the depth is recorded at times at equal ratios
over 3.5 decades, and normal noise is added to it. The table has the columns of `COLUMNS`. Coverage is pointwise: all
intervals of a record count, from its first row on. Records that are refused, because noise alone makes the depth
recede too far, have no intervals; they are counted.
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
ROWS, NOISE, LOADS = (8, 12, 20, 50, 100, 200), (1e-5, 1e-4, 1e-3, 1e-2), ("step", "ramp")
SPAN, RAMP, CREEP, SEED = (0.02, 60.0), 2.0, 10.0, 2013
COLUMNS = {
    "medium": "name in `MEDIA`",
    "load": "step of the force at time 0, or ramp up to time 2",
    "rows": "rows of the record",
    "noise": "standard deviation of the noise over the largest depth",
    "trials": "number of records",
    "coverage": "share of intervals that contain J or are stated as unknown",
    "known_coverage": "share of the known intervals that contain J; nan if none is known",
    "least_coverage": "least share over the times, of the intervals that contain J or are stated as unknown",
    "refused": "number of records that are refused",
    "unknown": "share of records whose intervals are stated as unknown",
    "width": "median width of the known intervals, as a depth, over the standard deviation of the noise",
    "scatter": "median of the scatter found over the standard deviation of the noise",
}


def sphere_curve():
    """Loading curve of a sphere of radius 1, beyond the depths of all records."""
    body, depth = sphere(1.0), np.geomspace(1e-9, 20, 300)
    count = 10 * np.arange(1, depth.size + 1)
    force, stiffness = body.force(depth), body.stiffness(depth)
    return LoadingCurve(depth, force, stiffness, count, 10**6, "closed form", 1e-9, 0, np.zeros(depth.size))


def noiseless(curve, medium, rows, load):
    """Force, times and exact depths of a record whose creep ends at CREEP."""
    times = np.geomspace(*SPAN, rows)
    force = CREEP / float(medium.creep_compliance(times[-1]))
    if load == "ramp":
        force = Load([0.0, RAMP, times[-1]], force=[0.0, force, force])
    return force, times, kinetics(curve, force, medium, times).depth


def coverage(case, *, trials):
    """Row of `COLUMNS` for one case (medium, load, rows, noise)."""
    name, load, rows, noise = case
    curve, medium = sphere_curve(), MEDIA[name]
    force, times, depth = noiseless(curve, medium, rows, load)
    deviation = noise * depth[-1]
    random = np.random.default_rng([SEED, list(MEDIA).index(name), LOADS.index(load), rows, NOISE.index(noise)])
    holds, widths, scatters = [], [], []
    for _ in range(trials):
        try:
            found = identify_medium(curve, force, times, depth + deviation * random.standard_normal(rows))
        except ValueError as error:
            if "receded" not in str(error):
                raise
            continue
        shown = found.time >= times[0]
        exact = medium.creep_compliance(found.time[shown])
        low, high = found.low[shown], found.high[shown]
        scatters.append(found.scatter / deviation)
        holds.append(np.where(np.isnan(low), np.nan, (low <= exact) & (exact <= high)))
        # At a step of the force, du/dJ = F/(k/G).
        stiffness = curve.at_force(np.minimum(exact * CREEP / exact[-1], curve.force[-1]))[1]
        widths.append((high - low) * CREEP / exact[-1] / stiffness / deviation)
    holds, unknown = np.array(holds), np.isnan(scatters)
    at_times = np.where(np.isnan(holds), 1.0, holds).mean(axis=0)
    known = not unknown.all()
    return {
        "medium": name,
        "load": load,
        "rows": rows,
        "noise": noise,
        "trials": trials,
        "coverage": at_times.mean(),
        "known_coverage": np.nanmean(holds) if known else np.nan,
        "least_coverage": at_times.min(),
        "refused": trials - len(holds),
        "unknown": unknown.mean(),
        "width": np.nanmedian(widths) if known else np.nan,
        "scatter": np.nanmedian(scatters) if known else np.nan,
    }


@click.command(help=__doc__.splitlines()[0])
@output_option
@click.option("--trials", type=click.IntRange(1), default=300, show_default=True, help="Records of each case.")
@click.option("--rows", type=int, multiple=True, default=ROWS, show_default=True, help="Rows of the records.")
@click.option("--load", type=click.Choice(LOADS), multiple=True, default=("step",), show_default=True)
@click.option("--cores", type=click.IntRange(1), default=1, show_default=True, help="Processes.")
def main(output, trials, rows, load, cores):
    cases = list(product(MEDIA, load, rows, NOISE))
    with Pool(cores) as pool:
        done = pool.imap(partial(coverage, trials=trials), cases)
        table = pd.DataFrame(list(tqdm(done, "cases", len(cases), mininterval=2)), columns=list(COLUMNS))
    measures = [name for name in COLUMNS if name not in ("medium", "load", "rows", "noise", "trials")]
    save_table(table.round(dict.fromkeys(measures, 4)), output)
    least = table.loc[table["coverage"].idxmin()]
    click.echo("least coverage {coverage:.3f}: {medium}, {load}, {rows} rows, noise {noise:g}".format(**least))


if __name__ == "__main__":
    run_timed(main)
