"""Draw where methods fail in the stress tests."""

from viscorough_study.figures.failures import plot_failures
from viscorough_study.figures.style import save_figure
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import read_table


def main(failures, figure):
    """Write the figure.

    failures : CSV file of robustness.failure_map; figure : file to write
    """
    save_figure(plot_failures(read_table(failures)), figure)


run_job(globals(), main)
