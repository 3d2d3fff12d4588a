"""Test whether the curves of all grids collapse onto one, and find the exponent of an infinitely fine grid."""

from viscorough.io.datasets import read_dataset
from viscorough_study.fits import infinite_grid, scaling_collapse
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import recorded, write_tables

TABLES = {
    "collapse": {
        "columns": scaling_collapse.COLUMNS,
        "dimension": "row",
        "title": "Collapse of the curves of all grids",
    },
    "infinite_grid": {
        "columns": infinite_grid.COLUMNS,
        "dimension": "row",
        "title": "Exponents of an infinitely fine grid",
    },
    "collapse_curves": {
        "columns": scaling_collapse.CURVES,
        "dimension": "row",
        "title": "Curves of discs on all grids",
    },
}


def main(discs, lines, csv, nc, **settings):
    """Write the tables of the collapse, of the exponents, and of the mean curves.

    discs, lines : files with all realizations of discs and of lines on grids from coarse to fine
    csv, nc : lists of the CSV and NetCDF files to write; settings : further arguments of `collapse_tables`
    """
    tables = infinite_grid.collapse_tables(read_dataset(discs), read_dataset(lines), **settings)
    write_tables(tables, csv, nc, TABLES, recorded(settings=settings))


run_job(globals(), main)
