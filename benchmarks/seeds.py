"""Run the reproduction with several root seeds and report which verdicts change with the seed.

    python benchmarks/seeds.py --seeds 3 --output results/seeds.json

Every run starts without results in a temporary folder; the verdicts on the paper's claims are compared. The tables of
claims of all seeds are written as CSV, to the path of the output with this suffix.
"""

import sys
import tempfile
from pathlib import Path

import click
from measuring import output_option
from verdicts_again import claims, report


@click.command(help=__doc__.splitlines()[0])
@click.option("--seeds", type=click.IntRange(2), default=3, show_default=True, help="Number of root seeds: 1, 2, ...")
@click.option("--cores", type=click.IntRange(1), default=2, show_default=True)
@click.option("--settings", type=click.Path(exists=True, path_type=Path), help="Changes to config/config.yaml.")
@output_option
def main(seeds, cores, settings, output):
    tables = {}
    for seed in range(1, seeds + 1):
        with tempfile.TemporaryDirectory() as folder:
            tables[seed] = claims(folder, settings, cores, "--config", f"seed={seed}")
        click.echo(f"seed {seed} of {seeds}")
    sys.exit(bool(report(tables, "seed", output)))


if __name__ == "__main__":
    main()
