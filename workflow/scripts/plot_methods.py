"""Figures of speed and accuracy: every method, their growth, other solvers, levels chosen for a scene."""

from pathlib import Path

import pandas as pd

from viscorough_study.figures.growth import plot_growth
from viscorough_study.figures.level_placement import plot_level_placement
from viscorough_study.figures.other_solvers import plot_other_solvers
from viscorough_study.figures.speed import plot_speed
from viscorough_study.figures.style import save_figure
from viscorough_study.job_log import log_to


def main(methods, peers, scenes, figures):
    """Plot the tables; figures : {name: .png to write, beside which the .pdf stands}."""
    plots = {"speed": plot_speed, "growth": plot_growth, "peers": plot_other_solvers, "scenes": plot_level_placement}
    tables = {"speed": methods, "growth": methods, "peers": peers, "scenes": scenes}
    for name, plot in plots.items():
        save_figure(plot(pd.read_csv(tables[name])), figures[name], Path(figures[name]).with_suffix(".pdf"))


if job := globals().get("snakemake"):
    log_to(job.log[0])
    names = ("speed", "growth", "peers", "scenes")
    main(**job.input, figures={name: job.output[name] for name in names})
