"""Table and figure of direct integrations against the law with and without the Gamma function."""

from viscorough.direct import COLUMNS, compare_direct
from viscorough.joblog import log_to
from viscorough.plotting import save_figure
from viscorough.plotting_beyond import plot_direct
from viscorough.storage import write_table


def main(csv, nc, png, pdf, *, hursts, across, seed):
    """Integrate, tabulate and plot."""
    table = compare_direct(hursts, across, seed)
    write_table(
        table, csv, nc, columns=COLUMNS, dimension="point", title="Direct integration and the readings of the law"
    )
    save_figure(plot_direct(table), png, pdf)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.output, **job.params)
