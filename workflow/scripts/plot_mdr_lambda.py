"""Figure of λ over X, and of exponents of lines and discs in equal windows."""

import pandas as pd

from viscorough_study.figures.mdr_lambda import plot_mdr_lambda
from viscorough_study.figures.style import save_figure
from viscorough_study.job_log import log_to


def main(of_lambda, exponents, png, pdf):
    """Plot the tables."""
    save_figure(plot_mdr_lambda(pd.read_csv(of_lambda), pd.read_csv(exponents)), png, pdf)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output)
