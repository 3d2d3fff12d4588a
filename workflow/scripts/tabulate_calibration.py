"""Select the fits that calibrate the penetration law of the package."""

from viscorough.law.calibrated_law import COLUMNS
from viscorough_study.fits.fit_table import calibrated
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import read_table, recorded, write_table


def main(scaling, sizes, csv, nc, **settings):
    """Write the table of calibrated exponents and prefactors.

    scaling, sizes : CSV files of the fits to all ensembles, and of the fits on grids from coarse to fine
    csv, nc : files to write; settings : further arguments of `calibrated`
    """
    table = calibrated(read_table(scaling), read_table(sizes), **settings)
    title = "Calibrated exponents and prefactors"
    attributes = recorded(settings=settings)
    write_table(table, csv, nc, columns=COLUMNS, dimension="fit", title=title, attributes=attributes)


run_job(globals(), main)
