"""Loading curves of a batch of discs by boundary elements."""

import json
import logging
import time

from viscorough.contact.loading_path import indent
from viscorough.indenter import Indenter
from viscorough.io.datasets import read_dataset, stack_curves, write_dataset
from viscorough_study.job_log import log_to, progress


def main(surfaces, curves, *, tolerance, until_fraction, until_x):
    """Indent every disc until the contact fraction or X = F/(4GhL) is reached, h the larger of its rms heights."""
    discs = read_dataset(surfaces)
    indented = []
    for index in progress(range(discs.sizes["realization"]), discs.sizes["realization"], "indentations"):
        disc = discs.isel(realization=index)
        rms = max(disc["rms_disc"].item(), disc["rms_square"].item())
        indenter = Indenter(disc["heights"].values, disc["spacing"].item())
        start = time.perf_counter()
        curve = indent(
            indenter,
            tolerance=tolerance,
            until_fraction=until_fraction,
            until_force=4 * rms * disc["diameter"].item() * until_x,
        )
        seconds = time.perf_counter() - start
        about = disc["realization"].item(), curve.depth.size, curve.operator_applications, seconds
        logging.info("realization %d: %d levels, %d operators on the grid, %.2f s", *about)
        indented.append(curve)
    ds = stack_curves(indented, "m").assign(discs.drop_vars("heights"))
    indentation = {"tolerance": tolerance, "until_fraction": until_fraction, "until_x": until_x}
    settings = json.loads(discs.attrs["settings"]) | {"indentation": indentation}
    write_dataset(ds.assign_attrs(settings=json.dumps(settings)), curves)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output, **job.params)
