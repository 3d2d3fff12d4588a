"""Interpolate the loading curves of many surfaces to the same reduced forces X, and write them as one dataset."""

from viscorough.io.datasets import write_dataset
from viscorough_study.ensembles.averages import abscissa
from viscorough_study.ensembles.curve_files import read_curves
from viscorough_study.ensembles.pool import aggregate_curves
from viscorough_study.run.job_log import run_job
from viscorough_study.run.made_with import made_with_text


def main(curves, pool, *, groups, conventions, ensemble):
    """Write the pool, the dataset of all curves, from the files of several batches of loading curves.

    curves : files of the batches; pool : file to write; groups : name of the group of each batch
    conventions : names of the definitions of the rms height that the pool contains
    ensemble : dict with the ends of the abscissae X (x_low, x_high) and their number in a decade (per_decade)
    """
    x = abscissa(ensemble["x_low"], ensemble["x_high"], ensemble["per_decade"])
    batches = zip(groups, map(read_curves, curves), strict=True)
    write_dataset(aggregate_curves(batches, conventions, x).assign_attrs(made_with_text()), pool)


run_job(globals(), main)
