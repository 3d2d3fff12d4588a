"""Table of the cost of one disc on ever finer grids."""

import pandas as pd

from viscorough_study.performance.large_discs import COLUMNS
from viscorough_study.run.job_log import log_to
from viscorough_study.run.tables import write_table


def main(costs, csv, nc):
    """Gather the costs of every size."""
    table = pd.concat(map(pd.read_csv, costs)).sort_values("elements", ignore_index=True)
    write_table(table, csv, nc, columns=COLUMNS, dimension="disc", title="Cost of one disc")


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output)
