"""Test the calibrated law on discs that it has never seen, and calibrate the interval of a single surface.

    python calibration/law_errors.py --cores 2 --output results/law_errors.csv --scatter results/law_scatter.csv

The law is the law of the installed package. Two samples of discs are drawn, on 129 and on 257 elements across. They
share no disc with each other, nor with the discs to which the law was fitted and which determined its range.

1. From the first sample, calibrate the interval in which 95 % of single surfaces lie (law_scatter).
2. On the second sample, count the discs that lie in this interval.
3. On both samples, measure the error of the law for the mean of many discs, without control variates.

The script imports measuring.py from benchmarks/, which PYTHONPATH must name.
"""

from functools import partial
from multiprocessing import Pool
from pathlib import Path

import click
import numpy as np
import pandas as pd
from law_calibration import FIT_LOW, X, complete_curve
from law_scatter import calibrated_scatter, law_at
from measuring import output_option, save_table
from tqdm import tqdm

from viscorough.law.calibrated_law import penetration_law, relative_interval
from viscorough_study.run.seeds import law_disc_key, realization_seed

SEED = 2013
# Every second abscissa of the calibration, from the lowest X of any law to the highest.
ABSCISSAE = X[(X >= FIT_LOW * (1 - 1e-9)) & (X <= 10**2.4)][::2]
# Test the law up to this X. Beyond it the body sinks almost like a flat punch, and the scatter is below 5 %.
TESTED = ABSCISSAE[ABSCISSAE <= 13]
ACROSS = (129, 257)
# Numbers of the first disc of each sample; the discs before number 2000 belong to the calibration of the law.
FIRST_SCATTER, FIRST_TEST = 2000, 3000
# {Hurst exponent: discs on the two grids}, for --discs 100: more on the coarse grid, which needs a quarter of the time.
SCATTER = dict.fromkeys((0.1, 0.25, 0.4, 0.55, 0.7, 0.85, 1.0), (120, 40))
TEST = dict.fromkeys((0.1, 0.25, 0.5, 0.75, 0.9), (200, 100))

COLUMNS = {
    "hurst": ("Hurst exponent H", "1"),
    "across": ("elements across the discs", "1"),
    "x": ("dimensionless force or time X", "1"),
    "discs": ("discs of both samples, for the errors", "1"),
    "velocity_error": ("vt/h of the law over the mean of the discs, less 1", "1"),
    "velocity_standard_error": ("relative standard error of this mean", "1"),
    "interface_error": ("g of the law over the mean of the discs, less 1; empty if the mean is 0", "1"),
    "interface_standard_error": ("relative standard error of this mean; empty if the mean is 0", "1"),
    "depth_error": ("u/h of the law over the mean of the discs, less 1", "1"),
    "depth_standard_error": ("relative standard error of this mean", "1"),
    "tested": ("discs of the second sample, for the coverage", "1"),
    "velocity_coverage": ("share of these with vt/h in the interval of a single surface, nominally 0.95", "1"),
    "depth_coverage": ("share of these with u/h in the interval of a single surface, nominally 0.95", "1"),
}


def disc(hurst, across, x, number):
    """Return g and the interface's part of u/h of a disc at the abscissae x, shape (2, abscissae)."""
    return complete_curve(hurst, across, realization_seed(SEED, *law_disc_key(hurst, across, number)), x)[0]


def errors(hurst, across, parts, tested, scatter):
    """Return rows of `COLUMNS` for discs of one Hurst exponent and grid, within the range of the law.

    parts, tested : parts of all discs, and of the discs for the coverage, at `TESTED`, shape (discs, 2, abscissae)
    scatter : table of law_scatter
    """
    law = penetration_law(hurst)
    inside = (law.x_low * (1 - 1e-9) <= TESTED) & (law.x_high * (1 + 1e-9) >= TESTED)
    x, parts, tested = TESTED[inside], parts[:, :, inside], tested[:, :, inside]
    velocity, depth = law_at(hurst, x)
    table = pd.DataFrame({"hurst": hurst, "across": across, "x": x, "discs": len(parts), "tested": len(tested)})
    samples = {"velocity": x + parts[:, 0], "interface": parts[:, 0], "depth": x + parts[:, 1]}
    for (name, values), expected in zip(samples.items(), (velocity, velocity - x, depth), strict=True):
        mean = np.where(values.mean(axis=0) > 0, values.mean(axis=0), np.nan)
        table[f"{name}_error"] = expected / mean - 1
        table[f"{name}_standard_error"] = values.std(axis=0, ddof=1) / np.sqrt(len(values)) / mean
    for i, (name, expected) in enumerate((("velocity", velocity), ("depth", depth))):
        low, high = expected * relative_interval(scatter, name, hurst, x)
        within = (low <= x + tested[:, i]) & (x + tested[:, i] <= high)
        table[f"{name}_coverage"] = within.mean(axis=0) if len(tested) else np.nan
    return table[list(COLUMNS)]


def all_errors(fitted, tested, scatter):
    """Return a table with `COLUMNS`, for all Hurst exponents and grids of two samples.

    fitted, tested : {(hurst, across): parts, shape (discs, 2, abscissae)}, at `ABSCISSAE` and at `TESTED`
    scatter : table of law_scatter
    """
    none = np.empty((0, 2, TESTED.size))
    tables = []
    for case in sorted({*fitted, *tested}):
        fresh = tested.get(case, none)
        parts = np.concatenate([fitted.get(case, none)[:, :, : TESTED.size], fresh])
        tables.append(errors(*case, parts, fresh, scatter))
    return pd.concat(tables)


@click.command(help=__doc__.splitlines()[0])
@click.option(
    "--discs",
    type=click.IntRange(5),
    default=100,
    show_default=True,
    help="Discs of 257 elements across of the second sample, for each H; all others in proportion.",
)
@click.option("--cores", type=click.IntRange(1), default=1, show_default=True, help="Processes.")
@click.option("--scatter", type=click.Path(path_type=Path), required=True, help="File to write the intervals to.")
@output_option
def main(discs, cores, scatter, output):
    with Pool(cores) as pool:

        def samples(first, counts, x):
            """Yield (hurst, across) and the discs of a sample."""
            for hurst, numbers in counts.items():
                for across, number in zip(ACROSS, numbers, strict=True):
                    drawn = range(first, first + number * discs // 100)
                    done = pool.imap(partial(disc, hurst, across, x), drawn, chunksize=5)
                    progress = tqdm(done, f"H = {hurst:g}, {across}", len(drawn), mininterval=2)
                    yield (hurst, across), np.array(list(progress))

        fitted = dict(samples(FIRST_SCATTER, SCATTER, ABSCISSAE))
        intervals = calibrated_scatter(fitted, ABSCISSAE)
        save_table(intervals, scatter)
        tested = dict(samples(FIRST_TEST, TEST, TESTED))
    save_table(all_errors(fitted, tested, intervals), output)


if __name__ == "__main__":
    main()
