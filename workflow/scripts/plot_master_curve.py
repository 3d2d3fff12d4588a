"""Figure 3: the master curve, discs by boundary elements and lines by reduction of dimensionality."""

import pandas as pd

from viscorough.io.datasets import read_dataset
from viscorough_study.ensembles import combine
from viscorough_study.figures.master_curve import plot_master_curve
from viscorough_study.figures.style import save_figure
from viscorough_study.job_log import log_to


def main(discs, lines, scaling, png, pdf, *, shown):
    """Plot all discs of each Hurst exponent as one ensemble, and the lines of the same exponents.

    shown : conventions of the figures, {column of the scaling table: value}.
    """
    of_hurst = {}
    for ds in map(read_dataset, discs):
        of_hurst.setdefault(ds["hurst"].item(), []).append(ds)
    surfaces = [combine(ensembles) for ensembles in of_hurst.values()]
    reduced = [read_dataset(path) for path in lines]
    save_figure(plot_master_curve(surfaces, reduced, pd.read_csv(scaling), shown), png, pdf)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output, **job.params)
