"""Collapse of the curves of all grids, and exponents of an infinitely fine grid."""

from viscorough.io.datasets import read_dataset
from viscorough_study.fits import infinite_grid, scaling_collapse
from viscorough_study.fits.infinite_grid import collapse_tables
from viscorough_study.run.job_log import log_to
from viscorough_study.run.tables import write_table

COLUMNS = {
    "collapse": (scaling_collapse.COLUMNS, "Collapse of the curves of all grids"),
    "infinite": (infinite_grid.COLUMNS, "Exponents of an infinitely fine grid"),
    "curves": (scaling_collapse.CURVES, "Curves of discs on all grids"),
}


def main(discs, lines, *, ranges, conventions, fraction_min, tolerance, seed, **paths):
    """Make the tables of discs, of their control and of lines.

    discs, lines : pools; ranges : setting `collapse`; conventions : those of the figures; tolerance : of the exponents
    paths : {<table>_<csv or nc>: path}
    """
    how = {name: conventions[name] for name in ("average", "rms_convention")}
    how |= {"fraction_min": fraction_min, "seed": seed, "tolerance": tolerance}
    tables = collapse_tables(read_dataset(discs), read_dataset(lines), ranges, **how)
    for name, (columns, title) in COLUMNS.items():
        files = [paths[f"{name}_{kind}"] for kind in ("csv", "nc")]
        write_table(tables[name], *files, columns=columns, dimension="row", title=title)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output, **job.params)
