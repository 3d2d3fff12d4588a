"""Figure of the collapse of the curves of all grids, and of the exponents that it allows."""

import pandas as pd

from viscorough_study.figures.collapse import plot_collapse
from viscorough_study.figures.style import save_figure
from viscorough_study.job_log import log_to


def main(curves, collapse, infinite, png, pdf):
    """Plot the tables of fit_collapse."""
    save_figure(plot_collapse(pd.read_csv(curves), pd.read_csv(collapse), pd.read_csv(infinite)), png, pdf)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output)
