"""Figure of measured surfaces beside the generated discs."""

import pandas as pd

from viscorough.io.datasets import read_dataset
from viscorough_study.figures.measured import plot_measured
from viscorough_study.figures.style import save_figure
from viscorough_study.job_log import log_to
from viscorough_study.pool import ensembles, select


def main(pool, discs, fits, kinetics, png, pdf, *, conventions, fraction_min):
    """Plot.

    pool, discs : pools of measured and of generated surfaces; conventions : of the figures
    fraction_min : smallest share of the discs defined, for a mean to be drawn
    """
    groups = ensembles(read_dataset(pool), "group")
    generated = ensembles(select(read_dataset(discs), group="base"), "hurst")
    tables = pd.read_csv(fits), pd.read_csv(kinetics)
    shown = [generated[hurst] for hurst in sorted(generated)]
    figure = plot_measured(groups, shown, *tables, conventions, fraction_min=fraction_min)
    save_figure(figure, png, pdf)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output, **job.params)
