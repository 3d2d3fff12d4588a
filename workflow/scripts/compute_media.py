"""Compute the motion of the discs in other media than the purely viscous medium of the paper."""

from viscorough_study.comparisons.media_kinetics import COLUMNS, media_of_batches
from viscorough_study.ensembles.curve_files import read_curves
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import write_table


def main(curves, csv, **settings):
    """Write the table of depth, velocity and local exponent over time, in every medium.

    curves : files with the loading curves of all combinations of force, viscosity, diameter and rms height
    csv : file to write; settings : further arguments of `media_of_batches`
    """
    table = media_of_batches((read_curves(path)[0] for path in curves), **settings)
    title = "Kinetics in other media"
    write_table(table, csv, columns=COLUMNS, title=title)


run_job(globals(), main)
