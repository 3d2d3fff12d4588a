"""One disc of every Hurst exponent, to be looked at: realization 0 of the first combination, with h = L = 1."""

import numpy as np
import xarray as xr

from viscorough.io.datasets import write_dataset
from viscorough.surfaces import self_affine_disc
from viscorough_study.run.job_log import log_to
from viscorough_study.run.seeds import realization_seed


def main(surfaces, *, seed, spawn_keys, elements, discs):
    """Heights over (hurst, y, x).

    spawn_keys : spawn key of each disc; discs : arguments of self_affine_disc, one dict for each disc.
    """
    heights = [
        self_affine_disc(elements_across=elements, **disc, seed=realization_seed(seed, *spawn_key, 0)).heights
        for disc, spawn_key in zip(discs, spawn_keys, strict=True)
    ]
    variables = {
        "heights": (("hurst", "y", "x"), np.array(heights), {"long_name": "height over rms height", "units": "1"}),
        "spacing": ((), 1 / elements, {"long_name": "spacing of the grid over diameter", "units": "1"}),
    }
    coords = {"hurst": ("hurst", [disc["hurst"] for disc in discs], {"long_name": "Hurst exponent", "units": "1"})}
    write_dataset(xr.Dataset(variables, coords, {"title": "Examples of self-affine discs"}), surfaces)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.output, **job.params)
