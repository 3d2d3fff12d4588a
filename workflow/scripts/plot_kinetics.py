"""Figure 2: kinetics of penetration, one line for every combination of force, viscosity, diameter and rms height."""

import pandas as pd

from viscorough.io.datasets import read_dataset
from viscorough_study.figures.kinetics import plot_kinetics
from viscorough_study.figures.style import save_figure
from viscorough_study.job_log import log_to
from viscorough_study.pool import ensembles, select


def main(discs, scaling, png, pdf, *, combinations, conventions, fraction_min):
    """Plot the base cases of the pool of discs.

    combinations : {case: {force [N], viscosity [Pa s], diameter [m], rms [m]}}; conventions : those of the figures,
        {column of the scaling table: value}; fraction_min : smallest share of the realizations, for a mean to be drawn.
    """
    cases = list(ensembles(select(read_dataset(discs), group="base"), "case").values())
    figure = plot_kinetics(cases, combinations, pd.read_csv(scaling), conventions, fraction_min=fraction_min)
    save_figure(figure, png, pdf)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output, **job.params)
