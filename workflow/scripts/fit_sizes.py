"""Table of exponents and prefactors of ensembles on grids from coarse to fine."""

import pandas as pd

from viscorough.joblog import log_to, progress
from viscorough.scaling import COLUMNS, scaling_rows
from viscorough.storage import read_dataset, write_table


def main(discs, lines, csv, nc, *, seed, fit):
    """Fit every ensemble by itself; fit : further arguments of scaling_rows."""
    paths = [("discs", path) for path in discs] + [("lines", path) for path in lines]
    rows = []
    for source, path in progress(paths, len(paths), "ensembles"):
        ensemble = read_dataset(path)
        found = scaling_rows(ensemble, source=source, case_group="sizes", seed=seed, **fit)
        rows += [row | {"elements": ensemble["elements"].item()} for row in found]
    columns = COLUMNS | {"elements": ("elements of an indenter: of a disc, points of a line", "1")}
    table = pd.DataFrame(rows, columns=list(columns))
    write_table(table, csv, nc, columns=columns, dimension="fit", title="Power laws on grids from coarse to fine")


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output, **job.params)
