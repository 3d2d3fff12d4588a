"""Figure of the exponents of time in other media."""

import pandas as pd

from viscorough_study.figures.media_exponents import plot_media_exponents
from viscorough_study.figures.style import save_figure
from viscorough_study.job_log import log_to


def main(table, png, pdf):
    """Plot the table."""
    save_figure(plot_media_exponents(pd.read_csv(table)), png, pdf)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output)
