"""Test the model of two springs in series by periodic contacts of the same spectra, which have no punch."""

from viscorough_study.comparisons.periodic_control import COLUMNS, periodic_control
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import write_table


def main(csv, **settings):
    """Write the table of the compliance of periodic surfaces.

    csv : file to write; settings : arguments of `periodic_control`
    """
    table = periodic_control(**settings)
    title = "The control of two springs"
    write_table(table, csv, columns=COLUMNS, title=title)


run_job(globals(), main)
