"""Table of every method in every difficulty."""

import logging

from viscorough_study.job_log import log_to
from viscorough_study.robustness.failure_map import COLUMNS, table, unnoticed
from viscorough_study.robustness.stress_cases import difficulties
from viscorough_study.seeds import failure_map_key, realization_seed
from viscorough_study.tables import write_table


def main(csv, nc, *, seed, across, grids):
    """Write the table; what fails unnoticed is also said in the log."""
    atlas = table(difficulties(realization_seed(seed, *failure_map_key()), across, grids), logging.info)
    for row in unnoticed(atlas).itertuples():
        logging.warning("%s: %s fails unnoticed, error %.2g", row.difficulty, row.method, row.error)
    write_table(atlas, csv, nc, columns=COLUMNS, dimension="cell", title="Every method in every difficulty")


if job := globals().get("snakemake"):
    log_to(job.log[0])
    main(**job.output, **job.params)
