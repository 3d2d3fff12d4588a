"""Compute loading curves of a batch of self-affine lines by dimensionality reduction; no line is stored."""

from viscorough.io import netcdf
from viscorough.mdr import reduce_heights
from viscorough.surfaces.lines import SelfAffineLines
from viscorough_study.ensembles.batches import Realization, batch_of_curves, without_numbers
from viscorough_study.run.job_log import run_job
from viscorough_study.run.made_with import made_with_text
from viscorough_study.run.seeds import realization_seed


def main(curves, *, ensembles, seed, until_x):
    """Generate a batch of lines, and write their loading curves up to X = F/(4GhL) = until_x; lengths have no unit.

    curves : file to write; seed : root seed of the seeds of all lines
    ensembles : settings of each ensemble and numbers of its lines in this batch, from `run.cases.batch_ensembles`
    """
    members = []
    for ensemble in ensembles:
        surface = ensemble["surface"]
        # all realizations of the ensemble share this object
        lines = SelfAffineLines(points=ensemble["points"], **surface)
        until_force = 4 * surface["rms"] * surface["length"] * until_x
        lengths = surface["length"], lines.spacing, {"line": surface["rms"]}  # every line has the nominal rms height
        for number in range(*ensemble["numbers"]):
            heights = lines.heights_in_any_order(realization_seed(seed, *ensemble["spawn_key"], number))
            curve = reduce_heights(heights, lines.spacing, until_force=until_force)
            members.append((curve, Realization(ensemble["name"], number, surface["hurst"], *lengths), until_x))
    settings = {"seed": seed, "until_x": until_x, "ensembles": without_numbers(ensembles)}
    netcdf.write(batch_of_curves(members, settings).with_attributes(**made_with_text()), curves)


run_job(globals(), main)
