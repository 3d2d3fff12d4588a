"""The path and other solvers on the same levels, at the same residual."""

import logging
from pathlib import Path

import numpy as np
import pandas as pd
from threadpoolctl import threadpool_limits

from viscorough_study.performance import timing
from viscorough_study.performance.other_solvers import OtherSolver
from viscorough_study.performance.solver_comparison import COLUMNS, compare_solvers, disc_task
from viscorough_study.run.job_log import log_to
from viscorough_study.run.seeds import realization_seed, solver_race_key
from viscorough_study.run.tables import recorded, write_table


def main(csv, nc, *, seed, hurst, pairs, longest, tasks, peers):
    """Compare on every task for every Hurst exponent; other solvers that are not installed are left out."""
    solvers = [OtherSolver(name, *map(Path, paths)) for name, paths in peers.items()]
    for solver in solvers:
        if not solver.installed:
            logging.warning("%s is not installed: left out (make peers installs it)", solver.name)
    installed = [solver for solver in solvers if solver.installed]
    tables = []
    threadpool_limits(1)  # of linear algebra, for good; Snakemake gives the job all cores: nothing runs beside it
    for number, task in enumerate(tasks):
        fractions = np.geomspace(*task["fractions"], task["levels"]) if task["levels"] > 1 else task["fractions"][:1]
        for each in hurst:
            of_disc = {"seed": realization_seed(seed, *solver_race_key(number, each)), "threads": task["threads"]}
            levels = disc_task(task["name"], each, task["elements"], fractions, task["residual"], **of_disc)
            common = {"pairs": pairs, "time_limit": longest, "report": logging.info}
            tables.append(compare_solvers(levels, installed, **common))
    about = {"title": "The same levels by other solvers", "attributes": recorded(machine=timing.machine())}
    write_table(pd.concat(tables), csv, nc, columns=COLUMNS, dimension="measurement", **about)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.output, **job.params)
