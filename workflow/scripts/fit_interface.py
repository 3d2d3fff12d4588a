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


def main(discs, law, lines, csv, **settings):
    """Fit the model of punch and interface to every ensemble of discs and of lines, and write the tables.

    discs, law, lines : files with all realizations of discs, of discs of further Hurst exponents, and of lines
    csv : list of the files to write, one for each table
    settings : further arguments of `interface_tables`
    """
    tables = interface_tables(*map(read_dataset, (discs, law, lines)), **settings)
    write_tables(tables, csv, TABLES)


run_job(globals(), main)
