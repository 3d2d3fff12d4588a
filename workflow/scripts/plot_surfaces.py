"""Draw Figure 1 of the paper: surfaces."""

from viscorough_study.ensembles.surface_files import read_surfaces
from viscorough_study.figures.style import save_figure
from viscorough_study.figures.surfaces import plot_surfaces
from viscorough_study.run.job_log import run_job


def main(examples, figure):
    """Write the figure; examples : file of the surfaces; figure : file to write"""
    surfaces = [(of.hurst, indenter.heights, indenter.spacing) for _, of, indenter in read_surfaces(examples)]
    save_figure(plot_surfaces(surfaces), figure)


run_job(globals(), main)
