"""A batch of self-affine discs of one case."""

import json

import numpy as np
import xarray as xr

from viscorough.io.datasets import write_dataset
from viscorough.surfaces import self_affine_disc
from viscorough_study.job_log import log_to
from viscorough_study.seeds import realization_seed


def main(surfaces, *, seed, spawn_key, realizations, elements, surface):
    """Heights of the realizations realizations[0] <= number < realizations[1]; all lengths in m.

    surface : arguments of self_affine_disc. Whatever rms_over, the rms heights over disc and square are both stored.
    """
    numbers = np.arange(*realizations)
    shape, key = surface | {"elements_across": elements, "rms_over": "square"}, (seed, *spawn_key)
    heights = np.array([self_affine_disc(**shape, seed=realization_seed(*key, int(n))).heights for n in numbers])
    over_disc, mean = np.nanstd(heights, axis=(1, 2)), np.nanmean(heights, axis=(1, 2))
    factor = surface["rms"] / (over_disc if surface["rms_over"] == "disc" else np.full(len(numbers), surface["rms"]))
    variables = {
        "heights": (("realization", "y", "x"), heights * factor[:, None, None], "height, larger is higher"),
        "rms_disc": ("realization", over_disc * factor, "rms height over the disc"),
        "rms_peak": ("realization", (np.nanmax(heights, (1, 2)) - mean) * factor, "highest peak above the mean"),
        "rms_square": ("realization", surface["rms"] * factor, "rms height over the periodic square"),
        "spacing": ((), surface["diameter"] / elements, "spacing of the grid"),
        "diameter": ((), surface["diameter"], "diameter"),
    }
    variables = {name: (*value, {"long_name": text, "units": "m"}) for name, (*value, text) in variables.items()}
    coords = {"realization": numbers, "hurst": ((), surface["hurst"], {"long_name": "Hurst exponent", "units": "1"})}
    about = {"seed": seed, "spawn_key": [*spawn_key, "realization"], "elements": elements, "surface": surface}
    about = {"title": "Self-affine discs", "settings": json.dumps(about)}
    write_dataset(xr.Dataset(variables, coords, about), surfaces)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.output, **job.params)
