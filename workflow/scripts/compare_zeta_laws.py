"""Compare the paper's laws of the prefactor ζ(H) with the fits to the discs, all by one measure."""

from viscorough.io.datasets import read_dataset
from viscorough_study.fits.zeta_laws import COLUMNS, zeta_laws_of_pool
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import write_table


def main(discs, csv, **settings):
    """Write the table of the laws of the prefactor.

    discs : file with all realizations of the discs; csv : file to write
    settings : further arguments of `zeta_laws_of_pool`
    """
    table = zeta_laws_of_pool(read_dataset(discs), **settings)
    title = "Laws of the prefactor"
    write_table(table, csv, columns=COLUMNS, title=title)


run_job(globals(), main)
