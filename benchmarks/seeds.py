"""Run the reproduction with several root seeds and report which verdicts change with the seed.

    python benchmarks/seeds.py --seeds 3 --output results/seeds.json

Every run starts from nothing in a temporary folder; the verdicts on the paper's claims are compared. The tables of
claims of all seeds are written beside the output, as CSV.
"""

import subprocess
import sys
import tempfile
import time
from pathlib import Path

import click
import pandas as pd

from viscorough_study.performance import timing
from viscorough_study.tables import write_json
from viscorough_study.verdicts import overall

ROOT = Path(__file__).resolve().parents[1]


def claims(seed, cores, settings, folder):
    """Table of claims of a reproduction with this root seed, made in a folder."""
    command = [sys.executable, "-m", "snakemake", "--snakefile", str(ROOT / "Snakefile"), "--directory", folder]
    command += ["--cores", str(cores), "--quiet", "all", "--config", f"seed={seed}"]
    command += ["--configfile", str(settings)] if settings else []
    subprocess.run([*command, "--", "results/tables/claims.csv"], check=True)
    return pd.read_csv(Path(folder) / "results/tables/claims.csv", keep_default_na=False, na_values=[""])


def changing(verdicts):
    """{claim: verdict with each seed} of the claims whose verdict is not the same with all seeds."""
    first, *_ = verdicts.values()
    by_claim = {claim: [outcome[claim] for outcome in verdicts.values()] for claim in first}
    return {claim: outcomes for claim, outcomes in by_claim.items() if len(set(outcomes)) > 1}


@click.command(help=__doc__.splitlines()[0])
@click.option("--seeds", type=click.IntRange(2), default=3, show_default=True, help="Number of root seeds: 1, 2, ...")
@click.option("--cores", type=click.IntRange(1), default=2, show_default=True)
@click.option("--settings", type=click.Path(exists=True, path_type=Path), help="What differs from config/config.yaml.")
@click.option("--output", type=click.Path(path_type=Path), required=True, help="File to write, JSON.")
def main(seeds, cores, settings, output):
    start, tables = time.perf_counter(), {}
    for seed in range(1, seeds + 1):
        with tempfile.TemporaryDirectory() as folder:
            tables[seed] = claims(seed, cores, settings and settings.resolve(), folder)
        click.echo(f"seed {seed}: {time.perf_counter() - start:.0f} s")
    verdicts = {seed: overall(table) for seed, table in tables.items()}
    moved = changing(verdicts)
    cost = {"machine": timing.machine(), "seconds": round(time.perf_counter() - start, 1)}
    output.parent.mkdir(parents=True, exist_ok=True)
    pd.concat(tables, names=["seed"]).droplevel(1).to_csv(output.with_suffix(".csv"))
    write_json(cost | {"moved": moved, "verdicts": verdicts}, output)
    for claim, outcomes in moved.items():
        click.echo(f"{claim}: {', '.join(outcomes)}")
    click.echo(f"{len(moved)} of {len(verdicts[1])} verdicts change with the seed; written to {output}")
    sys.exit(bool(moved))


if __name__ == "__main__":
    main()
