"""Draw the motion of the discs in other media."""

from viscorough_study.figures.media import plot_media
from viscorough_study.figures.style import save_figure
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import read_table


def main(media, figure):
    """Write the figure.

    media : CSV file of comparisons.media_kinetics; figure : file to write
    """
    save_figure(plot_media(read_table(media)), figure)


run_job(globals(), main)
