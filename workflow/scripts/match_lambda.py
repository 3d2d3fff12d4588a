"""Compare MDR lines with discs: the factor λ in the spectrum (Eq. 13), the error with one λ, and exponents β."""

from viscorough.io.datasets import read_dataset
from viscorough_study.comparisons import mdr_equivalence
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import recorded, write_table

# {table: (dimension in the NetCDF file, title)}
TABLES = {
    "mdr_lambda": ("point", "MDR, lambda over the force"),
    "mdr_summary": ("exponent", "MDR, residual error of a single lambda"),
    "mdr_exponents": ("fit", "MDR, exponents in equal windows"),
}


def main(discs, lines, csv, nc, **settings):
    """Compare lines with discs of the same Hurst exponent, and write the tables.

    discs, lines : files with all realizations of discs and of lines
    csv, nc : lists of the CSV and NetCDF files to write, one for each table
    settings : further arguments of `mdr_tables`
    """
    tables = mdr_equivalence.mdr_tables(read_dataset(discs), read_dataset(lines), **settings)
    for (name, (dimension, title)), *paths in zip(TABLES.items(), csv, nc, strict=True):
        described = {"columns": mdr_equivalence.TABLES[name], "dimension": dimension, "title": title}
        write_table(tables[name], *paths, **described, attributes=recorded(settings=settings))


run_job(globals(), lambda job: main(**job.input, **job.output, **job.params))
