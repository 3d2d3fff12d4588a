"""Figure of the collapse of the curves of all grids, and of the exponents that it allows."""

import pandas as pd

from viscorough.io.datasets import read_dataset
from viscorough_study.figures.collapse import plot_collapse
from viscorough_study.figures.style import save_figure
from viscorough_study.job_log import log_to
from viscorough_study.scaling_collapse import grids


def main(discs, collapse, infinite, png, pdf, *, ranges, conventions, fraction_min):
    """Plot. discs : pool; ranges : setting `collapse`; conventions : those of the figures"""
    how = {name: conventions[name] for name in ("average", "rms_convention")}
    how |= {"elements_min": min(ranges["elements_min"]), "fraction_min": fraction_min, "resamples": 0, "seed": 0}
    found = grids(read_dataset(discs), "discs", **how)
    save_figure(plot_collapse(found, pd.read_csv(collapse), pd.read_csv(infinite)), png, pdf)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output, **job.params)
