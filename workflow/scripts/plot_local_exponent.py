"""Draw the local exponent over X, on fine grids and on the grid of the paper."""

from viscorough_study.figures.local_exponent import plot_local_exponent
from viscorough_study.figures.style import save_figure
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import read_table


def main(fine_exponents, figure):
    """Write the figure.

    fine_exponents : CSV file of fits.fine_grids; figure : file to write
    """
    save_figure(plot_local_exponent(read_table(fine_exponents)), figure)


run_job(globals(), main)
