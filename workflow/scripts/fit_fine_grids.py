"""Fit the exponents of small X on fine grids, and find those of an infinitely fine grid."""

from viscorough.io import netcdf
from viscorough_study.fits.fine_grids import COSTS, EXPONENTS, VELOCITIES, fine_grids
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import write_tables

TABLES = {
    "fine_exponents": {
        "columns": EXPONENTS,
        "title": "Local exponents on fine grids and on an infinitely fine grid",
    },
    "fine_velocities": {
        "columns": VELOCITIES,
        "title": "Velocities at fixed X on the finest grid and on an infinitely fine grid",
    },
    "fine_costs": {
        "columns": COSTS,
        "title": "Processor time of sums over pairs of grids and of plain averaging",
    },
}


def main(curves, csv, **settings):
    """Write the tables of exponents, of velocities, and of processor times.

    curves : files with the curves of the same discs on neighbouring grids
    csv : list of the files to write; settings : further arguments of `fine_grids`
    """
    tables = fine_grids([netcdf.read(path) for path in curves], **settings)
    write_tables(tables, csv, TABLES)


run_job(globals(), main)
