"""Draw direct integration and both readings of the paper's law."""

from viscorough_study.figures.direct import plot_direct
from viscorough_study.figures.style import save_figure
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import read_table


def main(direct, figure):
    """Write the figure.

    direct : CSV file of comparisons.direct_integration; figure : file to write
    """
    save_figure(plot_direct(read_table(direct)), figure)


run_job(globals(), main)
