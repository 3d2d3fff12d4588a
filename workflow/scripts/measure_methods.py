"""Measure the cost and the error of every method on bodies and rough discs."""

from viscorough_study.performance.measurement import COLUMNS, measure_problems
from viscorough_study.performance.timing import machine
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import write_table


def main(csv, **settings):
    """Write the table of the cost and error of every method, and record the machine.

    csv : file to write; settings : arguments of `measure_problems`
    """
    table = measure_problems(**settings)
    title = "Speed and accuracy"
    write_table(table, csv, columns=COLUMNS, title=title, machine=machine())


run_job(globals(), main)
