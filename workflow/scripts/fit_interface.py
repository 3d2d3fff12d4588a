"""Fit the model of a disc as two springs in series: a flat punch, and the rough interface between disc and half-space.

The fit gives the part of vt/h that the interface contributes, and the plateau of this part (see fits.interface).
"""

from viscorough.io.datasets import read_dataset
from viscorough_study.fits.interface import COLUMNS, CURVES, interface_tables
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import write_tables

TABLES = {
    "interface": {"columns": COLUMNS, "title": "Interface and punch in series"},
    "interface_curves": {"columns": CURVES, "title": "Curves of the interface alone"},
}


def main(discs, lines, size_discs, size_lines, csv, **settings):
    """Fit the model of punch and interface to every ensemble of discs and of lines, and write the tables.

    discs, lines : files with all realizations of the discs and of the lines that all figures use (base ensembles)
    size_discs, size_lines : files with all realizations of discs and of lines on grids from coarse to fine
    csv : list of the files to write, one for each table
    settings : further arguments of `interface_tables`
    """
    tables = interface_tables(*map(read_dataset, (discs, lines, size_discs, size_lines)), **settings)
    write_tables(tables, csv, TABLES)


run_job(globals(), main)
