"""Figure of the errors against exact solutions over the number of elements."""

import pandas as pd

from viscorough_study.figures.style import save_figure
from viscorough_study.figures.validation import plot_validation
from viscorough_study.job_log import log_to


def main(table, png, pdf):
    """Plot the table."""
    save_figure(plot_validation(pd.read_csv(table)), png, pdf)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output)
