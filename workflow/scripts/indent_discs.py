"""Loading curves of a batch of discs by boundary elements; no disc is stored."""

import logging
import time

from viscorough.io import netcdf
from viscorough_study.ensembles.batches import batch_of_curves, numbered, without_numbers
from viscorough_study.ensembles.discs import end_of_curve, ensemble_disc, indent_disc
from viscorough_study.run.job_log import log_to, progress
from viscorough_study.run.seeds import realization_seed


def main(curves, *, ensembles, seed, indentation):
    """Indent the realizations of a batch; all lengths in m.

    ensembles : of `viscorough_study.run.cases.ensembles_of_batch`; surface : arguments of self_affine_disc
    indentation : tolerance and until_fraction, as in `indent_disc`, and where curves end, as in `end_of_curve`
    """
    batch, indented, heights = numbered(ensembles), [], []
    accuracy = {name: indentation[name] for name in ("tolerance", "until_fraction")}
    until_x = [end_of_curve(number, indentation) for _, number in batch]
    for (one, number), end in zip(progress(batch, len(batch), "indentations"), until_x, strict=True):
        start = time.perf_counter()
        disc, rms = ensemble_disc(one["elements"], one["surface"], realization_seed(seed, *one["spawn_key"], number))
        curve = indent_disc(disc, rms, one["surface"]["diameter"], until_x=end, **accuracy)
        about = number, curve.depth.size, curve.operator_applications, time.perf_counter() - start
        logging.info("realization %d: %d levels, %d operator applications, %.2f s", *about)
        indented.append(curve)
        heights.append(rms)
    settings = {"seed": seed, "indentation": indentation, "ensembles": without_numbers(ensembles)}
    about = {name: [one["surface"][name] for one, _ in batch] for name in ("hurst", "diameter")}
    about |= {"spacing": [one["surface"]["diameter"] / one["elements"] for one, _ in batch], "settings": settings}
    about |= {"rms": {name: [rms[name] for rms in heights] for name in heights[0]}, "until_x": until_x}
    about |= {"cases": [one["name"] for one, _ in batch], "realizations": [number for _, number in batch]}
    netcdf.write(batch_of_curves(indented, **about), curves)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.output, **job.params)
