"""Measure the cost and the error of every method on bodies and rough discs."""

from viscorough_study.performance.measurement import COLUMNS, measure_problems
from viscorough_study.performance.timing import machine
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import recorded, write_table


def main(csv, nc, **settings):
    """Write the table of the cost and error of every method, and record the machine.

    csv, nc : files to write; settings : arguments of `measure_problems`
    """
    table = measure_problems(**settings)
    title = "Speed and accuracy"
    attributes = recorded(settings=settings, machine=machine())
    write_table(table, csv, nc, columns=COLUMNS, dimension="measurement", title=title, attributes=attributes)


run_job(globals(), main)
