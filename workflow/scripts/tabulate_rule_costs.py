"""Tabulate the computing time and the memory of the rules of the workflow."""

from datetime import date

from viscorough_study.performance import timing
from viscorough_study.run.job_log import run_job
from viscorough_study.run.rule_costs import COLUMNS, rule_costs
from viscorough_study.run.tables import write_table


def main(csv, *, benchmarks):
    """Write the table with the time and the memory of every rule.

    benchmarks : {name of a rule: files with the time and memory of its jobs, from Snakemake}
    """
    made = {"date": date.today().isoformat()}
    table, title = rule_costs(benchmarks), "Time and memory of every rule"
    write_table(table, csv, columns=COLUMNS, title=title, machine=timing.machine(), made=made)


run_job(globals(), main)
