"""Loading curves of a batch of self-affine lines by the reduction of dimensionality; no line is stored."""

import json

import numpy as np

from viscorough.io.datasets import stack_curves, write_dataset
from viscorough.mdr import reduce
from viscorough.surfaces import self_affine_line
from viscorough_study.job_log import log_to, progress
from viscorough_study.seeds import realization_seed


def main(curves, *, seed, spawn_key, realizations, points, surface, until_x):
    """Indent the realizations realizations[0] <= number < realizations[1] until X = F/(4GhL) is until_x; lengths in m.

    surface : arguments of self_affine_line.
    """
    numbers = np.arange(*realizations)
    until_force = 4 * surface["rms"] * surface["length"] * until_x
    reduced = []
    for number in progress(numbers, len(numbers), "lines"):
        line = self_affine_line(points=points, **surface, seed=realization_seed(seed, *spawn_key, int(number)))
        reduced.append(reduce(line, until_force=until_force))
    settings = {"seed": seed, "spawn_key": [*spawn_key, "realization"], "points": points, "surface": surface}
    settings |= {"until_x": until_x}
    lengths = {
        "rms_line": ("realization", np.full(len(numbers), surface["rms"]), "rms height of the line"),  # all have it
        "spacing": ((), line.spacing, "spacing of the points"),
        "diameter": ((), surface["length"], "length of the line"),
    }
    lengths = {name: (*value, {"units": "m", "long_name": text}) for name, (*value, text) in lengths.items()}
    hurst = ((), surface["hurst"], {"long_name": "Hurst exponent", "units": "1"})
    ds = stack_curves(reduced, "m").assign(lengths).assign_coords(realization=numbers, hurst=hurst)
    write_dataset(ds.assign_attrs(settings=json.dumps(settings)), curves)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.output, **job.params)
