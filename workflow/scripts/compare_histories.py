"""Compare histories of loading and unloading, computed by a row of springs, with direct integration in time."""

from viscorough_study.comparisons.histories import COLUMNS, compare_histories
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import write_table


def main(csv, **settings):
    """Write the table of both motions of every disc.

    csv : file to write; settings : arguments of `compare_histories`
    """
    table = compare_histories(**settings)
    write_table(table, csv, columns=COLUMNS, title="Any history")


run_job(globals(), main)
