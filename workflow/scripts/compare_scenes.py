"""Levels chosen for a scene by the package, by hand, and naively."""

import logging

import pandas as pd
from threadpoolctl import threadpool_limits

from viscorough import timing
from viscorough.joblog import log_to
from viscorough.scenes import COLUMNS, compare, scenes
from viscorough.storage import write_table


def main(csv, nc, *, seed, repeats, elements, hurst):
    """Compare the choices for every scene."""
    with threadpool_limits(1):  # Snakemake gives the job all cores, so that nothing runs beside it
        table = pd.concat([compare(scene, repeats, logging.info) for scene in scenes(elements, hurst, seed)])
    title = f"Levels chosen for a scene, on {timing.machine()}"
    write_table(table, csv, nc, columns=COLUMNS, dimension="choice", title=title)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.output, **job.params)
