"""Solve every stress test with every method, and judge the results."""

from viscorough_study.robustness.failure_map import COLUMNS, map_failures
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import write_table


def main(csv, **settings):
    """Write the table of the verdicts on every method in every test.

    csv : file to write; settings : arguments of `map_failures`
    """
    table = map_failures(**settings)
    title = "Every method in every stress test"
    write_table(table, csv, columns=COLUMNS, title=title)


run_job(globals(), main)
