"""Measure how often the stated error of the grid covers the true error.

    python calibration/grid_errors.py --surfaces 200 --cores 2 --output build/grid_coverage.csv

The true error is the deviation from the same map sampled four times finer. It is compared with the stated error at
given X = F/(4GhL), as root mean squares over half a decade of force to either side, and over all forces from X = 0.01
on. Maps are discs with odd and even numbers of elements across, discs with holes, and discs of rectangular elements.
The safety factors of viscorough.contact.grid_error were calibrated on the sample "calibration"; the sample "test" has
different surfaces.

The script imports measuring.py from benchmarks/, which PYTHONPATH must name.
"""

import time
from functools import partial
from multiprocessing import Pool

import click
import numpy as np
import pandas as pd
from measuring import output_option, run_timed, save_table
from tqdm import tqdm

from viscorough import Indenter, indent
from viscorough.surfaces.self_affine import cut_disc, self_affine_square

SEED = 20130513
SAMPLES = ("calibration", "test")
HURST = tuple(round(0.1 * tenth, 1) for tenth in range(1, 11))
ACROSS = (65, 129, 257, 513)
KINDS = ("odd", "even", "holes", "rectangles")
FINER = 4
X = (0.01, 0.03, 0.1, 0.3, 1.0, 3.0)
# Points per decade of force in comparisons of curves.
PER_DECADE = 100
HALF_WINDOW = np.log(10) / 2
# Share of the disc in holes, and their diameter over the diameter of the disc.
SHARE_OF_HOLES, HOLE = 0.1, 0.1


# ---- maps


def fine_disc(hurst, across, kind, seed):
    """Return a disc with height 1 and FINER times as many elements across as `sampled` returns.

    kind : of KINDS; elements of "rectangles" are twice as long as wide, with half as many rows
    """
    points = FINER * across if kind == "even" else FINER * (across - 1) + 1
    heights = cut_disc(self_affine_square(hurst, points, seed=seed), points)
    if kind == "holes":
        generator, position = np.random.default_rng(seed), np.arange(points)
        for _ in range(round(SHARE_OF_HOLES / HOLE**2)):
            row, column = points * generator.random(2)
            heights[(position[:, None] - row) ** 2 + (position - column) ** 2 < (HOLE * points / 2) ** 2] = np.nan
    heights /= np.nanstd(heights)
    if kind == "rectangles":
        return Indenter(heights[::2], (1.0, 2.0))
    return Indenter(heights, 1.0)


def sampled(indenter, step):
    """Return every so many-th point of a map."""
    spacings = step * indenter.spacing, step * indenter.row_spacing
    return Indenter(indenter.heights[::step, ::step], spacings)


def force_scale(indenter):
    """Return 4hL, the force F/G at X = 1."""
    area = indenter.elements * indenter.spacing * indenter.row_spacing
    return 4 * np.nanstd(indenter.heights) * np.sqrt(4 * area / np.pi)


def seed_of(sample, number):
    return np.random.SeedSequence(SEED, spawn_key=(SAMPLES.index(sample), number))


# ---- coverage of the stated error


def case(number, across):
    """Return (H, elements across, kind) of a surface: 40 successive numbers have all pairs of H and four sizes."""
    tens, kind = number // len(HURST), number + number // len(HURST) + number // (len(HURST) * len(across))
    return HURST[number % len(HURST)], across[tens % len(across)], KINDS[kind % len(KINDS)]


def coverage_of(sample, across, number):
    """Return rows of stated and true errors of a surface, for each X and for all forces (x = 0), and the cost."""
    hurst, size, kind = case(number, across)
    fine = fine_disc(hurst, size, kind, seed_of(sample, number))
    coarse = sampled(fine, FINER)
    scale = force_scale(coarse)
    curve, cost = _with_cost(coarse)
    truth = indent(fine, until_fraction=1.0, until_force=curve.force[-1])
    first, last = X[0], curve.force[-1] / scale
    x = np.geomspace(first / np.sqrt(10), last, int(PER_DECADE * np.log10(last / first * np.sqrt(10))))
    force = np.minimum(x * scale, curve.force[-1])
    force = force[force >= curve.force[0]]
    (depth, stiffness), (_, true_stiffness) = curve.at_force(force), _beyond(truth, force)
    velocity = np.log(true_stiffness / stiffness)
    missed = np.nanmax(fine.heights) - np.nanmax(coarse.heights)
    at_depth = np.interp(np.log(depth + missed), np.log(truth.depth), np.log(truth.force))
    lost = 1 - np.exp(at_depth) / force
    rows = []
    for center in (0.0, *X):
        chosen = abs(np.log(force / (center * scale))) <= HALF_WINDOW if center else force >= first * scale
        if not chosen.any() or center * scale > curve.force[-1]:
            continue
        where = np.log(max(center * scale, curve.force[0]))
        row = {"kind": kind, "hurst": hurst, "across": size, "number": number, "x": center}
        row["velocity_true"] = np.sqrt(np.mean(velocity[chosen] ** 2))
        row["force_true"] = np.sqrt(np.mean(lost[chosen] ** 2))
        stated = {"velocity_stated": curve.grid_error, "force_stated": curve.force_grid_error}
        row |= {name: np.interp(where, np.log(curve.force), values) for name, values in stated.items()}
        if not center:
            row |= {"velocity_stated": curve.mean_grid_error, "force_stated": np.nan, "force_true": np.nan}
        rows.append(row | {"cost": cost})
    return rows


def _with_cost(indenter):
    """Return the curve with its grid error, and the time of the estimate over the time of the curve."""
    times = []
    for _ in range(3):
        for estimate in (False, True):
            start = time.process_time()
            curve = indent(indenter, estimate_grid_error=estimate)
            times.append(time.process_time() - start)
    return curve, min(times[1::2]) / min(times[::2]) - 1


def _beyond(curve, force):
    """Return depth and stiffness at forces; beyond complete contact a curve is straight."""
    depth, stiffness = curve.at_force(np.clip(force, curve.force[0], curve.force[-1]))
    return depth + np.maximum(force - curve.force[-1], 0) / curve.stiffness[-1], stiffness


def summary_of_coverage(table):
    """Return the share of covered errors, and the median and 90 % quantile of stated over true errors, as a table."""
    parts = {"all": table, **{f"{name} {value}": rows for name in ("kind", "hurst", "across", "x")
                              for value, rows in table.groupby(name)}}  # fmt: skip
    lines = []
    for part, rows in parts.items():
        line = {"part": part, "surfaces": rows["number"].nunique(), "cost": rows["cost"].median()}
        for name in ("velocity", "force"):
            valid = rows[(rows["x"] > 0) | (part == "x 0.0")].dropna(subset=[f"{name}_true", f"{name}_stated"])
            ratio = valid[f"{name}_stated"] / valid[f"{name}_true"]
            line |= {f"{name} covered": (ratio >= 1).mean(), f"{name} median ratio": ratio.median()}
        lines.append(line)
    return pd.DataFrame(lines)


# ---- command


def measured(function, surfaces, first, cores):
    """Return a table of the rows that a function returns for each number of a surface."""
    numbers = range(first, first + surfaces)
    with Pool(cores) as pool:
        done = tqdm(pool.imap(function, numbers), "surfaces", len(numbers), mininterval=10)
        return pd.DataFrame([row for rows in done for row in rows])


@click.command(help=__doc__.splitlines()[0])
@click.option("--surfaces", type=click.IntRange(1), default=40, show_default=True, help="Number of surfaces.")
@click.option("--first", type=click.IntRange(0), default=0, show_default=True, help="Number of the first surface.")
@click.option("--sample", type=click.Choice(SAMPLES), default="test", show_default=True, help="Set of seeds.")
@click.option("--cores", type=click.IntRange(1), default=1, show_default=True, help="Processes.")
@click.option("--across", type=int, multiple=True, default=ACROSS, show_default=True, help="Elements across.")
@output_option
def main(surfaces, first, sample, cores, across, output):
    table = measured(partial(coverage_of, sample, across), surfaces, first, cores)
    click.echo(summary_of_coverage(table).to_string(index=False, float_format=lambda number: f"{number:.3g}"))
    save_table(table, output)


if __name__ == "__main__":
    run_timed(main)
