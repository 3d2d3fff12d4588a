"""Figure 4: the exponent beta over the Hurst exponent."""

import pandas as pd

from viscorough_study.figures.exponent import plot_exponent
from viscorough_study.figures.style import save_figure
from viscorough_study.job_log import log_to


def main(scaling, png, pdf, *, conventions, hurst_range):
    """Plot the scaling table; conventions, hurst_range : as in plot_exponent."""
    save_figure(plot_exponent(pd.read_csv(scaling), conventions, hurst_range), png, pdf)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output, **job.params)
