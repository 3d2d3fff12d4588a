"""Compare boundary elements with exact solutions: errors and orders of convergence."""

from viscorough_study.comparisons.validation import COLUMNS, validation_table
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import write_table


def main(csv, **settings):
    """Write the table of errors and orders of convergence.

    csv : file to write; settings : arguments of `validation_table`
    """
    table = validation_table(**settings)
    title = "Comparison with exact solutions"
    write_table(table, csv, columns=COLUMNS, title=title)


run_job(globals(), main)
