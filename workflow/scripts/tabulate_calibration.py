"""Select the fits that calibrate the penetration law of the package."""

from viscorough.law.calibrated_law import COLUMNS
from viscorough_study.fits.fit_table import calibrated
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import read_table, write_table


def main(scaling, sizes, csv, **settings):
    """Write the table of calibrated exponents and prefactors.

    scaling, sizes : CSV files of the fits to all ensembles, and of the fits on grids from coarse to fine
    csv : file to write; settings : further arguments of `calibrated`
    """
    table = calibrated(read_table(scaling), read_table(sizes), **settings)
    title = "Calibrated exponents and prefactors"
    write_table(table, csv, columns=COLUMNS, title=title)


run_job(globals(), main)
