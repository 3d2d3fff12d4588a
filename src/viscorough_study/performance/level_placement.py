"""Model no more than a scene needs: the levels that `indent` chooses, beside the best hand-picked and naive ones.

A scene is an indenter, a range of force, and the accuracy wanted of the depth at any force in it. Hand-picked levels
stand in equal ratios of depth over exactly that range, which has to be known beforehand; their number and the
tolerance are the ones that reach the accuracy at least cost. Naive levels stand in equal steps of depth, as many as
make their error that of the levels chosen automatically.
"""

import time
from dataclasses import dataclass
from functools import partial

import numpy as np
import pandas as pd

from viscorough import reference
from viscorough.contact.loading_path import indent
from viscorough.indenter import Indenter
from viscorough.surfaces import self_affine_disc
from viscorough_study.performance import timing

NUMBERS = (3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256, 384, 512)  # of hand-picked levels
LOOSER = (1,)
NAIVE = tuple(2**n for n in range(2, 13))
BEST, WORST = 4, 20  # times the automatic choice's cost, beyond which levels by hand, and naive ones, are not pursued
MARGIN = 0.01  # by which levels reach beyond the range, whose ends they know only to their tolerance
PROBES = 60  # forces at which the depth is compared
COLUMNS = {
    "scene": ("scene", ""),
    "choice": ("who chose the levels", ""),
    "accuracy": ("relative accuracy of depth asked for", "1"),
    "error": ("largest relative error of the depth at any force of the range", "1"),
    "reached": ("1 if that is within the accuracy", "1"),
    "levels": ("levels", "1"),
    "tolerance": ("tolerance of each level", "1"),
    "operator_applications": ("applications of the half-space operator on the grid", "1"),
    "wall_s": ("wall time, median of interleaved repeats", "s"),
    "ratio": ("wall time over that of the automatic choice", "1"),
}


@dataclass(frozen=True)
class Scene:
    """An indenter, accuracy, and the range of force as contact fractions at its ends."""

    name: str
    indenter: Indenter
    accuracy: float
    first: float
    last: float


def scenes(elements, hurst, seed):
    """One asperity, region (b) alone, a full curve, and a coarse and a fine question about it."""
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


def compare(scene, repeats, report=lambda text: None):
    """Cost and error of the three choices of levels for a scene; a pandas.DataFrame with the columns of `COLUMNS`."""
    coarse = indent(scene.indenter, tolerance=1e-2, until_fraction=scene.last)
    ends = np.interp([scene.first, scene.last], coarse.contact_fraction, coarse.depth)
    probes = np.geomspace(*ends, PROBES)
    exact = indent(scene.indenter, tolerance=1e-9, depths=probes)
    end = exact.force[-1]
    report(f"{scene.name}: levels by hand")

    automatic = partial(
        indent, scene.indenter, tolerance=scene.accuracy, start_fraction=scene.first, until_fraction=1, until_force=end
    )
    rows = [_row(scene, "automatic", automatic, scene.accuracy, exact)]
    by_hand, by_hand_ends = [], ends * [1 - MARGIN, 1 + MARGIN]
    for tolerance in (min(0.1, scene.accuracy * looser) for looser in LOOSER):
        for number in NUMBERS:
            depths = np.geomspace(*by_hand_ends, number)
            levels = partial(indent, scene.indenter, tolerance=tolerance, depths=depths)
            row = _row(scene, "best by hand", levels, tolerance, exact)
            if row["reached"]:
                by_hand.append(row)
            if row["reached"] or row["wall_s"] > BEST * rows[0]["wall_s"]:  # more levels only cost more
                break
    report(f"{scene.name}: naive levels")
    for number in NAIVE:
        depths = np.linspace(0, by_hand_ends[1], number + 1)[1:]
        naive = _row(
            scene,
            "naive",
            partial(indent, scene.indenter, tolerance=scene.accuracy, depths=depths),
            scene.accuracy,
            exact,
        )
        if naive["error"] <= rows[0]["error"] or naive["wall_s"] > WORST * rows[0]["wall_s"]:
            break
    candidates = [*rows, *by_hand, naive]
    functions = {i: row.pop("function") for i, row in enumerate(candidates)}
    for i, (wall, _) in timing.interleaved(functions, repeats).items():
        candidates[i]["wall_s"] = wall
    if by_hand:
        rows.append(min(by_hand, key=lambda row: row["wall_s"]))
    rows.append(naive)
    for row in rows:
        row["ratio"] = row["wall_s"] / rows[0]["wall_s"]
    return pd.DataFrame(rows, columns=list(COLUMNS))


def _row(scene, choice, levels, tolerance, exact):
    started = time.perf_counter()
    curve = levels()
    wall = time.perf_counter() - started
    depth, _ = curve.at_force(exact.force)
    error = np.nan_to_num(np.abs(depth / exact.depth - 1), nan=1.0).max()
    return {
        "scene": scene.name,
        "choice": choice,
        "accuracy": scene.accuracy,
        "error": error,
        "reached": int(error <= scene.accuracy),
        "levels": curve.depth.size,
        "tolerance": tolerance,
        "operator_applications": curve.operator_applications,
        "wall_s": wall,
        "function": levels,
    }
