"""Table of the plateaus of the local slope: discs, and a control without a power law."""

import logging

import numpy as np
import pandas as pd

from viscorough.io.datasets import read_dataset
from viscorough_study.ensembles.pool import ensembles, select
from viscorough_study.fits.plateau import COLUMNS, plateau_row
from viscorough_study.run.job_log import log_to
from viscorough_study.run.seeds import plateau_key, realization_seed
from viscorough_study.run.tables import recorded, write_table


def main(discs, csv, nc, *, control, rms_convention, seed, **how):
    """Judge the ensembles of every Hurst exponent; control : group without a power law; how : of plateau_row."""
    pool = read_dataset(discs).sel(rms_convention=[rms_convention])
    groups = {name: ensembles(select(pool, group=name), "hurst") for name in ("base", control) if name}
    rows = []
    for group, members in groups.items():
        for hurst, ensemble in sorted(members.items()):
            logging.info("%s, H = %g", group, hurst)
            random = np.random.default_rng(realization_seed(seed, *plateau_key(hurst, group)))
            compared = groups[control][hurst].isel(rms_convention=0) if control else None
            row = plateau_row(ensemble.isel(rms_convention=0), compared, random=random, **how)
            rows.append({"case_group": group, **row})
    table = pd.DataFrame(rows, columns=list(COLUMNS))
    about = {"title": "Plateaus of the local slope", "attributes": recorded(settings={"seed": seed, **how})}
    write_table(table, csv, nc, columns=COLUMNS, dimension="ensemble", **about)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output, **job.params)
