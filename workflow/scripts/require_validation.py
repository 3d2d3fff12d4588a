"""Check the comparisons with exact solutions; if any failed, stop the workflow and name the failed comparisons."""

from pathlib import Path

from viscorough_study.comparisons.validation import failures
from viscorough_study.run.job_log import run_job
from viscorough_study.run.made_with import text_line
from viscorough_study.run.tables import read_table


def main(table, passed, *, order_margin):
    """Write the names of all comparisons if all have passed.

    table : CSV file of the comparisons; passed : file to write
    order_margin : amount by which an observed order of convergence may be below the expected order
    Raises ValueError with the names of the failed comparisons if any failed.
    """
    comparisons = read_table(table)
    if failed := failures(comparisons, order_margin):
        allowed = "validation.limits and validation.order_margin of the settings state what is allowed"
        raise ValueError(f"validation failed, see {table}: {'; '.join(failed)}; {allowed}")
    names = (comparisons["comparison"] + " " + comparisons["quantity"]).unique()
    Path(passed).write_text(text_line() + "\n".join(names) + "\n", encoding="utf-8")


run_job(globals(), main)
