"""Cost of the loading curve of one disc: time, operator applications and memory."""

import json

import pandas as pd

from viscorough.io import netcdf
from viscorough.io.atomic import atomic_write
from viscorough.io.curves import stack_curves
from viscorough_study.performance.large_discs import measure_disc
from viscorough_study.run.job_log import log_to
from viscorough_study.run.seeds import large_disc_key, realization_seed


def main(csv, curve, *, elements, threads, seed, hurst, tolerance, until_fraction, warm_up):
    """Measure a disc of `elements` elements across; the other parameters are those of measure_disc."""
    key = large_disc_key(elements)
    options = {"tolerance": tolerance, "until_fraction": until_fraction, "warm_up": warm_up, "threads": threads}
    loading_curve, cost = measure_disc(hurst, elements, realization_seed(seed, *key), **options)
    settings = {"seed": seed, "spawn_key": key, "hurst": hurst, "until_fraction": until_fraction}
    attributes = {"title": "A disc on a fine grid", "settings": json.dumps(settings)}
    netcdf.write(stack_curves([loading_curve]).with_attributes(**attributes), curve)
    with atomic_write(csv) as temporary:
        pd.DataFrame([cost]).to_csv(temporary, index=False)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.output, elements=int(job.wildcards.elements), threads=job.threads, **job.params)
