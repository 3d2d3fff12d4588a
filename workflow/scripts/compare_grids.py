"""Compare the means of Eq. 1 on grids from coarse to fine."""

from viscorough.io.datasets import read_dataset
from viscorough_study.fits.grid_dependence import COLUMNS, grid_dependence
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import write_table


def main(discs, csv, **settings):
    """Write the table of all quantities on all grids.

    discs : file with all realizations of discs on grids from coarse to fine; csv : file to write
    settings : further arguments of `grid_dependence`
    """
    table = grid_dependence(read_dataset(discs), **settings)
    title = "Eq. 1 on grids from coarse to fine"
    write_table(table, csv, columns=COLUMNS, title=title)


run_job(globals(), main)
