"""Bring all realizations of a pool of cases to common abscissae, in one dataset."""

from viscorough.io import netcdf
from viscorough.io.datasets import write_dataset
from viscorough_study.ensembles.averages import abscissa
from viscorough_study.ensembles.pool import pool_batches
from viscorough_study.run.job_log import run_job


def main(curves, pool, *, groups, conventions, ensemble):
    """Write the pool of several batches of loading curves.

    curves : files of the batches; pool : file of the pool; groups : group of each batch
    conventions : conventions of the rms heights, all of which the pool contains
    ensemble : x_low, x_high and per_decade of the abscissae
    """
    x = abscissa(ensemble["x_low"], ensemble["x_high"], ensemble["per_decade"])
    batches = zip(groups, map(netcdf.read, curves), strict=True)
    write_dataset(pool_batches(batches, conventions, x), pool)


run_job(globals(), lambda job: main(**job.input, **job.output, **job.params))
