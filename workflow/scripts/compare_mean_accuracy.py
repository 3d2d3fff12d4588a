"""Compare the cost and the error of every model of the mean of many surfaces."""

from viscorough.io.datasets import read_dataset
from viscorough_study.comparisons.mean_of_surfaces import COLUMNS, mean_accuracy
from viscorough_study.performance.timing import machine
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import read_table, write_table


def main(discs, coarse, lines, mdr_lambda, scaling, one_surface, csv, **settings):
    """Write the table of the cost and the error of every model, and record the machine.

    discs, coarse, lines : files with all realizations of discs, of discs on coarser grids, and of lines
    mdr_lambda, scaling, one_surface : CSV files of the tables with these names
    csv : file to write; settings : further arguments of `mean_accuracy`
    """
    pools = map(read_dataset, (discs, coarse, lines))
    table = mean_accuracy(*pools, *map(read_table, (mdr_lambda, scaling, one_surface)), **settings)
    title = "Models of the mean of many surfaces"
    write_table(table, csv, columns=COLUMNS, title=title, machine=machine())


run_job(globals(), main)
