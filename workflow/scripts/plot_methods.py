"""Figures of speed and accuracy: every method, their growth, other solvers, levels chosen for a scene."""

from pathlib import Path

import pandas as pd

from viscorough_study.figures.paper import save_figure
from viscorough_study.figures.performance import plot_growth, plot_peers, plot_scenes, plot_speed
from viscorough_study.job_log import log_to


def main(methods, peers, scenes, figures):
    """Plot the tables; figures : {name: .png to write, beside which the .pdf stands}."""
    plots = {"speed": plot_speed, "growth": plot_growth, "peers": plot_peers, "scenes": plot_scenes}
    tables = {"speed": methods, "growth": methods, "peers": peers, "scenes": scenes}
    for name, plot in plots.items():
        save_figure(plot(pd.read_csv(tables[name])), figures[name], Path(figures[name]).with_suffix(".pdf"))


if job := globals().get("snakemake"):
    log_to(job.log[0])
    names = ("speed", "growth", "peers", "scenes")
    main(**job.input, figures={name: job.output[name] for name in names})
