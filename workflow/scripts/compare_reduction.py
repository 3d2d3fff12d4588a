"""Compare the method of dimensionality reduction with boundary elements, surface by surface."""

from viscorough_study.comparisons.mdr_comparison import COLUMNS, compare_reduction
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import recorded, write_table


def main(csv, nc, **settings):
    """Write the table of stiffness, contact, mean gap and force of lines over those of discs.

    csv, nc : files to write; settings : arguments of `compare_reduction`
    """
    table = compare_reduction(**settings)
    title = "MDR, surface by surface"
    attributes = recorded(settings=settings)
    write_table(table, csv, nc, columns=COLUMNS, dimension="point", title=title, attributes=attributes)


run_job(globals(), main)
