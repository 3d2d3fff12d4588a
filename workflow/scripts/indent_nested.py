"""Compute the curves of the same discs on a grid and on the next coarser grid; no disc is stored."""

from viscorough.io import netcdf
from viscorough_study.ensembles.nested_grids import nested_curves
from viscorough_study.run.job_log import run_job


def main(curves, *, case, tolerance, seed):
    """Generate and indent the discs of a case, and write their curves.

    curves : file to write; case : arguments of `nested_curves`, from `run.cases.nested_cases`
    tolerance, seed : further arguments of `nested_curves`
    """
    netcdf.write(nested_curves(**case, tolerance=tolerance, seed=seed), curves)


run_job(globals(), main)
