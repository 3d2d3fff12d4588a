"""Compute the loading curves of a batch of generated or measured surfaces by boundary elements."""

import logging
import time

from viscorough.io import netcdf
from viscorough_study.ensembles.batches import batch_of_curves
from viscorough_study.ensembles.indentation import indent_realization
from viscorough_study.ensembles.surface_files import read_surfaces
from viscorough_study.run.job_log import run_job
from viscorough_study.run.made_with import made_with_text


def main(surfaces, curves, *, indentation):
    """Compute the loading curve of every surface in a file, and write the curves in the unit of the surface.

    surfaces : file of the surfaces; curves : file to write
    indentation : further arguments of `indent_realization`
    """
    members, ensembles = [], []
    for ensemble, realization, indenter in read_surfaces(surfaces):
        start = time.perf_counter()
        curve, until_x = indent_realization(realization, indenter, **indentation)
        cost = curve.depth.size, curve.operator_applications, time.perf_counter() - start
        logging.info("realization %d: %d levels, %d operator applications, %.2f s", realization.number, *cost)
        members.append((curve, realization, until_x))
        if ensemble not in ensembles:
            ensembles.append(ensemble)
    settings = {"indentation": indentation, "ensembles": ensembles}
    netcdf.write(batch_of_curves(members, settings).with_attributes(**made_with_text()), curves)


run_job(globals(), main)
