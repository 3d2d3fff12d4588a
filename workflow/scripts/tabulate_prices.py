"""Table of what the rules of the workflow cost."""

from viscorough import timing
from viscorough.joblog import log_to
from viscorough.prices import COLUMNS, prices
from viscorough.storage import write_table


def main(csv, nc, *, benchmarks):
    """Sum up the benchmark files of the jobs that were run so far."""
    title = f"Time and memory of every rule, on {timing.machine()}"
    write_table(prices(benchmarks), csv, nc, columns=COLUMNS, dimension="price", title=title)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.output, **job.params)
