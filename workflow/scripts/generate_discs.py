"""Generate a batch of self-affine discs, and compute their rms heights by every definition."""

from viscorough_study.ensembles.discs import ensemble_discs
from viscorough_study.ensembles.realization import stored_settings
from viscorough_study.ensembles.surface_files import write_surfaces
from viscorough_study.run.job_log import run_job
from viscorough_study.run.made_with import made_with_text


def main(surfaces, *, ensembles, seed):
    """Generate the discs of a batch, and write them to a file with lengths in the unit of each disc.

    surfaces : file to write
    ensembles : settings of each ensemble and numbers of its discs in this batch, from `run.samples.batch_ensembles`
    seed : root seed of the seeds of all discs
    """
    settings = [stored_settings(ensemble, seed=seed) for ensemble in ensembles]
    sizes = [len(range(*ensemble["numbers"])) for ensemble in ensembles]
    discs = [ensemble_discs(**ensemble, seed=seed) for ensemble in ensembles]
    write_surfaces(zip(settings, sizes, discs, strict=True), surfaces, **made_with_text())


run_job(globals(), main)
