"""Measure the spread of the local slope within region (b), for the discs of both readings and for a control."""

from viscorough.io.datasets import read_dataset
from viscorough_study.fits.conventions import CONTROL, READINGS
from viscorough_study.fits.local_slope import COLUMNS, local_slope_table
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import write_table


def main(discs, csv, **settings):
    """Write the table of the local slope.

    discs : file with all realizations of the discs; csv : file to write
    settings : further arguments of `local_slope_table`
    """
    groups = {own["group"]: own["rms_convention"] for own in READINGS.values()} | {CONTROL: "disc"}
    table = local_slope_table(read_dataset(discs), groups=groups, **settings)
    write_table(table, csv, columns=COLUMNS, title="Local slope within region (b), of the discs and of the control")


run_job(globals(), main)
