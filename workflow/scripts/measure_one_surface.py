"""Measure the cost and the error of every model of one surface."""

from viscorough_study.performance.one_surface import COLUMNS, measure_one_surface
from viscorough_study.performance.timing import machine
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import write_table


def main(csv, **settings):
    """Write the table of the cost and error of every model, and record the machine.

    csv : file to write; settings : arguments of `measure_one_surface`
    """
    table = measure_one_surface(**settings)
    title = "Models of one surface"
    write_table(table, csv, columns=COLUMNS, title=title, machine=machine())


run_job(globals(), main)
