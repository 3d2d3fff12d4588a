"""Draw the comparison of the MDR with boundary elements, surface by surface."""

from viscorough_study.figures.reduction import plot_reduction
from viscorough_study.figures.style import save_figure
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import read_table


def main(reduction, figure):
    """Write the figure.

    reduction : CSV file of comparisons.mdr_comparison; figure : file to write
    """
    save_figure(plot_reduction(read_table(reduction)), figure)


run_job(globals(), main)
