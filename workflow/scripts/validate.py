"""Table of errors and observed orders against exact solutions."""

from viscorough_study.comparisons.validation import COLUMNS, validation_table
from viscorough_study.run.job_log import log_to
from viscorough_study.run.tables import write_table


def main(csv, nc, *, elements, limits, order_margin):
    """Write the table whatever it says: check_validation judges it."""
    table = validation_table(elements, limits, order_margin)
    title = "Comparison with exact solutions"
    write_table(table, csv, nc, columns=COLUMNS, dimension="comparison", title=title)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.output, **job.params)
