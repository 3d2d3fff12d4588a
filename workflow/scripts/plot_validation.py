"""Draw the comparison of boundary elements with exact solutions."""

from viscorough_study.figures.style import save_figure
from viscorough_study.figures.validation import plot_validation
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import read_table


def main(validation, figure):
    """Write the figure.

    validation : CSV file of comparisons.validation; figure : file to write
    """
    save_figure(plot_validation(read_table(validation)), figure)


run_job(globals(), main)
