"""Draw a figure of workflow/results.yaml."""

from pkgutil import resolve_name

from viscorough_study.figures.style import save_figure
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import read_table


def main(files, png, pdf, *, functions, **params):
    """Draw a figure from files.

    files : {argument of the function that draws: path}; params : its further arguments
    functions : dotted names of the function that draws ("draw") and, under the arguments, of their readers, which take
        `files`; other arguments are tables
    """
    inputs = {
        name: resolve_name(functions[name])(files) if name in functions else read_table(path)
        for name, path in files.items()
    }
    save_figure(resolve_name(functions["draw"])(**inputs, **params), png, pdf)


run_job(globals(), lambda job: main(dict(job.input), **job.output, **job.params))
