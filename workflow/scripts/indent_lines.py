"""Loading curves of a batch of self-affine lines by the reduction of dimensionality; no line is stored."""

from viscorough.io import netcdf
from viscorough.mdr import reduce
from viscorough.surfaces import self_affine_line
from viscorough_study.batches import batch_of_curves
from viscorough_study.job_log import log_to, progress
from viscorough_study.seeds import realization_seed


def main(curves, *, realizations, seed, spawn_key, points, surface, until_x):
    """Indent the realizations realizations[0] <= number < realizations[1] until X = F/(4GhL) is until_x; lengths in m.

    surface : arguments of self_affine_line
    """
    numbers, reduced = range(*realizations), []
    until_force = 4 * surface["rms"] * surface["length"] * until_x
    for number in progress(numbers, len(numbers), "lines"):
        line_seed = realization_seed(seed, *spawn_key, number)
        line = self_affine_line(points=points, **surface, length_unit="m", seed=line_seed)
        reduced.append(reduce(line, until_force=until_force))
    rms = [surface["rms"]] * len(numbers)  # every line has the nominal rms height
    lengths = {"rms": {"line": rms}, "spacing": line.spacing, "diameter": surface["length"]}
    settings = {"seed": seed, "spawn_key": [*spawn_key, "realization"], "points": points, "surface": surface}
    about = {"hurst": surface["hurst"], "settings": settings | {"until_x": until_x}, **lengths}
    netcdf.write(batch_of_curves(reduced, realizations=numbers, **about), curves)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.output, **job.params)
