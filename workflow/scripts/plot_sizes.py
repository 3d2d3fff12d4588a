"""Figure of exponents on grids from coarse to fine."""

import pandas as pd

from viscorough_study.figures.sizes import plot_sizes
from viscorough_study.figures.style import save_figure
from viscorough_study.job_log import log_to


def main(table, png, pdf, *, conventions):
    """Plot the table. conventions : those of the figures, {column of the table: value}"""
    save_figure(plot_sizes(pd.read_csv(table), conventions), png, pdf)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output, **job.params)
