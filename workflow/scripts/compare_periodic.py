"""Test the model of two springs in series by periodic contacts of the same spectra, which have no punch."""

from viscorough_study.comparisons.periodic_control import COLUMNS, periodic_control
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import recorded, write_table


def main(csv, nc, **settings):
    """Write the table of the compliance of periodic surfaces.

    csv, nc : files to write; settings : arguments of `periodic_control`
    """
    table = periodic_control(**settings)
    title = "The control of two springs"
    attributes = recorded(settings=settings)
    write_table(table, csv, nc, columns=COLUMNS, dimension="level", title=title, attributes=attributes)


run_job(globals(), main)
