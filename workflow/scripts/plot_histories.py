"""Draw motions under any history of loading and unloading."""

from viscorough_study.figures.histories import plot_histories
from viscorough_study.figures.style import save_figure
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import read_table


def main(histories, figure):
    """Write the figure.

    histories : CSV file of comparisons.histories; figure : file to write
    """
    save_figure(plot_histories(read_table(histories)), figure)


run_job(globals(), main)
