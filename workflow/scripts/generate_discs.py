"""Generate a batch of self-affine discs, and compute their rms heights by every definition."""

from viscorough_study.ensembles.batches import Realization, without_numbers
from viscorough_study.ensembles.discs import ensemble_disc
from viscorough_study.ensembles.surface_files import write_surfaces
from viscorough_study.run.job_log import run_job
from viscorough_study.run.made_with import made_with_text
from viscorough_study.run.seeds import realization_seed


def main(surfaces, *, ensembles, seed):
    """Generate the discs of a batch, and write them to a file with lengths in the unit of each disc.

    surfaces : file to write
    ensembles : settings of each ensemble and numbers of its discs in this batch, from `run.cases.batch_ensembles`
    seed : root seed of the seeds of all discs
    """

    def discs(name, spawn_key, surface, elements, numbers):
        for number in range(*numbers):
            disc, rms = ensemble_disc(elements, surface, realization_seed(seed, *spawn_key, number))
            yield Realization(name, number, surface["hurst"], surface["diameter"], disc.spacing, rms), disc

    settings = [{"seed": seed} | ensemble for ensemble in without_numbers(ensembles)]
    sizes = [len(range(*ensemble["numbers"])) for ensemble in ensembles]
    write_surfaces(
        zip(settings, sizes, (discs(**ensemble) for ensemble in ensembles), strict=True), surfaces, **made_with_text()
    )


run_job(globals(), main)
