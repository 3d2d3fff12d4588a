"""Measure over how many decades the slope of vt/h is constant, for the discs and for a control without a power law."""

from viscorough.io.datasets import read_dataset
from viscorough_study.fits.plateau import COLUMNS, plateau_table
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import write_table


def main(discs, csv, **settings):
    """Write the table of the decades of constant slope.

    discs : file with all realizations of the discs; csv : file to write
    settings : further arguments of `plateau_table`
    """
    table = plateau_table(read_dataset(discs), **settings)
    title = "Decades of constant slope, and the control"
    write_table(table, csv, columns=COLUMNS, title=title)


run_job(globals(), main)
