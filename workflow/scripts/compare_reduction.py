"""Table of the reduction of dimensionality against boundary elements, surface by surface."""

from functools import partial

from viscorough_study.comparisons.mdr_comparison import COLUMNS, compare_reduction
from viscorough_study.ensembles.averages import abscissa
from viscorough_study.run.job_log import log_to, progress
from viscorough_study.run.tables import write_table


def main(csv, nc, *, hurst, elements, realizations, tolerance, seed, x_low, x_high, per_decade):
    """Compare and tabulate; x_low, x_high, per_decade : of the abscissae X."""
    shown = partial(progress, total=realizations, description="surfaces")
    about = {"tolerance": tolerance, "seed": seed, "progress": shown}
    table = compare_reduction(hurst, elements, realizations, abscissa(x_low, x_high, per_decade), **about)
    title = "Reduction of dimensionality against boundary elements"
    write_table(table, csv, nc, columns=COLUMNS, dimension="point", title=title)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.output, **job.params)
