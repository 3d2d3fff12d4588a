"""Compare levels that the package places with levels that are placed by hand or naively."""

from viscorough_study.performance.level_placement import COLUMNS, compare_scenes
from viscorough_study.performance.timing import machine
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import write_table


def main(csv, **settings):
    """Write the table of the cost and error of every placement, and record the machine.

    csv : file to write; settings : arguments of `compare_scenes`
    """
    table = compare_scenes(**settings)
    title = "Placement of levels"
    write_table(table, csv, columns=COLUMNS, title=title, machine=machine())


run_job(globals(), main)
