"""Loading curves of a batch of surfaces, generated or measured, by boundary elements."""

import logging
import time

from viscorough.io import netcdf
from viscorough_study.ensembles.batches import batch_of_curves
from viscorough_study.ensembles.indentation import end_of_curve, indent_surface
from viscorough_study.ensembles.surface_files import read_surfaces
from viscorough_study.run.job_log import log_to


def main(surfaces, curves, *, indentation):
    """Indent the surfaces in a file; lengths in m.

    indentation : tolerance and until_fraction, as in `indent_surface`, and where curves end, as in `end_of_curve`
    """
    indented, realizations, until_x, ensembles = [], [], [], []
    accuracy = {name: indentation[name] for name in ("tolerance", "until_fraction")}
    for ensemble, realization, indenter in read_surfaces(surfaces):
        start, end = time.perf_counter(), end_of_curve(realization.number, indentation)
        curve = indent_surface(indenter, realization.rms, realization.diameter, until_x=end, **accuracy)
        cost = curve.depth.size, curve.operator_applications, time.perf_counter() - start
        logging.info("realization %d: %d levels, %d operator applications, %.2f s", realization.number, *cost)
        indented.append(curve)
        realizations.append(realization)
        until_x.append(end)
        if ensemble not in ensembles:
            ensembles.append(ensemble)
    settings = {"indentation": indentation, "ensembles": ensembles}
    netcdf.write(batch_of_curves(indented, realizations, until_x=until_x, settings=settings), curves)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output, **job.params)
