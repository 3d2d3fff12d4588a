"""Cost of the loading curve of one disc on grids from coarse to fine."""

import resource
from functools import partial

import numpy as np
import pandas as pd

from viscorough.contact.loading_path import indent
from viscorough.surfaces import self_affine_disc
from viscorough_study.performance import timing

ROUNDS, MAX_REPEATED = 3, 20.0  # rounds of a run on one thread and one on several; longest run that is repeated [s]
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


def costs_table(costs):
    """One table of the costs of all sizes, by size; costs : tables of one row, as of `measure_disc`."""
    return pd.concat(costs).sort_values("elements", ignore_index=True)


def measure_disc(*, hurst, elements, seed, tolerance, until_fraction, warm_up, threads):
    """Cost of the loading curve of a disc of diameter and rms height 1, {column of `COLUMNS`: value}.

    elements, warm_up : across the disc, and across one that is indented first to load the compiled functions
    threads : of a second run, which alternates with the first in ROUNDS rounds, or in one round if runs take long
    Memory is the peak memory of this process.
    """
    indent(self_affine_disc(hurst, warm_up, seed=0), tolerance=tolerance)
    disc = self_affine_disc(hurst, elements, seed=seed)
    press = partial(indent, disc, tolerance=tolerance, until_fraction=until_fraction)
    rounds = []
    while not rounds or (len(rounds) < ROUNDS and rounds[0][0] < MAX_REPEATED):
        curve, *alone = timing.timed(press)
        rounds.append((*alone, timing.timed(partial(press, threads=threads))[1]))
    wall, processor, wall_threads = np.median(rounds, axis=0).tolist()
    return {
        "across": elements,
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
