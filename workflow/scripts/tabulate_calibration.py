"""Table of exponents and prefactors for others to use."""

import pandas as pd

from viscorough.calibrated_law import COLUMNS
from viscorough_study.fits.fit_table import calibrated
from viscorough_study.run.job_log import log_to
from viscorough_study.run.tables import write_table


def main(scaling, sizes, csv, nc, *, conventions, across):
    """Take the rows in these conventions, {convention: value}, from the table scaling, and from sizes what it lacks.

    across : elements across the discs of scaling
    """
    table = calibrated(pd.read_csv(scaling), pd.read_csv(sizes), conventions, across)
    write_table(table, csv, nc, columns=COLUMNS, dimension="fit", title="Calibrated exponents and prefactors")


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output, **job.params)
