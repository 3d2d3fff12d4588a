"""Loading curves of a batch of discs by boundary elements; no disc is stored."""

import logging
import time

from viscorough.contact.loading_path import indent
from viscorough.io import netcdf
from viscorough_study.batches import batch_of_curves
from viscorough_study.discs import ensemble_disc
from viscorough_study.job_log import log_to, progress
from viscorough_study.seeds import realization_seed


def main(curves, *, realizations, seed, spawn_key, elements, surface, indentation):
    """Indent the realizations realizations[0] <= number < realizations[1]; all lengths in m.

    surface : arguments of self_affine_disc; indentation : tolerance and where a curve ends, at a contact fraction or
        at X = F/(4GhL), with h the larger of the rms heights over disc and square
    """
    numbers, indented, heights = range(*realizations), [], {}
    for number in progress(numbers, len(numbers), "indentations"):
        disc, rms = ensemble_disc(elements, surface, realization_seed(seed, *spawn_key, number))
        until_force = 4 * max(rms["disc"], rms["square"]) * surface["diameter"] * indentation["until_x"]
        limits = {"until_fraction": indentation["until_fraction"], "until_force": until_force}
        start = time.perf_counter()
        curve = indent(disc, tolerance=indentation["tolerance"], **limits)
        about = number, curve.depth.size, curve.operator_applications, time.perf_counter() - start
        logging.info("realization %d: %d levels, %d operator applications, %.2f s", *about)
        indented.append(curve)
        heights = {name: [*heights.get(name, []), height] for name, height in rms.items()}
    settings = {"seed": seed, "spawn_key": [*spawn_key, "realization"], "elements": elements, "surface": surface}
    lengths = {"rms": heights, "spacing": surface["diameter"] / elements, "diameter": surface["diameter"]}
    about = {"hurst": surface["hurst"], "settings": settings | {"indentation": indentation}, **lengths}
    netcdf.write(batch_of_curves(indented, realizations=numbers, **about), curves)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.output, **job.params)
