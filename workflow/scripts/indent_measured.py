"""Compute the loading curve of a measured surface by boundary elements."""

from viscorough.io import netcdf
from viscorough_study.ensembles.indentation import curves_of_surfaces
from viscorough_study.ensembles.surface_files import read_surfaces
from viscorough_study.run.job_log import run_job


def main(surfaces, curves, *, indentation):
    """Compute the loading curve of every surface in a file, and write the curves in the unit of the surface.

    surfaces : file of the surfaces; curves : file to write
    indentation : further arguments of `indent_realization`
    """
    netcdf.write(curves_of_surfaces(read_surfaces(surfaces), indentation), curves)


run_job(globals(), main)
