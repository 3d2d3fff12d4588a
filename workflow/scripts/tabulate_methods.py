"""One table of all methods on all indenters."""

import pandas as pd

from viscorough_study.performance import timing
from viscorough_study.performance.equal_error import COLUMNS as EQUAL
from viscorough_study.performance.equal_error import equal_error
from viscorough_study.performance.measurement import COLUMNS
from viscorough_study.run.job_log import log_to
from viscorough_study.run.tables import recorded, write_table


def main(tables, csv, nc, equal_csv, equal_nc, *, settings):
    """Join the tables; settings : with which the methods were measured, to be recorded."""
    table = pd.concat(map(pd.read_csv, tables), ignore_index=True)
    about = recorded(settings=settings, machine=timing.machine())
    title = "Speed and accuracy of every method"
    write_table(table, csv, nc, columns=COLUMNS, dimension="measurement", title=title, attributes=about)
    about = {"title": "Lines and boundary elements at the same error", "attributes": about}
    write_table(equal_error(table), equal_csv, equal_nc, columns=EQUAL, dimension="indenter", **about)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output, **job.params)
