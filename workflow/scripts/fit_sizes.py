"""Table of exponents and prefactors of ensembles on grids from coarse to fine, and of their trends."""

import pandas as pd

from viscorough.io.datasets import read_dataset
from viscorough_study.ensembles.pool import ensembles, select
from viscorough_study.fits.fit_table import COLUMNS, fit_rows
from viscorough_study.fits.grid_trends import COLUMNS as TRENDS
from viscorough_study.fits.grid_trends import fixed_window_rows, trends
from viscorough_study.run.job_log import log_to, progress
from viscorough_study.run.tables import write_table


def main(discs, lines, csv, nc, trends_csv, trends_nc, *, seed, fit, windows, conventions, tolerance):
    """Fit every ensemble by itself, in the windows of region (b) and in those of fixed X.

    discs, lines : pools; fit : further arguments of fit_rows; windows : [(X_low, X_high)]
    conventions : those of the figures; tolerance : of the exponents
    """
    fixed = {name: fit[name] for name in ("elements_min", "fraction_min", "resamples")} | {"seed": seed}
    fixed |= {name: conventions[name] for name in ("average", "rms_convention")}
    discs, lines, rows = read_dataset(discs), read_dataset(lines), []
    for source, group, pool in (("discs", "sizes", discs), ("discs", "controls", discs), ("lines", "sizes", lines)):
        about = {"source": source, "case_group": group}
        grids = ensembles(select(pool, group=group), "hurst", "elements").values()
        for ensemble in progress(grids, len(grids), f"{source}, {group}"):
            fits = fit_rows(ensemble, **about, seed=seed, **fit) + fixed_window_rows(ensemble, windows, about, **fixed)
            rows += [row | {"elements": ensemble["elements"].item()} for row in fits]
    columns = COLUMNS | {"elements": ("elements of an indenter: of a disc, points of a line", "1")}
    table = pd.DataFrame(rows, columns=list(columns))
    write_table(table, csv, nc, columns=columns, dimension="fit", title="Power laws on grids from coarse to fine")
    about = {"columns": TRENDS, "dimension": "trend", "title": "Trends of exponents over the number of elements"}
    write_table(trends(table, conventions, tolerance), trends_csv, trends_nc, **about)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output, **job.params)
