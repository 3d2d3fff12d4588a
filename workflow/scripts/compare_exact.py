"""Compare boundary elements with exact solutions: errors and orders of convergence."""

from viscorough_study.comparisons.validation import COLUMNS, validation_table
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import recorded, write_table


def main(csv, nc, **settings):
    """Write the table of errors and orders of convergence.

    csv, nc : files to write; settings : arguments of `validation_table`
    """
    table = validation_table(**settings)
    title = "Comparison with exact solutions"
    attributes = recorded(settings=settings)
    write_table(table, csv, nc, columns=COLUMNS, dimension="comparison", title=title, attributes=attributes)


run_job(globals(), main)
