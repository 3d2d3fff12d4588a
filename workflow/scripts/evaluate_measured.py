"""Fit power laws to measured surfaces, and compute their motion in all media."""

from viscorough.io.datasets import read_dataset
from viscorough_study.comparisons.measured import COLUMNS, KINETICS, measured_tables
from viscorough_study.ensembles.curve_files import read_curves
from viscorough_study.fits import fit_table
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import write_tables

TABLES = {
    "measured_scans": {"columns": COLUMNS, "title": "Measured surfaces"},
    "measured_fits": {
        "columns": fit_table.COLUMNS,
        "title": "Power laws of measured surfaces",
    },
    "measured_kinetics": {"columns": KINETICS, "title": "Kinetics of measured surfaces"},
}


def main(pool, curves, csv, **settings):
    """Write the tables of scans, of fits, and of motions.

    pool : file with the curves of all scans at common abscissae; curves : for each scan, the file of its loading curve
    csv : list of the files to write; settings : further arguments of `measured_tables`
    """
    tables = measured_tables(read_dataset(pool), map(read_curves, curves), **settings)
    write_tables(tables, csv, TABLES)


run_job(globals(), main)
