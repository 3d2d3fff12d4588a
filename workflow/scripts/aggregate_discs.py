"""Ensemble of one case of discs: its realizations on common abscissae, and their averages."""

from viscorough.ensemble import abscissa, aggregate, combine
from viscorough.joblog import log_to, progress
from viscorough.storage import read_dataset, unstack_curves, write_dataset


def main(curves, ensemble, *, case, x_low, x_high, per_decade):
    """Pool the batches of loading curves in `curves`; h is the rms of the disc, that of the square, and the
    height of the highest peak, side by side.

    A batch at a time is in memory, of the others only what they come to at the abscissae.
    """
    x = abscissa(x_low, x_high, per_decade)

    def batch_ensemble(path):
        batch = read_dataset(path)
        rms = {name: batch[f"rms_{name}"].values for name in ("disc", "square", "peak")}
        about = {"hurst": batch["hurst"].item(), "case": case}
        ds = aggregate(unstack_curves(batch), rms, batch["diameter"].item(), x, **about)
        return ds.assign_attrs(settings=batch.attrs["settings"])

    pooled = list(progress(map(batch_ensemble, curves), len(curves), "batches"))
    attributes = {"title": "Ensemble of self-affine discs", "settings": pooled[0].attrs["settings"]}
    write_dataset(combine(pooled).assign_attrs(attributes), ensemble)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output, case=job.wildcards.case, **job.params)
