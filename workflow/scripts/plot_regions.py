"""Draw the local slope of the curves, and the share of the elements in contact, over X."""

from viscorough.io.datasets import read_dataset
from viscorough_study.ensembles.pool import by_hurst
from viscorough_study.figures.regions import plot_regions
from viscorough_study.figures.style import save_figure
from viscorough_study.fits.conventions import CONTROL
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import read_table


def main(discs, local_slope, figure, **settings):
    """Write the figure.

    discs : file with all realizations of the discs; local_slope : CSV file of fits.local_slope
    figure : file to write; settings : further arguments of `plot_regions`
    """
    pool = read_dataset(discs)
    discs, controls = by_hurst(pool, "base"), by_hurst(pool, CONTROL)
    save_figure(plot_regions(discs, controls, read_table(local_slope), **settings), figure)


run_job(globals(), main)
