"""Generate self-affine discs, and compute their rms heights by every definition."""

from viscorough_study.ensembles.batches import without_numbers
from viscorough_study.ensembles.discs import ensemble_discs
from viscorough_study.ensembles.surface_files import write_surfaces
from viscorough_study.run.job_log import run_job


def main(surfaces, *, ensembles, seed):
    """Generate the discs of several ensembles, and write them to a file with lengths in the unit of each disc.

    surfaces : file to write
    ensembles : settings of each ensemble and numbers of its discs, from `run.cases.example_discs`
    seed : root seed of the seeds of all discs
    """
    settings = [{"seed": seed} | ensemble for ensemble in without_numbers(ensembles)]
    sizes = [len(range(*ensemble["numbers"])) for ensemble in ensembles]
    discs = (ensemble_discs(seed, **ensemble) for ensemble in ensembles)
    write_surfaces(zip(settings, sizes, discs, strict=True), surfaces)


run_job(globals(), main)
