"""Loading curves of a batch of discs by boundary elements; no disc is stored."""

import logging
import time

from viscorough.io import netcdf
from viscorough_study.batches import batch_of_curves, numbered, without_numbers
from viscorough_study.discs import ensemble_disc, indent_disc
from viscorough_study.job_log import log_to, progress
from viscorough_study.seeds import realization_seed


def main(curves, *, ensembles, seed, indentation):
    """Indent the realizations of a batch; all lengths in m.

    ensembles : the batch's, each with spawn_key, elements, surface (arguments of self_affine_disc) and numbers, first
        realization and the one after the last; indentation : as in `indent_disc`
    """
    batch, indented, heights = numbered(ensembles), [], []
    for one, number in progress(batch, len(batch), "indentations"):
        start = time.perf_counter()
        disc, rms = ensemble_disc(one["elements"], one["surface"], realization_seed(seed, *one["spawn_key"], number))
        curve = indent_disc(disc, rms, one["surface"]["diameter"], **indentation)
        about = number, curve.depth.size, curve.operator_applications, time.perf_counter() - start
        logging.info("realization %d: %d levels, %d operator applications, %.2f s", *about)
        indented.append(curve)
        heights.append(rms)
    settings = {"seed": seed, "indentation": indentation, "ensembles": without_numbers(ensembles)}
    about = {name: [one["surface"][name] for one, _ in batch] for name in ("hurst", "diameter")}
    about |= {"spacing": [one["surface"]["diameter"] / one["elements"] for one, _ in batch], "settings": settings}
    about |= {"rms": {name: [rms[name] for rms in heights] for name in heights[0]}}
    netcdf.write(batch_of_curves(indented, realizations=[number for _, number in batch], **about), curves)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.output, **job.params)
