"""Run a command that makes results, and write what they cost: time and memory of every rule, size on disk.

    python benchmarks/costs.py --output results/costs.json -- snakemake --cores 2 --configfile config/paper.yaml

Time and memory of jobs are those of Snakemake's benchmark files, so that jobs of an earlier, interrupted run count,
too; the wall time is that of this run.
"""

import json
import subprocess
import sys
import time
from pathlib import Path

import click
import pandas as pd

import viscorough
from viscorough import timing


def rules(folder):
    """{rule: jobs, seconds of all of them, most seconds of a job, most megabytes of a job} from benchmark files."""
    rows = []
    for path in sorted((folder / "benchmarks").rglob("*.tsv")):
        job = pd.read_csv(path, sep="\t").iloc[-1]
        parts = path.relative_to(folder / "benchmarks").parts
        # Jobs of less than a moment have no memory measured.
        numbers = pd.to_numeric(job[["s", "max_rss"]], errors="coerce").fillna(0)
        rows.append({"rule": Path(parts[0]).stem, **numbers})
    if not rows:
        return {}
    by_rule = pd.DataFrame(rows).groupby("rule")
    table = pd.DataFrame(
        {
            "jobs": by_rule.size(),
            "seconds": by_rule["s"].sum().round(1),
            "longest_s": by_rule["s"].max().round(1),
            "memory_mb": by_rule["max_rss"].max().round(),
        }
    )
    return table.sort_values("seconds", ascending=False).to_dict("index")


def sizes(folder):
    """{folder: megabytes} of what lies in the results."""
    found = {}
    for path in folder.rglob("*"):
        if path.is_file():
            name = path.relative_to(folder).parts[0]
            found[name] = found.get(name, 0) + path.stat().st_size / 1e6
    return {name: round(size, 2) for name, size in sorted(found.items(), key=lambda item: -item[1])}


@click.command(help=__doc__.splitlines()[0])
@click.option("--output", type=click.Path(path_type=Path), required=True, help="File to write, JSON.")
@click.option("--results", type=click.Path(path_type=Path), default=Path("results"), show_default=True)
@click.argument("command", nargs=-1, required=True)
def main(output, results, command):
    start = time.perf_counter()
    code = subprocess.run(command, check=False).returncode
    seconds = time.perf_counter() - start
    if code:
        sys.exit(code)
    of_rules, of_folders = rules(results), sizes(results)
    total = {
        "wall_s": round(seconds, 1),
        "jobs_s": round(sum(each["seconds"] for each in of_rules.values()), 1),
        "memory_mb": max((each["memory_mb"] for each in of_rules.values()), default=0),
        "results_mb": round(sum(of_folders.values()), 1),
    }
    about = {"machine": timing.machine(), "viscorough": viscorough.__version__, "command": " ".join(command)}
    output.write_text(json.dumps(about | total | {"rules": of_rules, "results": of_folders}, indent=1) + "\n")
    click.echo("{wall_s:.0f} s; jobs at most {memory_mb:.0f} MB; results {results_mb:.0f} MB".format(**total))
    click.echo(f"written to {output}")


if __name__ == "__main__":
    main()
