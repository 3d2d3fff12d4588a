"""Model rough discs as an interface in series with a flat punch; fit the interface's part of vt/h and its plateau."""

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
    """Fit the interface of every ensemble, and write the tables.

    discs, lines : files of the pools (datasets of all realizations) of the base ensembles
    size_discs, size_lines : files of the pools of ensembles on grids from coarse to fine
    csv, nc : lists of the CSV and NetCDF files to write, one for each table
    settings : further arguments of `interface_tables`
    """
    tables = interface_tables(*map(read_dataset, (discs, lines, size_discs, size_lines)), **settings)
    for (name, (columns, dimension, title)), *paths in zip(TABLES.items(), csv, nc, strict=True):
        described = {"columns": columns, "dimension": dimension, "title": title}
        write_table(tables[name], *paths, **described, attributes=recorded(settings=settings))


run_job(globals(), lambda job: main(**job.input, **job.output, **job.params))
