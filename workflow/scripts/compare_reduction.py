"""Table and figure of the reduction of dimensionality against boundary elements, surface by surface."""

from functools import partial

from viscorough_study.ensembles import abscissa
from viscorough_study.figures.mdr_comparison import plot_mdr_comparison
from viscorough_study.figures.style import save_figure
from viscorough_study.job_log import log_to, progress
from viscorough_study.mdr_comparison import COLUMNS, compare_reduction
from viscorough_study.tables import write_table


def main(csv, nc, png, pdf, *, hurst, elements, realizations, tolerance, seed):
    """Compare, tabulate and plot."""
    shown = partial(progress, total=realizations, description="surfaces")
    about = {"tolerance": tolerance, "seed": seed, "progress": shown}
    table = compare_reduction(hurst, elements, realizations, abscissa(1e-5, 3.0, 10), **about)
    title = "Reduction of dimensionality against boundary elements"
    write_table(table, csv, nc, columns=COLUMNS, dimension="point", title=title)
    save_figure(plot_mdr_comparison(table), png, pdf)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.output, **job.params)
