"""Measure time and memory of the loading curve of one disc on grids from coarse to fine.

    python benchmarks/large_discs.py --output results/tables/large.csv

Each disc is indented in a separate process, whose peak memory counts. `make large` runs it.
"""

import resource
from functools import partial
from multiprocessing import get_context

import click
import numpy as np
import pandas as pd
from measuring import LARGE_PAGES, output_option, run_timed, save_times

from viscorough.contact.loading_path import indent
from viscorough.surfaces.self_affine import self_affine_disc
from viscorough_study.performance import timing
from viscorough_study.run.seeds import large_disc_key, realization_seed

# Elements across the discs, and across a small disc that is indented first to load the compiled functions.
ELEMENTS, WARM_UP = (129, 257, 513, 1025, 2049, 4097, 8193), 129
HURST, TOLERANCE, SEED = 0.7, 1e-3, 2013
ROUNDS, MAX_REPEATED = 3, 20.0  # rounds of a run on one thread and a run on several; longest run that is repeated [s]
COLUMNS = {
    "across": ("elements across the disc", "1"),
    "elements": ("elements of the disc", "1"),
    "levels": ("levels of its loading curve", "1"),
    "operator_applications": ("applications of the half-space operator", "1"),
    "wall": ("wall time on one thread, median", "s"),
    "processor": ("processor time on one thread, median", "s"),
    "threads": ("threads of other runs", "1"),
    "wall_threads": ("their wall time, median", "s"),
    "memory": ("largest memory of the process", "byte"),
    "machine": ("machine on which times and memory were measured", None),
}


def measure_disc(across, *, until_fraction, threads):
    """Measure the loading curve of a disc of diameter and rms height 1; return {column of `COLUMNS`: value}.

    across : elements across the disc
    threads : threads of a second run, which alternates with the first in ROUNDS rounds, or in one round if runs take
        long
    Memory is the peak memory of this process.
    """
    indent(self_affine_disc(HURST, WARM_UP, seed=0), tolerance=TOLERANCE)
    disc = self_affine_disc(HURST, across, seed=realization_seed(SEED, *large_disc_key(across)))
    press = partial(indent, disc, tolerance=TOLERANCE, until_fraction=until_fraction)
    rounds = []
    while not rounds or (len(rounds) < ROUNDS and rounds[0][0] < MAX_REPEATED):
        curve, *alone = timing.timed(press)
        rounds.append((*alone, timing.timed(partial(press, threads=threads))[1]))
    wall, processor, wall_threads = np.median(rounds, axis=0).tolist()
    return {
        "across": across,
        "elements": disc.elements,
        "levels": curve.depth.size,
        "operator_applications": curve.operator_applications,
        "wall": wall,
        "processor": processor,
        "threads": threads,
        "wall_threads": wall_threads,
        "memory": 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss,
        "machine": "{name}, {processor}, {cores} cores".format(**timing.machine()),
    }


@click.command(help=__doc__.splitlines()[0])
@output_option
@click.option("--largest", type=click.IntRange(257), default=8193, show_default=True, help="Elements across, at most.")
@click.option(
    "--until-fraction", type=float, default=0.5, show_default=True, help="Contact fraction of the last level."
)
@click.option("--cores", type=click.IntRange(1), default=2, show_default=True, help="Threads of the second runs.")
def main(output, largest, until_fraction, cores):
    rows, options = [], {"until_fraction": until_fraction, "threads": cores}
    for across in (number for number in ELEMENTS if number <= largest):
        click.echo(f"{across} elements across")
        with get_context("spawn").Pool(1) as pool:
            rows.append(pool.apply(measure_disc, (across,), options))
    table = pd.DataFrame(rows, columns=list(COLUMNS))
    settings = {"hurst": HURST, "tolerance": TOLERANCE, "seed": SEED, **options}
    save_times(table, output, COLUMNS, "Cost of one disc", settings)


if __name__ == "__main__":
    run_timed(main, **LARGE_PAGES)
