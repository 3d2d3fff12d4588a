"""Figure of the time that other solvers take for the same levels."""

import pandas as pd

from viscorough_study.figures.other_solvers import plot_other_solvers
from viscorough_study.figures.style import save_figure
from viscorough_study.job_log import log_to


def main(table, png, pdf):
    """Plot the table."""
    save_figure(plot_other_solvers(pd.read_csv(table)), png, pdf)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output)
