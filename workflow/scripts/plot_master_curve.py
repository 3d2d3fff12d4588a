"""Figure 3: the master curve, discs by boundary elements and lines by reduction of dimensionality."""

import pandas as pd

from viscorough.io.datasets import read_dataset
from viscorough_study.figures.master_curve import plot_master_curve
from viscorough_study.figures.style import save_figure
from viscorough_study.job_log import log_to
from viscorough_study.pool import ensembles, select


def main(discs, lines, scaling, png, pdf, *, conventions, fraction_min):
    """Plot all base discs of each Hurst exponent as one ensemble, and the lines of the same exponents.

    discs, lines : pools; conventions : those of the figures, {column of the scaling table: value}; fraction_min :
        smallest share of the realizations, for a mean to be drawn.
    """
    discs = ensembles(select(read_dataset(discs), group="base"), "hurst")
    lines = ensembles(read_dataset(lines), "hurst")
    surfaces, reduced = list(discs.values()), [lines[hurst] for hurst in discs]
    figure = plot_master_curve(surfaces, reduced, pd.read_csv(scaling), conventions, fraction_min=fraction_min)
    save_figure(figure, png, pdf)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output, **job.params)
