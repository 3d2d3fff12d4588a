"""Fit the contribution to vt/h of a rough interface in series with a flat punch, and its plateau value u₀/h."""

from viscorough.io.datasets import read_dataset
from viscorough_study.fits.interface import COLUMNS, CURVES, interface_tables
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import recorded, write_table

# {table: (columns, dimension in the NetCDF file, title)}
TABLES = {
    "interface": (COLUMNS, "ensemble", "Interface and punch in series"),
    "interface_curves": (CURVES, "abscissa", "Curves of the interface alone"),
}


def main(discs, lines, size_discs, size_lines, csv, nc, **settings):
    """Write tables of the interface of every ensemble.

    discs, lines : files of the pools with the usual grid
    size_discs, size_lines : files of the pools with grids from coarse to fine
    csv, nc : lists of the files to write, one for each table
    settings : further arguments of `interface_tables`
    """
    tables = interface_tables(*map(read_dataset, (discs, lines, size_discs, size_lines)), **settings)
    for (name, (columns, dimension, title)), *paths in zip(TABLES.items(), csv, nc, strict=True):
        described = {"columns": columns, "dimension": dimension, "title": title}
        write_table(tables[name], *paths, **described, attributes=recorded(settings=settings))


run_job(globals(), lambda job: main(**job.input, **job.output, **job.params))
