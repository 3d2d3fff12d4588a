"""Figure of cost against error of every method on every indenter."""

import pandas as pd

from viscorough_study.figures.all_methods import plot_all_methods
from viscorough_study.figures.style import save_figure
from viscorough_study.job_log import log_to


def main(table, png, pdf):
    """Plot the table."""
    save_figure(plot_all_methods(pd.read_csv(table)), png, pdf)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output)
