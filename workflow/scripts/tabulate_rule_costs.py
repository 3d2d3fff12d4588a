"""Table of what the rules of the workflow cost."""

from viscorough_study.job_log import log_to
from viscorough_study.performance import timing
from viscorough_study.rule_costs import COLUMNS, prices
from viscorough_study.tables import write_table


def main(csv, nc, *, benchmarks):
    """Sum up the benchmark files of the jobs that were run so far."""
    title = f"Time and memory of every rule, on {timing.machine()}"
    write_table(prices(benchmarks), csv, nc, columns=COLUMNS, dimension="price", title=title)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.output, **job.params)
