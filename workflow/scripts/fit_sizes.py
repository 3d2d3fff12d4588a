"""Fit the power law vt/h = X^β/ζ on grids from coarse to fine, in region (b) and in windows of fixed X."""

from viscorough.io.datasets import read_dataset
from viscorough_study.fits.fit_table import SIZES, sizes_table
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import write_table


def main(discs, lines, csv, **fit):
    """Write the table of the fits on all grids.

    discs, lines : files with all realizations of discs and of lines on grids from coarse to fine
    csv : file to write; fit : further arguments of `sizes_table`
    """
    table = sizes_table(read_dataset(discs), read_dataset(lines), **fit)
    title = "Exponents on grids from coarse to fine"
    write_table(table, csv, columns=SIZES, title=title)


run_job(globals(), main)
