"""Loading curve of a measured surface by boundary elements."""

import logging

from viscorough.contact.loading_path import indent
from viscorough.io import netcdf
from viscorough_study.comparisons.measured import lengths, measured_indenter
from viscorough_study.ensembles.batches import batch_of_curves
from viscorough_study.run.job_log import log_to


def main(heights, curves, *, name, group, indentation, **reading):
    """Indent one scan.

    name : of the scan; reading : spacing, unit, preparation
    indentation : tolerance and where the curve ends, as for the discs
    """
    indenter = measured_indenter(heights, **reading)
    about = lengths(indenter)
    logging.info("%s: %s", heights, about)
    until_force = 4 * about["rms"] * about["diameter"] * indentation["until_x"]
    limits = {"until_fraction": indentation["until_fraction"], "until_force": until_force}
    curve = indent(indenter, tolerance=indentation["tolerance"], **limits)
    settings = {"file": str(heights), "group": group, **reading, "indentation": indentation, "lengths": about}
    about = {"rms": {"disc": [about["rms"]]}, "spacing": [about["spacing"]], "diameter": [about["diameter"]]}
    about |= {"hurst": [float("nan")], "until_x": indentation["until_x"], "cases": [name]}
    content = batch_of_curves([curve], realizations=[0], settings=settings, **about)
    netcdf.write(content, curves)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output, **job.params)
