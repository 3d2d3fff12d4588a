"""Fit the exponents of small X on fine grids, and find the intervals of their limits."""

from viscorough.io.datasets import read_dataset
from viscorough_study.fits.fine_grids import EXPONENTS, fine_exponents
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import write_table


def main(curves, csv, **settings):
    """Write the table of exponents.

    curves : files with the curves of the same discs on several grids
    csv : file to write; settings : further arguments of `fine_exponents`
    """
    table = fine_exponents(map(read_dataset, curves), **settings)
    write_table(table, csv, columns=EXPONENTS, title="Local exponents on fine grids, and intervals of their limits")


run_job(globals(), main)
