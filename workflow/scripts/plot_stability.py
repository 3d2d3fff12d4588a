"""Figures of stability: the chart of methods and difficulties, and the curves that tell most."""

from pathlib import Path

import pandas as pd

from viscorough_study.figures.failure_curves import plot_failure_curves
from viscorough_study.figures.failure_map import plot_failure_map
from viscorough_study.figures.style import save_figure
from viscorough_study.job_log import log_to


def main(atlas, curves, figures):
    """Plot the tables; figures : the .png files to write, beside which the .pdf files stand."""
    for plot, table, figure in zip((plot_failure_map, plot_failure_curves), (atlas, curves), figures, strict=True):
        save_figure(plot(pd.read_csv(table)), figure, Path(figure).with_suffix(".pdf"))


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, figures=(job.output.atlas, job.output.curves))
