"""The failure map: every method on every stress-test case."""

import logging

from viscorough_study.robustness.failure_map import COLUMNS, failure_map, unnoticed
from viscorough_study.robustness.stress_cases import stress_cases
from viscorough_study.run.job_log import log_to
from viscorough_study.run.seeds import failure_map_key, realization_seed
from viscorough_study.run.tables import recorded, write_table


def main(csv, nc, *, seed, across, grids, hurst_min):
    """Write the table, and a warning to the log for every failure that is unnoticed."""
    cases = stress_cases(realization_seed(seed, *failure_map_key()), across, grids, hurst_min)
    table = failure_map(cases, report=logging.info)
    for row in unnoticed(table).itertuples():
        logging.warning("%s: %s fails unnoticed, error %.2g", row.case, row.method, row.error)
    about = recorded(settings={"seed": seed, "across": across, "grids": grids})
    title = "Every method on every stress-test case"
    write_table(table, csv, nc, columns=COLUMNS, dimension="cell", title=title, attributes=about)


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.output, **job.params)
