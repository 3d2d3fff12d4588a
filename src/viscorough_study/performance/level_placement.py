"""Placement of the levels of a loading curve: by `indent`, by hand, and naively, on the same scenes.

A scene is an indenter and a range of force; it is solved to several accuracies of the depth at any force in that range.
Levels by hand are in equal ratios of depth over exactly that range, which must be known beforehand; their number is the
smallest that reaches the accuracy. Naive levels are in equal steps of depth; their number is likewise the smallest. The
numbers are found by trials, whose time does not count. The tolerance of every level is the required accuracy.
"""

import logging
from functools import partial

import numpy as np
import pandas as pd
from threadpoolctl import threadpool_limits

from viscorough import reference
from viscorough.contact.loading_path import indent
from viscorough.surfaces.self_affine import self_affine_disc
from viscorough_study.performance import timing
from viscorough_study.run.names import AUTOMATIC, BY_HAND, NAIVE

ACCURACIES = (1e-1, 3e-2, 1e-2, 3e-3, 1e-3)
NUMBERS = (3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256, 384, 512)  # numbers of levels tried
LONGEST = 10.0  # a choice is not tried with more levels once it takes so many times as long as the automatic one
MARGIN = 0.01  # by which levels extend beyond the range of depth, whose ends are known only to the tolerance
PROBES = 60  # forces at which the depth is compared
REFERENCE_TOLERANCE = 1e-9  # of the reference depths
COLUMNS = {
    "scene": ("scene", ""),
    "choice": ("placement of the levels", ""),
    "accuracy": ("relative accuracy required of the depth", "1"),
    "error": ("largest relative error of the depth at any force of the range", "1"),
    "reached": ("1 if the error is within the accuracy", "1"),
    "levels": ("levels", "1"),
    "processor_s": ("processor time, median of interleaved repeats", "s"),
}


def scenes(elements, hurst, seed):
    """The scenes: one asperity, and a rough disc in region (b) alone and over a full curve.

    Returns tuples: name, indenter, contact fractions at the ends of the range of force.
    """
    asperity = reference.sphere(1.0).indenter(elements)
    disc = self_affine_disc(hurst, elements, seed=seed)
    few = 10 / disc.elements
    return [
        ("one asperity", asperity, 0.01, 0.5),
        ("region (b)", disc, few, max(0.02, 4 * few)),
        ("full curve", disc, few, 0.9),
    ]


def compare_scenes(*, elements, hurst, seed, repeats):
    """The three choices of levels for every scene, on one thread; a pandas.DataFrame with the columns of `COLUMNS`."""
    with threadpool_limits(1):  # Snakemake gives the job all cores, so that no other job runs
        return pd.concat([compare(*scene, repeats) for scene in scenes(elements, hurst, seed)])


def compare(name, indenter, first_fraction, last_fraction, repeats, *, accuracies=ACCURACIES, numbers=NUMBERS):
    """Cost and error of the three choices of levels for a scene.

    name, indenter, first_fraction, last_fraction : as of `scenes`
    repeats : number of interleaved repeats, of which the times are medians
    accuracies : required of the depth, from loose to fine; numbers : of levels to try, increasing

    Returns a pandas.DataFrame with the columns of `COLUMNS`: one row per choice and accuracy.
    """
    coarse = indent(indenter, tolerance=1e-2, until_fraction=last_fraction)
    ends = np.interp([first_fraction, last_fraction], coarse.contact_fraction, coarse.depth)
    exact = indent(indenter, tolerance=REFERENCE_TOLERANCE, depths=np.geomspace(*ends, PROBES))
    first, last = ends * [1 - MARGIN, 1 + MARGIN]
    depths = {
        BY_HAND: lambda number: np.geomspace(first, last, number),
        NAIVE: lambda number: np.linspace(0, last, number + 1)[1:],
    }
    # With the margin of levels by hand: the level of a contact fraction first reached at a force may lie beyond it.
    start = {"start_fraction": first_fraction * (1 - MARGIN), "until_fraction": 1, "until_force": exact.force[-1]}
    rows, fewest = [], dict.fromkeys(depths, numbers[0])
    for accuracy in accuracies:
        logging.info("%s, accuracy %g", name, accuracy)
        path = partial(indent, indenter, tolerance=accuracy)
        automatic = _row(AUTOMATIC, accuracy, partial(path, **start), exact)
        rows.append(automatic)
        for choice, placed in depths.items():
            for number in (number for number in numbers if number >= fewest[choice]):
                row = _row(choice, accuracy, partial(path, depths=placed(number)), exact)
                if row["reached"] or row["processor_s"] > LONGEST * automatic["processor_s"]:
                    break
            fewest[choice] = number  # a finer accuracy needs no fewer levels
            rows.append(row)
    times = timing.interleaved({i: row["function"] for i, row in enumerate(rows)}, repeats)
    table = pd.DataFrame(rows).assign(scene=name, processor_s=[seconds for _, seconds in times.values()])
    return table[list(COLUMNS)]


def _row(choice, accuracy, levels, exact):
    """Choice, function that computes its curve, number of levels, error and time."""
    curve, _, seconds = timing.timed(levels)
    depth, _ = curve.at_force(exact.force)
    error = np.nan_to_num(np.abs(depth / exact.depth - 1), nan=1.0).max()
    row = {
        "choice": choice,
        "accuracy": accuracy,
        "function": levels,
        "error": error,
        "reached": int(error <= accuracy),
    }
    return row | {"levels": curve.depth.size, "processor_s": seconds}
