"""Measure the cost and the error of every model of one surface."""

from viscorough_study.performance.one_surface import COLUMNS, measure_surfaces
from viscorough_study.performance.timing import machine
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import recorded, write_table


def main(csv, nc, **settings):
    """Write the table of the cost and error of every model, and record the machine.

    csv, nc : files to write; settings : arguments of `measure_surfaces`
    """
    table = measure_surfaces(**settings)
    title = "Models of one surface"
    attributes = recorded(settings=settings, machine=machine())
    write_table(table, csv, nc, columns=COLUMNS, dimension="measurement", title=title, attributes=attributes)


run_job(globals(), main)
