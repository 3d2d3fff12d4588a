"""Cost of the loading curve of one disc: time, operators and memory."""

import json
import resource

import pandas as pd

from viscorough.contact.loading_path import indent
from viscorough.io.atomic import atomic_write
from viscorough.io.datasets import stack_curves, write_dataset
from viscorough.surfaces import self_affine_disc
from viscorough_study.job_log import log_to
from viscorough_study.performance import timing
from viscorough_study.seeds import large_disc_key, realization_seed


def main(csv, curve, *, elements, seed, hurst, tolerance, until_fraction):
    """Indent a disc of diameter and rms height 1; memory is the most that this process took at any time."""
    indent(self_affine_disc(hurst, 129, seed=0), tolerance=tolerance)  # compiled functions are loaded
    disc = self_affine_disc(hurst, elements, seed=realization_seed(seed, *large_disc_key(elements)))
    found, wall, processor = timing.timed(lambda: indent(disc, tolerance=tolerance, until_fraction=until_fraction))
    cost = {
        "across": elements,
        "elements": disc.elements,
        "levels": found.depth.size,
        "operator_applications": found.operator_applications,
    }
    cost |= {"wall": wall, "processor": processor}
    cost["memory"] = 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    cost["machine"] = "{name}, {processor}, {cores} cores".format(**timing.machine())
    settings = {"seed": seed, "spawn_key": large_disc_key(elements), "hurst": hurst, "until_fraction": until_fraction}
    ds = stack_curves([found], "1").assign_attrs(title="A disc on a fine grid", settings=json.dumps(settings))
    write_dataset(ds, curve)
    with atomic_write(csv) as temporary:
        pd.DataFrame([cost]).to_csv(temporary, index=False)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.output, elements=int(job.wildcards.elements), **job.params)
