"""Figure of the growth of the cost with the number of elements."""

import pandas as pd

from viscorough_study.figures.growth import plot_growth
from viscorough_study.figures.style import save_figure
from viscorough_study.job_log import log_to


def main(table, png, pdf):
    """Plot the table."""
    save_figure(plot_growth(pd.read_csv(table)), png, pdf)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output)
