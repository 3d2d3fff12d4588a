"""Ensemble of the lines of one Hurst exponent: realizations on common abscissae, and their averages."""

from viscorough.io.datasets import read_dataset, write_dataset
from viscorough_study.ensembles import abscissa, aggregate_batches
from viscorough_study.job_log import log_to, progress


def main(curves, ensemble, *, case, x_low, x_high, per_decade):
    """Pool the batches of loading curves in `curves`, one at a time in memory."""
    batches = progress(map(read_dataset, curves), len(curves), "batches")
    ds = aggregate_batches(batches, ("line",), abscissa(x_low, x_high, per_decade), case=case)
    write_dataset(ds.assign_attrs(title="Ensemble of self-affine lines"), ensemble)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output, case=job.wildcards.line, **job.params)
