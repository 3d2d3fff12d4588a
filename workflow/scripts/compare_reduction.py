"""Compare the method of dimensionality reduction with boundary elements, surface by surface."""

from viscorough_study.comparisons.mdr_comparison import COLUMNS, compare_reduction
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import write_table


def main(csv, **settings):
    """Write the table of stiffness, contact, mean gap and force of lines over those of discs.

    csv : file to write; settings : arguments of `compare_reduction`
    """
    table = compare_reduction(**settings)
    title = "MDR, surface by surface"
    write_table(table, csv, columns=COLUMNS, title=title)


run_job(globals(), main)
