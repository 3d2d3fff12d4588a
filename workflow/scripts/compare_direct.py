"""Table of direct integrations against the law with and without the Gamma function."""

from viscorough_study.comparisons.direct_integration import COLUMNS, compare_direct
from viscorough_study.run.job_log import log_to
from viscorough_study.run.tables import write_table


def main(csv, nc, *, hursts, elements, impulses, seed):
    """Integrate indenters of so many elements across, and tabulate."""
    title = "Direct integration and the readings of the law"
    write_table(
        compare_direct(hursts, elements, impulses, seed), csv, nc, columns=COLUMNS, dimension="point", title=title
    )


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.output, **job.params)
