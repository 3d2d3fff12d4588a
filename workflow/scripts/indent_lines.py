"""Loading curves of a batch of self-affine lines by the reduction of dimensionality; no line is stored."""

from viscorough.io import netcdf
from viscorough.mdr import reduce
from viscorough.surfaces import self_affine_line
from viscorough_study.batches import batch_of_curves, numbered, without_numbers
from viscorough_study.job_log import log_to, progress
from viscorough_study.seeds import realization_seed


def main(curves, *, ensembles, seed, until_x):
    """Indent the realizations of a batch until X = F/(4GhL) is until_x; lengths in m.

    ensembles : the batch's, each with spawn_key, points, surface (arguments of self_affine_line) and numbers, first
        realization and the one after the last
    """
    batch, reduced = numbered(ensembles), []
    for one, number in progress(batch, len(batch), "lines"):
        surface, line_seed = one["surface"], realization_seed(seed, *one["spawn_key"], number)
        line = self_affine_line(points=one["points"], **surface, length_unit="m", seed=line_seed)
        reduced.append(reduce(line, until_force=4 * surface["rms"] * surface["length"] * until_x))
    settings = {"seed": seed, "until_x": until_x, "ensembles": without_numbers(ensembles)}
    surfaces = [one["surface"] for one, _ in batch]
    about = {"hurst": [surface["hurst"] for surface in surfaces], "realizations": [number for _, number in batch]}
    about |= {"rms": {"line": [surface["rms"] for surface in surfaces]}}  # every line has the nominal rms height
    about |= {"spacing": [one["surface"]["length"] / one["points"] for one, _ in batch]}
    about |= {"diameter": [surface["length"] for surface in surfaces], "settings": settings}
    netcdf.write(batch_of_curves(reduced, **about), curves)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.output, **job.params)
