"""Fit power laws to measured surfaces, and compute their motion in all media."""

from viscorough.io import netcdf
from viscorough.io.datasets import read_dataset
from viscorough_study.comparisons.measured import COLUMNS, KINETICS, measured_tables
from viscorough_study.fits import fit_table
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import recorded, write_tables

TABLES = {
    "measured_scans": {"columns": COLUMNS, "dimension": "row", "title": "Measured surfaces"},
    "measured_fits": {
        "columns": fit_table.COLUMNS,
        "dimension": "row",
        "title": "Power laws of measured surfaces",
    },
    "measured_kinetics": {"columns": KINETICS, "dimension": "row", "title": "Kinetics of measured surfaces"},
}


def main(pool, curves, csv, nc, **settings):
    """Write the tables of scans, of fits, and of motions.

    pool : file with the curves of all scans at common abscissae; curves : for each scan, the file of its loading curve
    csv, nc : lists of the CSV and NetCDF files to write; settings : further arguments of `measured_tables`
    """
    tables = measured_tables(read_dataset(pool), map(netcdf.read, curves), **settings)
    write_tables(tables, csv, nc, TABLES, recorded(settings=settings))


run_job(globals(), main)
