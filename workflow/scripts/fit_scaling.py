"""Table of exponents and prefactors: every ensemble under every convention of averaging, window and law."""

import logging

import pandas as pd

from viscorough.io.datasets import read_dataset
from viscorough_study.ensembles import combine
from viscorough_study.job_log import log_to
from viscorough_study.power_law import COLUMNS, scaling_rows
from viscorough_study.tables import write_table


def main(discs, lines, csv, nc, *, groups, seed, fit):
    """Fit discs, pooled per Hurst exponent and group, and lines; lines of the same exponent give lambda.

    groups : group of every file of `discs`; fit : further arguments of scaling_rows.
    """
    of_hurst = {ds["hurst"].item(): ds for ds in map(read_dataset, lines)}
    pooled = {}
    for path, group in zip(discs, groups, strict=True):
        ds = read_dataset(path)
        pooled.setdefault((group, ds["hurst"].item()), []).append(ds)
    rows = []
    for (group, hurst), ensembles in pooled.items():
        logging.info("discs, %s, H = %g", group, hurst)
        matching = of_hurst[hurst] if group == "base" else None
        about = {"source": "discs", "case_group": group, "lines": matching}
        rows += scaling_rows(combine(ensembles), **about, seed=seed, **fit)
    for hurst, ensemble in of_hurst.items():
        logging.info("lines, H = %g", hurst)
        rows += scaling_rows(ensemble, source="lines", case_group="base", seed=seed, **fit)
    table = pd.DataFrame(rows, columns=list(COLUMNS))
    write_table(table, csv, nc, columns=COLUMNS, dimension="fit", title="Power laws in region (b)")


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output, **job.params)
