"""Ensemble of one case of discs: its realizations on common abscissae, and their averages."""

import xarray as xr

from viscorough.ensemble import abscissa, aggregate
from viscorough.joblog import log_to
from viscorough.storage import read_dataset, unstack_curves, write_dataset


def main(curves, ensemble, *, case, x_low, x_high, per_decade):
    """Pool the batches of loading curves in `curves`; h is that of the disc and that of the square, side by side."""
    batches = [read_dataset(path) for path in curves]
    rms = xr.concat([batch[["rms_disc", "rms_square"]] for batch in batches], "realization")
    ds = aggregate(
        [curve for batch in batches for curve in unstack_curves(batch)],
        {"disc": rms["rms_disc"].values, "square": rms["rms_square"].values},
        batches[0]["diameter"].item(),
        abscissa(x_low, x_high, per_decade),
        hurst=batches[0]["hurst"].item(),
        case=case,
    )
    attributes = {"title": "Ensemble of self-affine discs", "settings": batches[0].attrs["settings"]}
    write_dataset(ds.assign_attrs(attributes), ensemble)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output, case=job.wildcards.case, **job.params)
