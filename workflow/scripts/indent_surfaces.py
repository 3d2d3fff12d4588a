"""Compute the loading curves of a batch of generated or measured surfaces by boundary elements."""

import logging
import time

from viscorough_study.ensembles.curve_files import write_curves
from viscorough_study.ensembles.indentation import indent_realization
from viscorough_study.ensembles.surface_files import read_surfaces
from viscorough_study.run.job_log import run_job
from viscorough_study.run.made_with import made_with_text


def main(surfaces, curves, *, indentation):
    """Compute the loading curve of every surface in a file, and write the curves in the unit of the surface.

    surfaces : file of the surfaces; curves : file to write
    indentation : further arguments of `indent_realization`
    """
    made = []
    for settings, realization, indenter in read_surfaces(surfaces):
        start = time.perf_counter()
        realization, curve = indent_realization(realization, indenter, **indentation)
        cost = curve.depth.size, curve.operator_applications, time.perf_counter() - start
        logging.info("realization %d: %d levels, %d operator applications, %.2f s", realization.number, *cost)
        made.append((settings | {"indentation": indentation}, realization, curve))
    write_curves(made, curves, **made_with_text())


run_job(globals(), main)
