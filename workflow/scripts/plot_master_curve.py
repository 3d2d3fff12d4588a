"""Draw Figure 3 of the paper: the velocity of discs and lines, and the paper's law."""

from viscorough.io.datasets import read_dataset
from viscorough_study.ensembles.pool import by_hurst
from viscorough_study.figures.master_curve import plot_master_curve
from viscorough_study.figures.style import save_figure
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import read_table


def main(discs, lines, scaling, figure, **settings):
    """Write the figure.

    discs, lines : files with all realizations of discs and of lines; scaling : CSV file of the fits
    figure : file to write; settings : further arguments of `plot_master_curve`
    """
    pool = read_dataset(discs)
    ensembles = by_hurst(pool, "base"), by_hurst(pool, "longer_period"), by_hurst(read_dataset(lines), "lines")
    save_figure(plot_master_curve(*ensembles, read_table(scaling), **settings), figure)


run_job(globals(), main)
