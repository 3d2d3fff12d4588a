"""Figure of direct integration against the law with and without the Gamma function."""

import pandas as pd

from viscorough_study.figures.direct_integration import plot_direct_integration
from viscorough_study.figures.style import save_figure
from viscorough_study.job_log import log_to


def main(table, png, pdf):
    """Plot the table."""
    save_figure(plot_direct_integration(pd.read_csv(table)), png, pdf)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output)
