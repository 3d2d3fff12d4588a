"""Compare histories of loading and unloading, computed by a row of springs, with direct integration in time."""

from viscorough_study.comparisons.histories import COLUMNS, compare_histories
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import recorded, write_table


def main(csv, nc, **settings):
    """Write the table of both motions of every disc.

    csv, nc : files to write; settings : arguments of `compare_histories`
    """
    table = compare_histories(**settings)
    attributes = recorded(settings=settings)
    write_table(table, csv, nc, columns=COLUMNS, dimension="point", title="Any history", attributes=attributes)


run_job(globals(), main)
