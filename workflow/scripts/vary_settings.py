"""Measure the error over the number of time steps, over the width of the box, and over X with the power law alone."""

from viscorough.io.datasets import read_dataset
from viscorough_study.robustness.knobs import COLUMNS, failure_knobs
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import read_table, write_table


def main(discs, scaling, csv, **settings):
    """Write the table of errors over the three settings.

    discs : file with all realizations of the discs; scaling : CSV file of the fits to all ensembles
    csv : file to write; settings : further arguments of `failure_knobs`
    """
    table = failure_knobs(read_dataset(discs), read_table(scaling), **settings)
    title = "Errors over settings that decide"
    write_table(table, csv, columns=COLUMNS, title=title)


run_job(globals(), main)
