"""Draw the surfaces of a finished run again and report which verdicts on the paper's claims change.

    python benchmarks/resampled_verdicts.py results --settings config/paper.yaml --output results/resampled.json

Every draw takes as many discs and lines of each Hurst exponent as the run has, with replacement, and the workflow's own
rules make every table of fits and verdicts from them. Results other than means over these ensembles are kept: direct
integration, validation, comparison surface by surface, grids from coarse to fine, and times. The tables of claims of
all draws are written as CSV, to the path of the output with this suffix.

Discs are drawn over all combinations of a Hurst exponent, whose surfaces have the same distribution: force, viscosity,
diameter and rms height are units of X and vt/h (claim one_surface). Drawn within the combinations, their means would
scatter twice as much as their realizations allow, and the scatter between them would be that of the bootstrap.
"""

import shutil
import tempfile
from pathlib import Path

import click
import numpy as np
import pandas as pd
from measuring import output_option
from verdicts_again import claims, report

from viscorough.io.datasets import read_dataset, write_dataset

RULES = "fit_scaling", "match_lines", "measure_plateaus", "compare_prefactors", "compare_zeta_laws", "judge_claims"


def drawn(pool, random):
    """A pool whose curves are drawn with replacement among those of the same group and Hurst exponent."""
    chosen = np.arange(pool.sizes["realization"])
    strata = pd.DataFrame({name: pool[name].values for name in ("group", "hurst")}).groupby(["group", "hurst"])
    for members in strata.indices.values():
        chosen[members] = random.choice(members, members.size)
    coordinates = {name: values for name, values in pool.coords.items() if "realization" in values.dims}
    return pool.isel(realization=chosen).assign_coords(coordinates)


def draw_again(results, folder, random):
    """Copy the tables of a run to a folder, and its ensembles with other draws."""
    shutil.copytree(results / "tables", folder / "results/tables")
    (folder / "results/ensembles").mkdir()
    for name in ("discs.nc", "lines.nc"):
        write_dataset(drawn(read_dataset(results / "ensembles" / name), random), folder / "results/ensembles" / name)


@click.command(help=__doc__.splitlines()[0])
@click.argument("results", type=click.Path(exists=True, file_okay=False, path_type=Path))
@click.option("--settings", type=click.Path(exists=True, path_type=Path), help="Settings with which it was made.")
@click.option("--draws", type=click.IntRange(1), default=8, show_default=True)
@click.option("--seed", type=click.IntRange(0), default=1, show_default=True, help="Of the draws.")
@click.option("--cores", type=click.IntRange(1), default=2, show_default=True)
@output_option
def main(results, settings, draws, seed, cores, output):
    if not (results / "tables/claims.csv").is_file():
        raise click.ClickException(f"{results}: no tables/claims.csv there; make paper makes it")
    random, tables = np.random.default_rng(seed), {}
    for draw in range(1, draws + 1):
        with tempfile.TemporaryDirectory() as folder:
            draw_again(results, Path(folder), random)
            tables[draw] = claims(folder, settings, cores, "--allowed-rules", *RULES, "--forcerun", *RULES)
        click.echo(f"draw {draw} of {draws}")
    report(tables, "draw", output)


if __name__ == "__main__":
    main()
