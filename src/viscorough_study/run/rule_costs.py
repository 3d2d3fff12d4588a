"""Sum up the cost of the workflow's rules from the benchmark files that Snakemake writes for every job."""

import math
import os
from itertools import pairwise
from pathlib import Path

import numpy as np
import pandas as pd

COLUMNS = {
    "rule": ("rule of the workflow", ""),
    "jobs": ("jobs of the rule", "1"),
    "seconds": ("wall time of all jobs", "s"),
    "share_s": ("time of the run, without pauses, shared by the jobs that ran side by side", "s"),
    "longest_s": ("longest wall time of one job", "s"),
    "memory_mb": ("largest resident memory of one job", "Mbyte"),
}


def rule_costs(benchmarks):
    """Return time and memory of every rule, most expensive first: a pandas.DataFrame with the columns of `COLUMNS`.

    benchmarks : {rule: benchmark files of its jobs}. Snakemake writes each file at the end of its job. Missing files
        are left out; if no file exists, the table has no rows.
    Raises ValueError for a damaged file.
    """
    files = [(rule, Path(path)) for rule, paths in benchmarks.items() for path in sorted(paths)]
    files = [(rule, path) for rule, path in files if path.is_file()]
    paths = [path for _, path in files]
    jobs = pd.DataFrame([_time_and_memory(path) for path in paths], columns=["s", "memory"])
    jobs["rule"] = [rule for rule, _ in files]
    jobs["share"] = _shares(np.array([path.stat().st_mtime for path in paths]), jobs["s"].to_numpy())
    table = jobs.groupby("rule").agg(
        jobs=("s", "size"),
        seconds=("s", "sum"),
        share_s=("share", "sum"),
        longest_s=("s", "max"),
        memory_mb=("memory", "max"),
    )
    table = table.round({"seconds": 1, "share_s": 2, "longest_s": 1, "memory_mb": 0})
    return table.sort_values("seconds", ascending=False).reset_index()[list(COLUMNS)]


def _shares(ends, seconds):
    """Return the part of the run's time [s] that each job accounts for; simultaneous jobs share the time equally.

    ends : time when each job ended [s]; seconds : duration of each job [s]
    Time without a running job does not count. The sum of the shares is at least the total duration of all jobs divided
    by the number of cores. This bound matters if the benchmark files were copied without their modification times,
    because their jobs then appear to have run at the same time.
    """
    starts, shares = ends - seconds, np.zeros(len(ends))
    moments = np.unique([*starts, *ends])
    for low, high in pairwise(moments):
        running = (starts <= low) & (high <= ends)
        shares[running] += (high - low) / max(running.sum(), 1)
    return shares * max(1.0, seconds.sum() / os.cpu_count() / max(shares.sum(), 1e-9))


def duration_text(seconds):
    """Return a duration as text, such as "50 seconds", "5.5 minutes", "3.1 hours"."""
    if seconds < 100:
        return f"{seconds:.0f} seconds"
    return f"{seconds / 60:.1f} minutes" if seconds < 6000 else f"{seconds / 3600:.1f} hours"


def _time_and_memory(path):
    """Return the duration [s] and the memory [MB] of a job from its benchmark file.

    Raises ValueError for a damaged file.
    """
    try:
        job = pd.read_csv(path, sep="\t", na_values="-").iloc[-1]
        # Snakemake does not measure the memory of very short jobs.
        seconds, memory = float(job["s"]), float(job.fillna(0.0)["max_rss"])
    except (ValueError, LookupError):
        seconds = memory = math.nan
    if not (0 <= seconds < math.inf and 0 <= memory < math.inf):
        raise ValueError(f"{path}: not a benchmark of a job; delete the file, and the costs will lack this job")
    return seconds, memory
