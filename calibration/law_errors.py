"""Test the calibrated law on discs that it has never seen.

    python calibration/law_errors.py --cores 2 --output results/law_errors.csv

The law is the law of the installed package. The discs have 129 and 257 elements across. They share no disc with those
to which the law was fitted and which determined its range. Without control variates, the table compares the law with
the means over these discs.

The script imports measuring.py from benchmarks/, which PYTHONPATH must name.
"""

from functools import partial
from multiprocessing import Pool

import click
import numpy as np
import pandas as pd
from law_calibration import FIT_LOW, X, complete_curve
from measuring import output_option, save_table
from tqdm import tqdm

from viscorough.law.calibrated_law import interface_depth, interface_velocity, penetration_law
from viscorough_study.run.seeds import law_disc_key, realization_seed

SEED = 2013
# Every second abscissa of the calibration, from the lowest X of any law. Beyond X = 13 the body sinks almost like a
# flat punch, and the scatter is below 5 %.
TESTED = X[(X >= FIT_LOW * (1 - 1e-9)) & (X <= 13)][::2]
ACROSS = (129, 257)
# Discs for --discs 100, {number of the first disc: {Hurst exponent: discs on the two grids}}. The coarse grid, which
# needs a quarter of the time, has more discs. The discs before number 2000 belong to the calibration of the law.
DISCS = {
    2000: dict.fromkeys((0.1, 0.25, 0.4, 0.55, 0.7, 0.85, 1.0), (120, 40)),
    3000: dict.fromkeys((0.1, 0.25, 0.5, 0.75, 0.9), (200, 100)),
}

COLUMNS = {
    "hurst": ("Hurst exponent H", "1"),
    "across": ("elements across the discs", "1"),
    "x": ("dimensionless force or time X", "1"),
    "discs": ("discs", "1"),
    "velocity_error": ("vt/h of the law over the mean of the discs, less 1", "1"),
    "velocity_standard_error": ("relative standard error of this mean", "1"),
    "interface_error": ("g of the law over the mean of the discs, less 1; empty if the mean is 0", "1"),
    "interface_standard_error": ("relative standard error of this mean; empty if the mean is 0", "1"),
    "depth_error": ("u/h of the law over the mean of the discs, less 1", "1"),
    "depth_standard_error": ("relative standard error of this mean", "1"),
}


def disc(hurst, across, number):
    """Return g and the interface's part of u/h of a disc at `TESTED`, shape (2, abscissae)."""
    return complete_curve(hurst, across, realization_seed(SEED, *law_disc_key(hurst, across, number)), TESTED)[0]


def errors(hurst, across, parts):
    """Return rows of `COLUMNS` for discs of one Hurst exponent and grid, within the range of the law.

    parts : g and the interface's part of u/h of all discs at `TESTED`, shape (discs, 2, abscissae)
    """
    law = penetration_law(hurst)
    inside = (law.x_low * (1 - 1e-9) <= TESTED) & (law.x_high * (1 + 1e-9) >= TESTED)
    x, parts = TESTED[inside], parts[:, :, inside]
    interface, depth = interface_velocity(x, *law.constants), x + interface_depth(x, *law.constants)
    table = pd.DataFrame({"hurst": hurst, "across": across, "x": x, "discs": len(parts)})
    samples = {"velocity": x + parts[:, 0], "interface": parts[:, 0], "depth": x + parts[:, 1]}
    for (name, values), expected in zip(samples.items(), (x + interface, interface, depth), strict=True):
        mean = np.where(values.mean(axis=0) > 0, values.mean(axis=0), np.nan)
        table[f"{name}_error"] = expected / mean - 1
        table[f"{name}_standard_error"] = values.std(axis=0, ddof=1) / np.sqrt(len(values)) / mean
    return table[list(COLUMNS)]


def numbers_of_discs(percent):
    """Return {(hurst, across): numbers of the discs}, for a percentage of the discs in `DISCS`."""
    numbers = {}
    for first, counts in DISCS.items():
        for hurst, on_grids in counts.items():
            for across, count in zip(ACROSS, on_grids, strict=True):
                numbers.setdefault((hurst, across), []).extend(range(first, first + count * percent // 100))
    return dict(sorted(numbers.items()))


@click.command(help=__doc__.splitlines()[0])
@click.option(
    "--discs",
    type=click.IntRange(5),
    default=100,
    show_default=True,
    help="Discs, in per cent of those of the published table.",
)
@click.option("--cores", type=click.IntRange(1), default=1, show_default=True, help="Processes.")
@output_option
def main(discs, cores, output):
    tables = []
    with Pool(cores) as pool:
        for (hurst, across), numbers in numbers_of_discs(discs).items():
            done = pool.imap(partial(disc, hurst, across), numbers, chunksize=5)
            progress = tqdm(done, f"H = {hurst:g}, {across}", len(numbers), mininterval=2)
            tables.append(errors(hurst, across, np.array(list(progress))))
    save_table(pd.concat(tables), output)


if __name__ == "__main__":
    main()
