"""A figure of workflow/results.yaml."""

import pandas as pd

from viscorough_study.figures.style import save_figure
from viscorough_study.run.inputs import named
from viscorough_study.run.job_log import log_to


def main(files, png, pdf, *, functions, **params):
    """Draw a figure from files.

    files : {argument of the function that draws: path}; params : its further arguments
    functions : dotted names of the function that draws ("draw") and, under the arguments, of their readers, which take
        `files`; other arguments are tables
    """
    inputs = {name: named(functions[name])(files) if name in functions else pd.read_csv(files[name]) for name in files}
    save_figure(named(functions["draw"])(**inputs, **params), png, pdf)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(dict(job.input), **job.output, **job.params)
