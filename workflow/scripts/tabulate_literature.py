"""Table of what others found, with the numbers of this study beside it."""

import pandas as pd

from viscorough_study.comparisons.literature import COLUMNS, literature
from viscorough_study.run.job_log import log_to
from viscorough_study.run.tables import write_table


def main(scaling, interface, reduction, csv, nc, *, entries, conventions):
    """Put values of the tables, in these conventions, beside the entries."""
    tables = [pd.read_csv(path) for path in (scaling, interface, reduction)]
    table = literature(entries, *tables, conventions)
    write_table(table, csv, nc, columns=COLUMNS, dimension="comparison", title="What others found")


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output, **job.params)
