"""Choose the cheapest sufficient model for every question and every allowed error."""

from viscorough_study.comparisons.sufficient_models import COLUMNS, sufficient_models
from viscorough_study.performance.timing import machine
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import read_table, write_table


def main(one_surface, mean_accuracy, csv):
    """Write the table of sufficient models, and record the machine.

    one_surface, mean_accuracy : CSV files of the models of one surface, and of the mean of many surfaces
    csv : file to write
    """
    table = sufficient_models(read_table(one_surface), read_table(mean_accuracy))
    title = "The cheapest sufficient model for every question"
    write_table(table, csv, columns=COLUMNS, title=title, machine=machine())


run_job(globals(), main)
