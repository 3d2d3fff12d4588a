"""Table of exponents and prefactors: every ensemble under every convention of averaging, window and law."""

import logging

import pandas as pd

from viscorough.io.datasets import read_dataset
from viscorough_study.ensembles.pool import ensembles, select
from viscorough_study.fits.fit_table import COLUMNS, fit_rows
from viscorough_study.run.job_log import log_to
from viscorough_study.run.tables import recorded, write_table


def main(discs, lines, csv, nc, *, seed, fit):
    """Fit discs, one ensemble for each group and Hurst exponent, and lines; lines of the same exponent give lambda.

    discs, lines : pools; fit : further arguments of fit_rows
    """
    discs, lines = read_dataset(discs), ensembles(read_dataset(lines), "hurst")
    rows = []
    for group in dict.fromkeys(discs["group"].values.tolist()):
        for hurst, ensemble in ensembles(select(discs, group=group), "hurst").items():
            logging.info("discs, %s, H = %g", group, hurst)
            about = {"source": "discs", "case_group": group, "lines": lines[hurst] if group == "base" else None}
            rows += fit_rows(ensemble, **about, seed=seed, **fit)
    for hurst, ensemble in lines.items():
        logging.info("lines, H = %g", hurst)
        rows += fit_rows(ensemble, source="lines", case_group="base", seed=seed, **fit)
    table = pd.DataFrame(rows, columns=list(COLUMNS))
    about = {"title": "Power laws in region (b)", "attributes": recorded(settings={"seed": seed, **fit})}
    write_table(table, csv, nc, columns=COLUMNS, dimension="fit", **about)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output, **job.params)
