"""Loading curves of a batch of discs by boundary elements; no disc is stored."""

import logging
import time

from viscorough.contact.loading_path import indent
from viscorough.io import netcdf
from viscorough_study.batches import batch_of_curves, numbered, without_numbers
from viscorough_study.discs import ensemble_disc
from viscorough_study.job_log import log_to, progress
from viscorough_study.seeds import realization_seed


def main(curves, *, ensembles, seed, indentation):
    """Indent the realizations of a batch; all lengths in m.

    ensembles : the batch's, each with spawn_key, elements, surface (arguments of self_affine_disc) and numbers, first
        realization and the one after the last
    indentation : tolerance and where a curve ends, at a contact fraction or at X = F/(4GhL), with h the larger of the
        rms heights over disc and square
    """
    batch, indented, heights = numbered(ensembles), [], {}
    for one, number in progress(batch, len(batch), "indentations"):
        surface = one["surface"]
        disc, rms = ensemble_disc(one["elements"], surface, realization_seed(seed, *one["spawn_key"], number))
        until_force = 4 * max(rms["disc"], rms["square"]) * surface["diameter"] * indentation["until_x"]
        limits = {"until_fraction": indentation["until_fraction"], "until_force": until_force}
        start = time.perf_counter()
        curve = indent(disc, tolerance=indentation["tolerance"], **limits)
        about = number, curve.depth.size, curve.operator_applications, time.perf_counter() - start
        logging.info("realization %d: %d levels, %d operator applications, %.2f s", *about)
        indented.append(curve)
        heights = {name: [*heights.get(name, []), height] for name, height in rms.items()}
    settings = {"seed": seed, "indentation": indentation, "ensembles": without_numbers(ensembles)}
    diameters = [one["surface"]["diameter"] for one, _ in batch]
    spacing = [one["surface"]["diameter"] / one["elements"] for one, _ in batch]
    about = {"hurst": [one["surface"]["hurst"] for one, _ in batch], "realizations": [number for _, number in batch]}
    about |= {"rms": heights, "spacing": spacing, "diameter": diameters, "settings": settings}
    netcdf.write(batch_of_curves(indented, **about), curves)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.output, **job.params)
