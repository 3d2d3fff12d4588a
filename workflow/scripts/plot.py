"""Draw a figure with the function plot_NAME of viscorough_study.figures.NAME, where NAME is the param `figure`."""

from importlib import import_module

from viscorough_study.figures.style import remove_outdated_pdf, save_figure
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import read_table


def read(argument, path):
    """Read an argument of the drawing function: a table from a CSV file, surfaces or ensembles from a NetCDF file."""
    if path.endswith(".csv"):
        return read_table(path)
    from viscorough_study.figures.inputs import READERS  # this import takes long, and most figures do not need it

    return READERS[argument](path)


def main(path, *, figure, options=None, **files):
    """Draw a figure, and write it to a PNG or PDF file.

    path : file to write; figure : name of the figure
    options : further arguments of the drawing function
    files : for each other argument of the drawing function, the path of the file with its data
    """
    plot = getattr(import_module(f"viscorough_study.figures.{figure}"), f"plot_{figure}")
    data = {argument: read(argument, file) for argument, file in files.items()}
    save_figure(plot(**data, **(options or {})), path)
    remove_outdated_pdf(path, files.values())


run_job(globals(), main)
