"""Draw speed against accuracy of models and solvers."""

from viscorough_study.figures.speed import plot_speed
from viscorough_study.figures.style import save_figure
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import read_table


def main(mean_accuracy, figure, *, other_solvers):
    """Write the figure.

    mean_accuracy : CSV file of comparisons.mean_of_surfaces; figure : file to write
    other_solvers : argument of `plot_speed`
    """
    save_figure(plot_speed(read_table(mean_accuracy), other_solvers), figure)


run_job(globals(), main)
