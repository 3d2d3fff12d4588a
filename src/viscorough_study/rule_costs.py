"""Cost of the rules of the workflow, from the benchmark files that Snakemake writes for every job."""

import math
import platform
from importlib.metadata import version
from pathlib import Path

import pandas as pd

COLUMNS = {
    "rule": ("rule of the workflow", ""),
    "jobs": ("jobs of the rule", "1"),
    "seconds": ("wall time of all jobs", "s"),
    "longest_s": ("longest wall time of one job", "s"),
    "memory_mb": ("largest resident memory of one job", "Mbyte"),
}
PACKAGES = ("viscorough", "numpy", "scipy", "numba", "ducc0", "xarray", "netCDF4", "pandas", "matplotlib", "snakemake")


def rule_costs(folder):
    """Time and memory of every rule, most expensive first; a pandas.DataFrame with the columns of `COLUMNS`.

    folder : of benchmark files, <rule>.tsv or <rule>/<job>.tsv; without any, the table has no rows
    Raises ValueError for a file that is damaged.
    """
    rows = [
        (Path(path.relative_to(folder).parts[0]).stem, *_time_and_memory(path))
        for path in sorted(Path(folder).rglob("*.tsv"))
    ]
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


def versions():
    """{package: version} of Python and of what computes, stores and draws."""
    return {"Python": platform.python_version()} | {name: version(name) for name in PACKAGES}


def _time_and_memory(path):
    """Seconds and megabytes of a job."""
    try:
        job = pd.read_csv(path, sep="\t").iloc[-1]
        seconds, memory = float(job["s"]), job["max_rss"]
        memory = 0.0 if memory == "-" or pd.isna(memory) else float(memory)  # not measured for the shortest jobs
    except (ValueError, LookupError):
        seconds = memory = math.nan
    if not (0 <= seconds < math.inf and 0 <= memory < math.inf):
        raise ValueError(f"{path}: not a benchmark of a job; delete the file, and the costs will lack this job")
    return seconds, memory
