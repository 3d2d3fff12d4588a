"""Compare MDR lines with discs: the factor λ in the spectrum (Eq. 13), the error with one λ, and exponents β."""

from viscorough.io.datasets import read_dataset
from viscorough_study.comparisons.mdr_equivalence import (
    EXPONENT_COLUMNS,
    LAMBDA_COLUMNS,
    SUMMARY_COLUMNS,
    mdr_tables,
)
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import write_tables

TABLES = {
    "mdr_lambda": {"columns": LAMBDA_COLUMNS, "title": "MDR, lambda over the force"},
    "mdr_summary": {
        "columns": SUMMARY_COLUMNS,
        "title": "MDR, residual error of a single lambda",
    },
    "mdr_exponents": {"columns": EXPONENT_COLUMNS, "title": "MDR, exponents in equal windows"},
}


def main(discs, lines, csv, **settings):
    """Compare lines with discs of the same Hurst exponent, and write the tables.

    discs, lines : files with all realizations of discs and of lines
    csv : list of the files to write, one for each table
    settings : further arguments of `mdr_tables`
    """
    tables = mdr_tables(read_dataset(discs), read_dataset(lines), **settings)
    write_tables(tables, csv, TABLES)


run_job(globals(), main)
