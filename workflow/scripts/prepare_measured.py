"""Read, check and prepare a measured surface for indentation."""

import logging

from viscorough_study.ensembles.measured import lengths, measured_indenter
from viscorough_study.ensembles.realization import Realization
from viscorough_study.ensembles.surface_files import write_surfaces
from viscorough_study.run.job_log import run_job
from viscorough_study.run.made_with import made_with_text


def main(heights, surfaces, *, name, group, **reading):
    """Read and prepare the scan of a measured surface, and write it to a file.

    heights : file of the scan; surfaces : file to write
    name : name of the scan; group : name of the group of scans that it belongs to
    reading : spacing, unit and preparation, arguments of `measured_indenter`
    """
    indenter = measured_indenter(heights, **reading)
    measured = lengths(indenter)
    logging.info("%s: %s", heights, measured)
    settings = {"name": name, "group": group, "file": str(heights), **reading, "lengths": measured}
    rms = {"disc": measured["rms"]}
    realization = Realization(name, 0, float("nan"), measured["diameter"], indenter.spacing, rms)
    write_surfaces([(settings, 1, [(realization, indenter)])], surfaces, **made_with_text())


run_job(globals(), main)
