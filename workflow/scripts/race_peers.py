"""The path and other solvers on the same levels, at the same residual."""

import logging
from pathlib import Path

import numpy as np
import pandas as pd
from threadpoolctl import threadpool_limits

from viscorough_study.job_log import log_to
from viscorough_study.performance import timing
from viscorough_study.performance.other_solvers import COLUMNS, Peer, race
from viscorough_study.seeds import realization_seed, solver_race_key
from viscorough_study.tables import write_table


def main(csv, nc, *, seed, hurst, repeats, longest, tasks, peers):
    """Race on every task for every Hurst exponent; peers that are not installed are left out."""
    everyone = [Peer(name, *map(Path, paths)) for name, paths in peers.items()]
    present = [peer for peer in everyone if peer.present]
    for peer in set(everyone) - set(present):
        logging.warning("%s is not installed: left out (make peers installs it)", peer.name)
    tables = []
    threadpool_limits(1)  # of the path, for good; Snakemake gives the job all cores, so that nothing runs beside it
    for number, task in enumerate(tasks):
        fractions = np.geomspace(*task["fractions"], task["levels"]) if task["levels"] > 1 else task["fractions"][:1]
        for each in hurst:
            common = {"threads": task["threads"], "repeats": repeats, "longest": longest, "report": logging.info}
            disc_seed = realization_seed(seed, *solver_race_key(number, each))
            race_of = (task["name"], each, task["elements"], fractions, task["residual"], present)
            tables.append(race(*race_of, seed=disc_seed, **common))
    title = f"The same levels by other solvers, on {timing.machine()}"
    write_table(pd.concat(tables), csv, nc, columns=COLUMNS, dimension="measurement", title=title)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.output, **job.params)
