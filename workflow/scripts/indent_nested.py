"""Compute the curves of the same discs on several grids; no disc is stored."""

from viscorough.io.datasets import write_dataset
from viscorough_study.ensembles.nested_grids import nested_curves
from viscorough_study.run.job_log import run_job
from viscorough_study.run.made_with import made_with_text


def main(curves, *, sample, tolerance, seed):
    """Generate and indent the discs of a sample, and write their curves.

    curves : file to write; sample : arguments of `nested_curves`, from `run.samples.nested_arguments`
    tolerance, seed : further arguments of `nested_curves`
    """
    dataset = nested_curves(**sample, tolerance=tolerance, seed=seed)
    write_dataset(dataset.assign_attrs(made_with_text()), curves)


run_job(globals(), main)
