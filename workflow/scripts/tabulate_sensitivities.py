"""Fit the power law of region (b) to the discs in every convention that the paper leaves open."""

from viscorough.io.datasets import read_dataset
from viscorough_study.fits.sensitivities import COLUMNS, sensitivities
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import write_table


def main(discs, variants, csv, **fit):
    """Write the table of sensitivities.

    discs, variants : files with all realizations of discs, and of discs of further conventions of the surfaces
    csv : file to write; fit : arguments of `sensitivities`: limits of region (b), resamples and seed of the bootstrap
    """
    table = sensitivities(*map(read_dataset, (discs, variants)), **fit)
    write_table(table, csv, columns=COLUMNS, title="Sensitivities to the conventions")


run_job(globals(), main)
