"""A batch of self-affine discs of one case."""

import json

import numpy as np
import xarray as xr

from viscorough.joblog import log_to
from viscorough.storage import write_dataset
from viscorough.surfaces import realization_seed, self_affine_disc


def main(surfaces, *, seed, spawn_key, realizations, elements, surface):
    """Heights of the realizations realizations[0] <= number < realizations[1]; all lengths in m.

    surface : arguments of self_affine_disc. Whatever rms_over, the rms heights over disc and square are both stored.
    """
    numbers = np.arange(*realizations)
    seeds = [realization_seed(seed, *spawn_key, int(number)) for number in numbers]
    shape = surface | {"elements_across": elements, "rms_over": "square"}
    heights = np.array([self_affine_disc(**shape, seed=one).heights for one in seeds])
    over_disc = np.nanstd(heights, axis=(1, 2))
    factor = surface["rms"] / (over_disc if surface["rms_over"] == "disc" else np.full(len(numbers), surface["rms"]))
    variables = {
        "heights": (("realization", "y", "x"), heights * factor[:, None, None], "height, larger is higher"),
        "rms_disc": ("realization", over_disc * factor, "rms height over the disc"),
        "rms_square": ("realization", surface["rms"] * factor, "rms height over the periodic square"),
        "spacing": ((), surface["diameter"] / elements, "spacing of the grid"),
        "diameter": ((), surface["diameter"], "diameter"),
    }
    variables = {name: (*value, {"long_name": text, "units": "m"}) for name, (*value, text) in variables.items()}
    settings = {"seed": seed, "spawn_key": [*spawn_key, "realization"], "elements": elements, "surface": surface}
    attributes = {"title": "Self-affine discs", "settings": json.dumps(settings)}
    coords = {"realization": numbers, "hurst": ((), surface["hurst"], {"long_name": "Hurst exponent", "units": "1"})}
    write_dataset(xr.Dataset(variables, coords, attributes), surfaces)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.output, **job.params)
