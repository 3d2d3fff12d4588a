"""Placement of the levels of a loading curve: by `indent`, by hand, and naively, on the same scenes.

A scene is an indenter, a range of force, and the accuracy required of the depth at any force in it. Levels by hand are
in equal ratios of depth over exactly that range, which must be known beforehand; their number is the smallest that
reaches the accuracy. Naive levels are in equal steps of depth; their number is the smallest with an error no larger
than that of the automatic levels. The tolerance of every level is the required accuracy.
"""

import logging
from functools import partial

import numpy as np
import pandas as pd
from threadpoolctl import threadpool_limits

from viscorough import reference
from viscorough.contact.loading_path import indent
from viscorough.surfaces import self_affine_disc
from viscorough_study.performance import timing

HAND_PICKED = (3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256, 384, 512)  # numbers of levels tried
NAIVE = tuple(2**n for n in range(2, 13))
# The search ends at these multiples of the automatic choice's number of levels (hand-picked) and time (naive).
MAX_RATIO_HAND_PICKED, MAX_RATIO_NAIVE = 4, 20
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
    "wall_s": ("wall time, median of interleaved repeats", "s"),
    "ratio": ("wall time over that of the automatic choice", "1"),
}


def scenes(elements, hurst, seed):
    """The scenes: one asperity, and a rough disc in region (b) alone and over a full curve with three accuracies.

    Returns tuples: name, indenter, accuracy required of the depth, contact fractions at the ends of the range of force.
    """
    asperity = reference.sphere(1.0).indenter(elements)
    disc = self_affine_disc(hurst, elements, seed=seed)
    few = 10 / disc.elements
    return [
        ("one asperity", asperity, 1e-3, 0.01, 0.5),
        ("region (b)", disc, 1e-3, few, max(0.02, 4 * few)),
        ("full curve", disc, 1e-3, few, 0.9),
        ("coarse question", disc, 3e-2, few, 0.9),
        ("fine question", disc, 1e-4, few, 0.9),
    ]


def compare_scenes(*, elements, hurst, seed, repeats):
    """The three choices of levels for every scene, on one thread; a pandas.DataFrame with the columns of `COLUMNS`."""
    with threadpool_limits(1):  # Snakemake gives the job all cores, so that no other job runs
        return pd.concat([compare(*scene, repeats) for scene in scenes(elements, hurst, seed)])


def compare(name, indenter, accuracy, first_fraction, last_fraction, repeats, *, hand_picked=HAND_PICKED, naive=NAIVE):
    """Cost and error of the three choices of levels for a scene.

    name, indenter, accuracy, first_fraction, last_fraction : as of `scenes`
    repeats : number of interleaved repeats, of which the times are medians
    hand_picked, naive : numbers of levels to try, increasing

    Returns a pandas.DataFrame with the columns of `COLUMNS`: one row per choice, "automatic", "best by hand" (absent if
    no number reaches the accuracy) and "naive".
    """
    coarse = indent(indenter, tolerance=1e-2, until_fraction=last_fraction)
    ends = np.interp([first_fraction, last_fraction], coarse.contact_fraction, coarse.depth)
    exact = indent(indenter, tolerance=REFERENCE_TOLERANCE, depths=np.geomspace(*ends, PROBES))
    path = partial(indent, indenter, tolerance=accuracy)
    # With the margin of levels by hand: the level of a contact fraction first reached at a force may lie beyond it.
    start = {"start_fraction": first_fraction * (1 - MARGIN)}
    automatic = _row("automatic", partial(path, **start, until_fraction=1, until_force=exact.force[-1]), exact)
    first, last = ends * [1 - MARGIN, 1 + MARGIN]

    logging.info("%s: levels by hand", name)
    for number in hand_picked:
        by_hand = _row("best by hand", partial(path, depths=np.geomspace(first, last, number)), exact)
        # More levels would cost more.
        if by_hand["error"] <= accuracy or number > MAX_RATIO_HAND_PICKED * automatic["levels"]:
            break
    logging.info("%s: naive levels", name)
    for number in naive:
        by_steps = _row("naive", partial(path, depths=np.linspace(0, last, number + 1)[1:]), exact)
        if by_steps["error"] <= automatic["error"] or by_steps["wall_s"] > MAX_RATIO_NAIVE * automatic["wall_s"]:
            break

    rows = [automatic, *([by_hand] if by_hand["error"] <= accuracy else []), by_steps]
    times = timing.interleaved({i: row["function"] for i, row in enumerate(rows)}, repeats)
    table = pd.DataFrame(rows).assign(scene=name, accuracy=accuracy, wall_s=[wall for wall, _ in times.values()])
    table = table.assign(ratio=table["wall_s"] / table["wall_s"][0], reached=(table["error"] <= accuracy).astype(int))
    return table[list(COLUMNS)]


def _row(choice, levels, exact):
    """Choice, function that computes its curve, number of levels, error and time."""
    curve, wall, _ = timing.timed(levels)
    depth, _ = curve.at_force(exact.force)
    error = np.nan_to_num(np.abs(depth / exact.depth - 1), nan=1.0).max()
    return {"choice": choice, "function": levels, "error": error, "levels": curve.depth.size, "wall_s": wall}
