"""Figure of the errors against steps and contact."""

import pandas as pd

from viscorough_study.figures.failure_curves import plot_failure_curves
from viscorough_study.figures.style import save_figure
from viscorough_study.job_log import log_to


def main(table, png, pdf):
    """Plot the table."""
    save_figure(plot_failure_curves(pd.read_csv(table)), png, pdf)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output)
