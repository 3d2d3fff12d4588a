"""Figure of the interface and the punch in series."""

import pandas as pd

from viscorough_study.figures.interface import plot_interface
from viscorough_study.figures.style import save_figure
from viscorough_study.job_log import log_to


def main(table, curves, literature, png, pdf, *, conventions):
    """Plot the tables. conventions : those of the figures, {column of the table: value}"""
    tables = [pd.read_csv(path) for path in (table, curves, literature)]
    save_figure(plot_interface(*tables, conventions), png, pdf)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output, **job.params)
