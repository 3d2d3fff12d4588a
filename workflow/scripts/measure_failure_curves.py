"""Errors against explicit steps and against contact."""

from viscorough_study.job_log import log_to
from viscorough_study.robustness.failure_curves import COLUMNS, failure_curves
from viscorough_study.seeds import failure_curves_key, realization_seed
from viscorough_study.tables import write_table


def main(csv, nc, *, seed):
    """Write the table."""
    found = failure_curves(realization_seed(seed, *failure_curves_key()))
    write_table(found, csv, nc, columns=COLUMNS, dimension="point", title="Where methods begin to fail")


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.output, **job.params)
