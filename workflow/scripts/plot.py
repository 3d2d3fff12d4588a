"""Draw one of the figures that workflow/results.yaml lists."""

from pkgutil import resolve_name

from viscorough_study.figures.style import save_figure
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import read_table


def main(files, png, pdf, *, functions, **params):
    """Draw a figure, and write it to the files png and pdf.

    files : {argument of the drawing function: path of the file with its data}
    functions : {"draw": dotted name of the drawing function, argument: dotted name of a reader}. A reader is a function
        that takes `files` and returns the argument. Arguments without a reader are read as tables.
    params : further arguments of the drawing function
    """
    inputs = {
        name: resolve_name(functions[name])(files) if name in functions else read_table(path)
        for name, path in files.items()
    }
    save_figure(resolve_name(functions["draw"])(**inputs, **params), png, pdf)


run_job(globals(), lambda job: main(dict(job.input), **job.output, **job.params))
