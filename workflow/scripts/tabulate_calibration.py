"""Select the fits that calibrate the penetration law of the package."""

from viscorough.io.datasets import read_dataset
from viscorough.law.calibrated_law import COLUMNS
from viscorough_study.fits.fit_table import calibrated
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import read_table, write_table


def main(scaling, law, csv, **settings):
    """Write the table of calibrated exponents and prefactors.

    scaling : CSV file of the fits; law : file with all realizations of discs of further Hurst exponents
    csv : file to write; settings : further arguments of `calibrated`
    """
    table = calibrated(read_table(scaling), read_dataset(law), **settings)
    title = "Calibrated exponents and prefactors"
    write_table(table, csv, columns=COLUMNS, title=title)


run_job(globals(), main)
