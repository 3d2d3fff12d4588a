"""Draw Figure 4 of the paper: the exponent over the Hurst exponent."""

from viscorough_study.figures.exponent import plot_exponent
from viscorough_study.figures.style import save_figure
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import read_table


def main(scaling, figure, **settings):
    """Write the figure.

    scaling : CSV file of the fits; figure : file to write; settings : further arguments of `plot_exponent`
    """
    save_figure(plot_exponent(read_table(scaling), **settings), figure)


run_job(globals(), main)
