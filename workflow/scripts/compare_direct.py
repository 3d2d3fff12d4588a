"""Table and figure of direct integrations against the law with and without the Gamma function."""

from viscorough_study.figures.direct_integration import plot_direct_integration
from viscorough_study.figures.style import save_figure
from viscorough_study.gamma_factor import COLUMNS, compare_direct
from viscorough_study.job_log import log_to
from viscorough_study.tables import write_table


def main(csv, nc, png, pdf, *, hursts, across, seed):
    """Integrate, tabulate and plot."""
    table = compare_direct(hursts, across, seed)
    write_table(
        table, csv, nc, columns=COLUMNS, dimension="point", title="Direct integration and the readings of the law"
    )
    save_figure(plot_direct_integration(table), png, pdf)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.output, **job.params)
