"""Generate a batch of self-affine discs, and compute their loading curves by boundary elements; no disc is stored."""

from viscorough.io import netcdf
from viscorough_study.ensembles.batches import without_numbers
from viscorough_study.ensembles.discs import ensemble_discs
from viscorough_study.ensembles.indentation import curves_of_surfaces
from viscorough_study.run.job_log import run_job


def main(curves, *, ensembles, seed, indentation):
    """Generate the discs of a batch, and write their loading curves, with lengths in the unit of each disc.

    curves : file to write
    ensembles : settings of each ensemble and numbers of its discs in this batch, from `run.cases.batch_ensembles`
    seed : root seed of the seeds of all discs; indentation : further arguments of `indent_realization`
    """
    settings = [{"seed": seed} | ensemble for ensemble in without_numbers(ensembles)]
    surfaces = (
        (stored, *disc)
        for stored, ensemble in zip(settings, ensembles, strict=True)
        for disc in ensemble_discs(seed, **ensemble)
    )
    netcdf.write(curves_of_surfaces(surfaces, indentation), curves)


run_job(globals(), main)
