"""Draw a figure with the function plot_NAME of viscorough_study.figures.NAME, where NAME is the param `figure`."""

from importlib import import_module

from viscorough_study.figures import inputs
from viscorough_study.figures.style import save_figure
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import read_table

# Functions that read those arguments of the drawing functions that are not tables.
READERS = {
    "examples": inputs.examples,
    "ensembles": inputs.ensembles,
    "discs": inputs.discs,
    "lines": inputs.lines,
    "groups": inputs.groups,
}


def main(path, *, figure, options=None, **files):
    """Draw a figure, and write it to a PNG or PDF file.

    path : file to write; figure : name of the figure
    options : further arguments of the drawing function
    files : for each other argument of the drawing function, the path of the file with its data
    """
    plot = getattr(import_module(f"viscorough_study.figures.{figure}"), f"plot_{figure}")
    data = {argument: READERS.get(argument, read_table)(file) for argument, file in files.items()}
    save_figure(plot(**data, **(options or {})), path)


run_job(globals(), main)
