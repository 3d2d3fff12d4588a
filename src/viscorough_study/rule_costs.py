"""Cost of the rules of the workflow, from the benchmark files that Snakemake writes for every job."""

from pathlib import Path

import pandas as pd

COLUMNS = {
    "rule": ("rule of the workflow", ""),
    "jobs": ("jobs of the rule", "1"),
    "seconds": ("wall time of all jobs", "s"),
    "longest_s": ("longest wall time of one job", "s"),
    "memory_mb": ("largest resident memory of one job", "MB"),
}


def rule_costs(folder):
    """Time and memory of every rule, most expensive first; a pandas.DataFrame with the columns of `COLUMNS`.

    folder : of benchmark files, <rule>.tsv or <rule>/<job>.tsv; without any, the table has no rows
    """
    rows = []
    for path in sorted(Path(folder).rglob("*.tsv")):
        job = pd.read_csv(path, sep="\t").iloc[-1]
        # Snakemake measures no memory of the shortest jobs.
        seconds, memory = pd.to_numeric(job[["s", "max_rss"]], errors="coerce").fillna(0)
        rows.append((Path(path.relative_to(folder).parts[0]).stem, seconds, memory))
    by_rule = pd.DataFrame(rows, columns=["rule", "s", "memory"]).groupby("rule")
    table = pd.DataFrame(
        {
            "jobs": by_rule.size(),
            "seconds": by_rule["s"].sum().round(1),
            "longest_s": by_rule["s"].max().round(1),
            "memory_mb": by_rule["memory"].max().round(),
        }
    )
    return table.sort_values("seconds", ascending=False).reset_index()[list(COLUMNS)]
