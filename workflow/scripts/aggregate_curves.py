"""Put all realizations of a pool of cases on common abscissae, in one dataset."""

from viscorough.io import netcdf
from viscorough.io.datasets import write_dataset
from viscorough_study.ensembles.averages import abscissa
from viscorough_study.ensembles.pool import pool_batches
from viscorough_study.run.job_log import run_job


def main(curves, pool, *, groups, conventions, ensemble):
    """Pool batches of loading curves.

    curves : files of the batches; groups : group of each batch
    conventions : conventions of the rms heights, side by side; ensemble : x_low, x_high and per_decade of the abscissae
    """
    x = abscissa(ensemble["x_low"], ensemble["x_high"], ensemble["per_decade"])
    batches = zip(groups, map(netcdf.read, curves), strict=True)
    write_dataset(pool_batches(batches, conventions, x), pool)


run_job(globals(), lambda job: main(**job.input, **job.output, **job.params))
