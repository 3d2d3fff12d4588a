"""Levels chosen for a scene by the package, by hand, and naively."""

import logging

import pandas as pd
from threadpoolctl import threadpool_limits

from viscorough_study.performance import timing
from viscorough_study.performance.level_placement import COLUMNS, compare, scenes
from viscorough_study.run.job_log import log_to
from viscorough_study.run.tables import recorded, write_table


def main(csv, nc, *, seed, repeats, elements, hurst):
    """Compare the choices for every scene."""
    with threadpool_limits(1):  # Snakemake gives the job all cores, so that nothing runs beside it
        table = pd.concat([compare(scene, repeats, logging.info) for scene in scenes(elements, hurst, seed)])
    settings = {"seed": seed, "repeats": repeats, "elements": elements, "hurst": hurst}
    about = recorded(settings=settings, machine=timing.machine())
    title = "Levels chosen for a scene"
    write_table(table, csv, nc, columns=COLUMNS, dimension="choice", title=title, attributes=about)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.output, **job.params)
