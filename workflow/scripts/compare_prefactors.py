"""Table and figure of the prefactor under every combination of conventions."""

import pandas as pd

from viscorough_study.figures.prefactors import plot_prefactors
from viscorough_study.figures.style import save_figure
from viscorough_study.job_log import log_to
from viscorough_study.prefactors import COLUMNS, prefactors
from viscorough_study.tables import write_table


def main(scaling, csv, nc, png, pdf, *, shown):
    """Tabulate and plot; shown : conventions of the figures, {column of the table: value}."""
    table = prefactors(pd.read_csv(scaling))
    write_table(table, csv, nc, columns=COLUMNS, dimension="fit", title="Prefactor under every convention")
    save_figure(plot_prefactors(table, shown), png, pdf)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.input, **job.output, **job.params)
