"""Compare results in the literature with the results of this run."""

from viscorough_study.comparisons.literature import COLUMNS, literature
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import read_table, recorded, write_table


def main(scaling, interface, reduction, csv, nc, **settings):
    """Write the table of published values and values of this run.

    scaling, interface, reduction : CSV files of the fits, of the interface, and of the comparison of the MDR
    csv, nc : files to write; settings : further arguments of `literature`
    """
    table = literature(*map(read_table, (scaling, interface, reduction)), **settings)
    title = "Results in the literature"
    attributes = recorded(settings=settings)
    write_table(table, csv, nc, columns=COLUMNS, dimension="comparison", title=title, attributes=attributes)


run_job(globals(), main)
