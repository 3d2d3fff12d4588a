"""Compute loading curves of a batch of self-affine lines by dimensionality reduction; no line is stored."""

from viscorough_study.ensembles.curve_files import write_curves
from viscorough_study.ensembles.lines import line_curves
from viscorough_study.ensembles.realization import stored_settings
from viscorough_study.run.job_log import run_job
from viscorough_study.run.made_with import made_with_text


def main(curves, *, ensembles, **options):
    """Generate a batch of lines, and write their loading curves; lengths have no unit.

    curves : file to write
    ensembles : settings of each ensemble and numbers of its lines in this batch, from `run.samples.batch_ensembles`
    options : seed and until_x, further arguments of `line_curves`
    """
    made = (
        (stored_settings(ensemble, **options), *curve)
        for ensemble in ensembles
        for curve in line_curves(**ensemble, **options)
    )
    write_curves(made, curves, **made_with_text())


run_job(globals(), main)
