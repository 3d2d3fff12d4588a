"""Fit the power law vt/h = X^β/ζ of region (b) to every ensemble of discs and of lines.

Also find the factor λ in the spectrum C1D = λ q C2D of a line (Eq. 13) with which lines have the velocity of the discs.
"""

from viscorough.io.datasets import read_dataset
from viscorough_study.fits.fit_table import COLUMNS, scaling_table
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import write_table


def main(discs, lines, csv, **fit):
    """Fit the discs of both readings and the lines, and write the table of fits.

    discs, lines : files of the pools, the datasets of all realizations of discs and of lines
    csv : file to write
    fit : arguments of `scaling_table`: limits of region (b), resamples and seed of the bootstrap
    """
    table = scaling_table(read_dataset(discs), read_dataset(lines), **fit)
    write_table(table, csv, columns=COLUMNS, title="Power laws in region (b)")


run_job(globals(), main)
