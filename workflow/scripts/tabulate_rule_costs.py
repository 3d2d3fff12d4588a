"""Table of the cost of the rules of the workflow."""

from viscorough_study.job_log import log_to
from viscorough_study.performance import timing
from viscorough_study.rule_costs import COLUMNS, rule_costs
from viscorough_study.tables import write_table


def main(csv, html, nc, *, benchmarks):
    """Sum up the benchmark files of the jobs that were run so far; benchmarks : their folder."""
    title = f"Time and memory of every rule, on {timing.machine()}"
    write_table(rule_costs(benchmarks), csv, nc, html, columns=COLUMNS, dimension="rule", title=title)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.output, **job.params)
