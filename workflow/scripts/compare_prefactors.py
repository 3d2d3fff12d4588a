"""Table of the prefactor under every combination of conventions."""

import pandas as pd

from viscorough_study.fits.prefactors import COLUMNS, prefactors
from viscorough_study.run.job_log import log_to
from viscorough_study.run.tables import write_table


def main(scaling, csv, nc, *, surfaces):
    """Tabulate the prefactors of the scaling table; surfaces : what each group of discs to be compared is like."""
    table = prefactors(pd.read_csv(scaling), surfaces)
    write_table(table, csv, nc, columns=COLUMNS, dimension="fit", title="Prefactor under every convention")


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output, **job.params)
