"""Ensemble of the lines of one Hurst exponent: realizations on common abscissae, and their averages."""

import numpy as np

from viscorough.ensemble import abscissa, aggregate
from viscorough.joblog import log_to
from viscorough.storage import read_dataset, unstack_curves, write_dataset


def main(curves, ensemble, *, case, x_low, x_high, per_decade):
    """Pool the batches of loading curves in `curves`."""
    batches = [read_dataset(path) for path in curves]
    ds = aggregate(
        [curve for batch in batches for curve in unstack_curves(batch)],
        {"line": np.concatenate([batch["rms_line"].values for batch in batches])},
        batches[0]["diameter"].item(),
        abscissa(x_low, x_high, per_decade),
        hurst=batches[0]["hurst"].item(),
        case=case,
    )
    attributes = {"title": "Ensemble of self-affine lines", "settings": batches[0].attrs["settings"]}
    write_dataset(ds.assign_attrs(attributes), ensemble)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output, case=job.wildcards.line, **job.params)
