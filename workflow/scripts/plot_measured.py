"""Draw the velocity of measured surfaces over X, and their depth over time."""

from viscorough.io.datasets import read_dataset
from viscorough_study.ensembles.pool import by_hurst, ensembles
from viscorough_study.figures.measured import plot_measured
from viscorough_study.figures.style import save_figure
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import read_table


def main(measured, discs, fits, kinetics, figure, **settings):
    """Write the figure.

    measured, discs : files with the curves of all scans, and with all realizations of the discs
    fits, kinetics : CSV files of comparisons.measured
    figure : file to write; settings : further arguments of `plot_measured`
    """
    groups, generated = ensembles(read_dataset(measured), "group"), by_hurst(read_dataset(discs), "base")
    save_figure(plot_measured(groups, generated, *map(read_table, (fits, kinetics)), **settings), figure)


run_job(globals(), main)
