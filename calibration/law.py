"""Calibrate the penetration law on curves of discs to complete contact, and test it on other discs.

    python calibration/law.py --cores 2 --output results/tables/law.csv

For every Hurst exponent and grid, the law is fitted to some discs and tested on the same number of other discs, which
were drawn after its form had been chosen. The table has the columns of law_calibration.COLUMNS.

The script imports measuring.py from benchmarks/, which PYTHONPATH must name.
"""

from functools import partial
from multiprocessing import Pool

import click
import numpy as np
import pandas as pd
from law_calibration import COLUMNS, calibrate, complete_curve
from measuring import output_option, save_table
from tqdm import tqdm

from viscorough_study.run.seeds import law_disc_key, realization_seed

HURST, ACROSS, SEED, RESAMPLES = (0.1, 0.4, 0.6, 0.9, 1.0), (257, 129), 2013, 200
FIRST_OTHER = 1000  # number of the first disc for the test; earlier discs were seen when the form was chosen


def disc(hurst, across, number):
    """Return the curve of one disc, and its control variates."""
    return complete_curve(hurst, across, realization_seed(SEED, *law_disc_key(hurst, across, number)))


@click.command(help=__doc__.splitlines()[0])
@click.option("--discs", type=click.IntRange(2), default=150, show_default=True, help="Discs to fit, and to test.")
@click.option("--cores", type=click.IntRange(1), default=1, show_default=True, help="Processes.")
@output_option
def main(discs, cores, output):
    rows = []
    with Pool(cores) as pool:
        for across in ACROSS:
            for hurst in HURST:
                numbers = [*range(discs), *range(FIRST_OTHER, FIRST_OTHER + discs)]
                done = pool.imap(partial(disc, hurst, across), numbers, chunksize=5)
                parts, controls = zip(*tqdm(done, f"H = {hurst:g}, {across}", 2 * discs, mininterval=2), strict=True)
                parts, controls = np.array(parts), np.array(controls)
                fitted, unused = ((parts[half], controls[half]) for half in (slice(discs), slice(discs, None)))
                row = calibrate(fitted, unused, across, resamples=RESAMPLES, seed=SEED)
                rows.append({"hurst": hurst, "across": across} | row)
    save_table(pd.DataFrame(rows, columns=list(COLUMNS)), output)


if __name__ == "__main__":
    main()
