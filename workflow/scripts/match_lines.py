"""Tables of λ over X, of the residual error of a single λ, and of exponents of lines and discs in equal windows."""

import numpy as np

from viscorough.io.datasets import read_dataset
from viscorough_study.comparisons import mdr_equivalence
from viscorough_study.ensembles.pool import ensembles, select
from viscorough_study.run.job_log import log_to
from viscorough_study.run.tables import recorded, write_table

TABLES = (
    ("", mdr_equivalence.LAMBDA_COLUMNS, "point", "λ of lines that stand for discs"),
    ("summary_", mdr_equivalence.SUMMARY_COLUMNS, "exponent", "Residual error of a single λ"),
    ("exponents_", mdr_equivalence.EXPONENT_COLUMNS, "fit", "Exponents of lines and discs in equal windows"),
)


def main(discs, lines, *, seed, fit, conventions, **paths):
    """Compare the pools of base discs and lines; fit : settings of region (b); paths : of the tables."""
    discs, lines = select(read_dataset(discs), group="base"), read_dataset(lines)
    discs = discs.sel(rms_convention=[conventions["rms_convention"]])
    lines = lines.isel(realization=np.flatnonzero(np.isin(lines["hurst"], discs["hurst"])))
    pair = (
        {hurst: one.isel(rms_convention=0) for hurst, one in ensembles(pool, "hurst").items()}
        for pool in (discs, lines)
    )
    tables = mdr_equivalence.compare_ensembles(*pair, average=conventions["average"], seed=seed, **fit)
    about = recorded(settings={"seed": seed, "conventions": conventions, **fit})
    for table, (name, columns, dimension, title) in zip(tables, TABLES, strict=True):
        files = [paths[name + kind] for kind in ("csv", "nc")]
        write_table(table, *files, columns=columns, dimension=dimension, title=title, attributes=about)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output, **job.params)
