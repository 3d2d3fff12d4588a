"""Stop the workflow with the names of failed cases if a comparison with an exact solution failed."""

from pathlib import Path

from viscorough_study.comparisons.validation import failures
from viscorough_study.run.job_log import run_job
from viscorough_study.run.tables import read_table


def main(table, passed, *, order_margin):
    """Write the names of passed comparisons. Raises ValueError, naming the failed ones, if there are any."""
    comparisons = read_table(table)
    if failed := failures(comparisons, order_margin):
        raise ValueError(f"validation failed, see {table}: " + "; ".join(failed))
    names = (comparisons["case"] + " " + comparisons["quantity"]).unique()
    Path(passed).write_text("\n".join(names) + "\n", encoding="utf-8")


run_job(globals(), lambda job: main(**job.input, **job.output, **job.params))
