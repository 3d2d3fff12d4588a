"""Compare results in the literature with the results of this run."""

from viscorough_study.comparisons.literature import COLUMNS, literature
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import read_table, write_table


def main(scaling, interface, reduction, csv, **settings):
    """Write the table of published values and values of this run.

    scaling, interface, reduction : CSV files of the fits, of the interface, and of the comparison of the MDR
    csv : file to write; settings : further arguments of `literature`
    """
    table = literature(*map(read_table, (scaling, interface, reduction)), **settings)
    title = "Results in the literature"
    write_table(table, csv, columns=COLUMNS, title=title)


run_job(globals(), main)
