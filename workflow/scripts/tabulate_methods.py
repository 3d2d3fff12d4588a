"""One table of all methods on all indenters."""

import pandas as pd

from viscorough_study.job_log import log_to
from viscorough_study.performance import timing
from viscorough_study.performance.measurement import COLUMNS
from viscorough_study.tables import write_table


def main(tables, csv, html, nc):
    """Join the tables; the machine is in the title."""
    table = pd.concat(map(pd.read_csv, tables), ignore_index=True)
    title = f"Speed and accuracy of every method, on {timing.machine()}"
    write_table(table, csv, nc, html, columns=COLUMNS, dimension="measurement", title=title)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output)
