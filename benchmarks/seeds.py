"""Run the reproduction with several root seeds and report which verdicts change with the seed.

    python benchmarks/seeds.py --seeds 3 --output results/seeds.csv

Every run starts without results in a temporary folder; the verdicts on the paper's claims are compared. The file has
the tables of claims of all seeds.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

import click
import pandas as pd
from measuring import output_option, save_table

from viscorough_study.run.tables import read_table
from viscorough_study.verdicts.claims import overall

ROOT = Path(__file__).resolve().parents[1]


def claims(folder, seed, cores):
    """Return the table of claims of a run in a folder."""
    snakefile = str(ROOT / "Snakefile")
    command = [sys.executable, "-m", "snakemake", "--snakefile", snakefile, "--directory", folder]
    command += ["--cores", str(cores), "--quiet", "all", "--config", f"seed={seed}"]
    subprocess.run([*command, "--", "results/tables/claims.csv"], check=True)
    return read_table(Path(folder) / "results/tables/claims.csv", keep_default_na=False, na_values=[""])


@click.command(help=__doc__.splitlines()[0])
@click.option("--seeds", type=click.IntRange(2), default=3, show_default=True, help="Number of root seeds: 1, 2, ...")
@click.option("--cores", type=click.IntRange(1), default=2, show_default=True)
@output_option
def main(seeds, cores, output):
    tables = {}
    for seed in range(1, seeds + 1):
        with tempfile.TemporaryDirectory() as folder:
            tables[seed] = claims(folder, seed, cores)
        click.echo(f"seed {seed} of {seeds}")
    save_table(pd.concat(tables, names=["seed"]).reset_index("seed"), output)
    verdicts = pd.DataFrame({seed: overall(table) for seed, table in tables.items()})
    moved = verdicts[verdicts.nunique(axis=1) > 1]
    click.echo(
        f"{len(moved)} of {len(verdicts)} verdicts change with the seed\n{moved.to_string() if len(moved) else ''}"
    )
    sys.exit(len(moved) > 0)


if __name__ == "__main__":
    main()
