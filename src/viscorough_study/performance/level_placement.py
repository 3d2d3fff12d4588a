"""Placement of the levels of a loading curve: by `indent`, by hand, and naively, on the same scenes.

A scene is an indenter, a range of force, and the accuracy required of the depth at any force in it. Levels by hand are
in equal ratios of depth over exactly that range, which must be known beforehand; their number is the smallest that
reaches the accuracy. Naive levels are in equal steps of depth; their number is the smallest with an error no larger
than that of the automatic levels. The tolerance of every level is the required accuracy.
"""

import logging
from dataclasses import dataclass
from functools import partial

import numpy as np
import pandas as pd
from threadpoolctl import threadpool_limits

from viscorough import reference
from viscorough.contact.loading_path import indent
from viscorough.indenter import Indenter
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


@dataclass(frozen=True)
class Scene:
    """An indenter, the accuracy required of the depth, and the contact fractions at the ends of the range of force."""

    name: str
    indenter: Indenter
    accuracy: float
    first: float
    last: float


def scenes(elements, hurst, seed):
    """The scenes: one asperity, and a rough disc in region (b) alone and over a full curve with three accuracies."""
    asperity = reference.sphere(1.0).indenter(elements)
    disc = self_affine_disc(hurst, elements, seed=seed)
    few = 10 / disc.elements
    return [
        Scene("one asperity", asperity, 1e-3, 0.01, 0.5),
        Scene("region (b)", disc, 1e-3, few, max(0.02, 4 * few)),
        Scene("full curve", disc, 1e-3, few, 0.9),
        Scene("coarse question", disc, 3e-2, few, 0.9),
        Scene("fine question", disc, 1e-4, few, 0.9),
    ]


def compare_scenes(*, elements, hurst, seed, repeats):
    """The three choices of levels for every scene, on one thread; a pandas.DataFrame with the columns of `COLUMNS`."""
    with threadpool_limits(1):  # Snakemake gives the job all cores, so that no other job runs
        return pd.concat([compare(scene, repeats) for scene in scenes(elements, hurst, seed)])


def compare(scene, repeats, *, hand_picked=HAND_PICKED, naive=NAIVE):
    """Cost and error of the three choices of levels for a scene.

    repeats : number of interleaved repeats, of which the times are medians
    hand_picked, naive : numbers of levels to try, increasing

    Returns a pandas.DataFrame with the columns of `COLUMNS`: one row per choice, "automatic", "best by hand" (absent if
    no number reaches the accuracy) and "naive".
    """
    coarse = indent(scene.indenter, tolerance=1e-2, until_fraction=scene.last)
    ends = np.interp([scene.first, scene.last], coarse.contact_fraction, coarse.depth)
    exact = indent(scene.indenter, tolerance=REFERENCE_TOLERANCE, depths=np.geomspace(*ends, PROBES))
    path = partial(indent, scene.indenter, tolerance=scene.accuracy)
    # With the margin of levels by hand: the level of a contact fraction first reached at a force may lie beyond it.
    range_of_force = {"start_fraction": scene.first * (1 - MARGIN), "until_fraction": 1, "until_force": exact.force[-1]}
    automatic = _row(scene, "automatic", partial(path, **range_of_force), exact)
    first, last = ends * [1 - MARGIN, 1 + MARGIN]

    logging.info("%s: levels by hand", scene.name)
    by_hand = []
    for number in hand_picked:
        row = _row(scene, "best by hand", partial(path, depths=np.geomspace(first, last, number)), exact)
        if row["reached"]:
            by_hand.append(row)
        if row["reached"] or number > MAX_RATIO_HAND_PICKED * automatic["levels"]:  # more levels would cost more
            break
    logging.info("%s: naive levels", scene.name)
    for number in naive:
        row = _row(scene, "naive", partial(path, depths=np.linspace(0, last, number + 1)[1:]), exact)
        if row["error"] <= automatic["error"] or row["wall_s"] > MAX_RATIO_NAIVE * automatic["wall_s"]:
            break

    rows = [automatic, *by_hand, row]
    functions = {i: row.pop("function") for i, row in enumerate(rows)}
    for i, (wall, _) in timing.interleaved(functions, repeats).items():
        rows[i]["wall_s"] = wall
        rows[i]["ratio"] = wall / rows[0]["wall_s"]
    return pd.DataFrame(rows, columns=list(COLUMNS))


def _row(scene, choice, levels, exact):
    curve, wall, _ = timing.timed(levels)
    depth, _ = curve.at_force(exact.force)
    error = np.nan_to_num(np.abs(depth / exact.depth - 1), nan=1.0).max()
    return {
        "scene": scene.name,
        "choice": choice,
        "accuracy": scene.accuracy,
        "error": error,
        "reached": int(error <= scene.accuracy),
        "levels": curve.depth.size,
        "wall_s": wall,
        "function": levels,
    }
