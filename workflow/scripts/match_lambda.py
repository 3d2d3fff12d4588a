"""Compare MDR lines with discs: the factor λ in the spectrum (Eq. 13), the error with one λ, and exponents β."""

from viscorough.io.datasets import read_dataset
from viscorough_study.comparisons.mdr_equivalence import (
    EXPONENT_COLUMNS,
    LAMBDA_COLUMNS,
    SUMMARY_COLUMNS,
    mdr_tables,
)
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import recorded, write_tables

TABLES = {
    "mdr_lambda": {"columns": LAMBDA_COLUMNS, "dimension": "point", "title": "MDR, lambda over the force"},
    "mdr_summary": {
        "columns": SUMMARY_COLUMNS,
        "dimension": "exponent",
        "title": "MDR, residual error of a single lambda",
    },
    "mdr_exponents": {"columns": EXPONENT_COLUMNS, "dimension": "fit", "title": "MDR, exponents in equal windows"},
}


def main(discs, lines, csv, nc, **settings):
    """Compare lines with discs of the same Hurst exponent, and write the tables.

    discs, lines : files with all realizations of discs and of lines
    csv, nc : lists of the CSV and NetCDF files to write, one for each table
    settings : further arguments of `mdr_tables`
    """
    tables = mdr_tables(read_dataset(discs), read_dataset(lines), **settings)
    write_tables(tables, csv, nc, TABLES, recorded(settings=settings))


run_job(globals(), main)
