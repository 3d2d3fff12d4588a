"""Draw the rough interface in series with the flat punch."""

from viscorough_study.figures.interface import plot_interface
from viscorough_study.figures.style import save_figure
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import read_table


def main(interface, interface_curves, literature, periodic, figure):
    """Write the figure.

    interface, interface_curves : CSV files of fits.interface
    literature, periodic : CSV files of comparisons.literature and comparisons.periodic_control
    figure : file to write
    """
    save_figure(plot_interface(*map(read_table, (interface, interface_curves, literature, periodic))), figure)


run_job(globals(), main)
