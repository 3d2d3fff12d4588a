"""Draw Figure 2 of the paper: kinetics, and their collapse."""

from viscorough.io.datasets import read_dataset
from viscorough_study.ensembles import pool
from viscorough_study.figures.kinetics import plot_kinetics
from viscorough_study.figures.style import save_figure
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import read_table


def main(discs, scaling, figure, *, combinations, **settings):
    """Write the figure.

    discs : file with all realizations of the discs; scaling : CSV file of the fits; figure : file to write
    combinations, settings : further arguments of `plot_kinetics`
    """
    ensembles = pool.ensembles(pool.select(read_dataset(discs), group="base"), "ensemble").values()
    save_figure(plot_kinetics(list(ensembles), combinations, read_table(scaling), **settings), figure)


run_job(globals(), main)
