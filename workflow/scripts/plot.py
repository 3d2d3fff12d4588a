"""Draw a figure of workflow/results.yaml."""

from pkgutil import resolve_name

from viscorough_study.figures.style import save_figure
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import read_table


def main(files, png, pdf, *, functions, **params):
    """Draw a figure from files.

    files : {argument of the function that draws the figure: path of its data}
    params : further arguments of this function
    functions : {"draw": dotted name of this function, argument: dotted name of a reader}. A reader takes `files` and
        returns the argument; arguments without a reader are tables.
    """
    inputs = {
        name: resolve_name(functions[name])(files) if name in functions else read_table(path)
        for name, path in files.items()
    }
    save_figure(resolve_name(functions["draw"])(**inputs, **params), png, pdf)


run_job(globals(), lambda job: main(dict(job.input), **job.output, **job.params))
