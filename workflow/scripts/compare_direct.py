"""Compare direct integration in time with the elastic depth, and thereby with both readings of the paper's law."""

from viscorough_study.comparisons.direct_integration import COLUMNS, compare_direct
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import write_table


def main(csv, **settings):
    """Write the table of depths by direct integration over elastic depths.

    csv : file to write; settings : arguments of `compare_direct`
    """
    table = compare_direct(**settings)
    title = "Direct integration and both readings of the law"
    write_table(table, csv, columns=COLUMNS, title=title)


run_job(globals(), main)
