"""Verdicts of several runs, with other seeds or other surfaces; for seeds.py and resampled_verdicts.py."""

import subprocess
import sys
from pathlib import Path

import click
import pandas as pd
from measuring import save

from viscorough_study.verdicts.claims import overall

ROOT = Path(__file__).resolve().parents[1]


def claims(folder, settings, cores, *arguments):
    """Table of claims of a run in a folder; settings : file of changes to config/config.yaml, or None."""
    command = [sys.executable, "-m", "snakemake", "--snakefile", str(ROOT / "Snakefile"), "--directory", str(folder)]
    command += ["--configfile", str(settings.resolve())] if settings else []
    command += ["--cores", str(cores), "--quiet", "all", *arguments]
    subprocess.run([*command, "--", "results/tables/claims.csv"], check=True)
    return pd.read_csv(Path(folder) / "results/tables/claims.csv", keep_default_na=False, na_values=[""])


def report(tables, difference, output):
    """Write the verdicts of {run: table of claims}, and the tables as CSV; returns {claim: verdicts} that change.

    difference : seed or draw, which the runs differ in
    """
    verdicts = pd.DataFrame({run: overall(table) for run, table in tables.items()})
    moved = {claim: row.tolist() for claim, row in verdicts[verdicts.nunique(axis=1) > 1].iterrows()}
    save({"moved": moved, "verdicts": verdicts.to_dict()}, output)
    pd.concat(tables, names=[difference]).droplevel(1).to_csv(output.with_suffix(".csv"))
    for claim, outcomes in moved.items():
        click.echo(f"{claim}: {', '.join(outcomes)}")
    click.echo(f"{len(moved)} of {len(verdicts)} verdicts change with the {difference}")
    return moved
