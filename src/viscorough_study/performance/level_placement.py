"""Compare three ways to place the levels of a loading curve, the depths at which contacts are computed.

The three ways (placements) are tested with several indenters. An indenter and a range of force are called a scene here.
The depth at any force in the range is required, with several accuracies. The placements are:

- automatic: `indent` chooses the levels.
- by hand: the ratio of successive depths is constant. The levels cover exactly the range, which must be known
  beforehand.
- naive: the levels are in equal steps of depth from zero to the end of the range.

For levels by hand and naive levels, the smallest sufficient number of levels is found by trials, whose time does not
count. The tolerance of every contact is the required accuracy.
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
# Do not try more levels if the time already exceeds the time of automatic levels by more than this factor.
LONGEST = 10.0
# Levels extend beyond the ends of the range of depth by this share, because these ends are known only to the tolerance.
MARGIN = 0.01
PROBES = 60  # number of forces at which depths are compared
REFERENCE_TOLERANCE = 1e-9  # tolerance of the reference depths
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
    """Return three scenes: a sphere, a rough disc in region (b), and the same disc up to a contact fraction of 0.9.

    A scene is an indenter with a range of force. It is given as a tuple: name, indenter, and the contact fractions at
    the lower and the upper end of the range.
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
    """Compare the three placements of levels on every scene; return a pandas.DataFrame with the columns of `COLUMNS`.

    elements, hurst, seed : arguments of `scenes`
    repeats : times are medians over this number of interleaved repeats
    """
    # Use one thread. Snakemake gives the job all cores, so that no other job disturbs the timing.
    with threadpool_limits(1):
        return pd.concat([compare(*scene, repeats) for scene in scenes(elements, hurst, seed)])


def compare(name, indenter, first_fraction, last_fraction, repeats, *, accuracies=ACCURACIES, numbers=NUMBERS):
    """Compare cost and error of the three placements of levels on one scene.

    name, indenter, first_fraction, last_fraction : a scene, as returned by `scenes`
    repeats : times are medians over this number of interleaved repeats
    accuracies : required accuracies of the depth, from loose to fine; numbers : numbers of levels to try, increasing

    Returns a pandas.DataFrame with the columns of `COLUMNS`: one row per placement and accuracy.
    """
    coarse = indent(indenter, tolerance=1e-2, until_fraction=last_fraction)
    ends = np.interp([first_fraction, last_fraction], coarse.contact_fraction, coarse.depth)
    exact = indent(indenter, tolerance=REFERENCE_TOLERANCE, depths=np.geomspace(*ends, PROBES))
    first, last = ends * [1 - MARGIN, 1 + MARGIN]
    depths = {
        BY_HAND: lambda number: np.geomspace(first, last, number),
        NAIVE: lambda number: np.linspace(0, last, number + 1)[1:],
    }
    # Begin slightly below the first contact fraction of the range, with the same margin as levels by hand. Otherwise
    # the first level may lie above the smallest force of the range.
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
            fewest[choice] = number  # a finer accuracy needs at least this many levels
            rows.append(row)
    times = timing.interleaved({i: row["function"] for i, row in enumerate(rows)}, repeats)
    table = pd.DataFrame(rows).assign(scene=name, processor_s=[seconds for _, seconds in times.values()])
    return table[list(COLUMNS)]


def _row(choice, accuracy, levels, exact):
    """Compute a loading curve, and return a table row as a dict: placement, accuracy, error, number of levels, time.

    The row also contains the function that computes the curve.
    choice : placement of the levels; accuracy : required accuracy of the depth
    levels : function that computes the curve; exact : curve with the reference depths
    """
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
