"""Figure 2: kinetics of penetration, one line for every combination of force, viscosity, diameter and rms height."""

import pandas as pd

from viscorough.io.datasets import read_dataset
from viscorough_study.figures.kinetics import plot_kinetics
from viscorough_study.figures.style import save_figure
from viscorough_study.job_log import log_to


def main(ensembles, scaling, png, pdf, *, combinations, shown):
    """Plot the ensembles.

    combinations : {case: {force [N], viscosity [Pa s], diameter [m], rms [m]}}; shown : conventions of the figures,
        {column of the scaling table: value}.
    """
    discs = [read_dataset(path) for path in ensembles]
    save_figure(plot_kinetics(discs, combinations, pd.read_csv(scaling), shown), png, pdf)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output, **job.params)
