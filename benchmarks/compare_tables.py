"""Compare the tables, ensembles and loading curves of two finished runs, value by value.

    python benchmarks/compare_tables.py OLD NEW --allow "tables/literature.csv" --allow "curves/*, residual"

OLD and NEW are folders of results. Numbers must agree to 1e-12 relative and texts must be equal; files and columns that
only one of them has are differences, too, except those that --allow names. Files that hold measured times are not
compared. The exit code is 1 if there is any difference.
"""

import fnmatch
import sys
from pathlib import Path

import click
import numpy as np
import pandas as pd
import xarray as xr
from measured_times import holds_times

TOLERANCE = 1e-12  # relative: rounding of another order of operations, far below any tolerance of a computation


def content(path):
    """{column or variable: values} of a table or a NetCDF file."""
    if path.suffix == ".csv":
        table = pd.read_csv(path)
        return {name: table[name].to_numpy() for name in table}
    with xr.open_dataset(path, decode_times=False) as dataset:
        return {name: variable.values for name, variable in dataset.variables.items()}


def deviations(old, new):
    """Of every value: |new − old| over the larger of the two; inf where texts differ or only one number is finite."""
    if any(values.dtype.kind not in "biuf" for values in (old, new)):
        return np.where(old.astype(str) == new.astype(str), 0.0, np.inf)
    old, new = old.astype(float), new.astype(float)
    equal = (old == new) | (np.isnan(old) & np.isnan(new))
    with np.errstate(invalid="ignore", divide="ignore"):
        relative = np.abs(new - old) / np.maximum(np.abs(old), np.abs(new))
    return np.where(equal, 0.0, np.where(np.isfinite(relative), relative, np.inf))


def differences(name, old, new):
    """Name of every difference between two files, with what it is, and the number of values that were compared."""
    found = {f"{name}, {column}": "only in OLD" for column in old if column not in new}
    found |= {f"{name}, {column}": "only in NEW" for column in new if column not in old}
    compared = 0
    for column in set(old) & set(new):
        if old[column].shape != new[column].shape:
            found[f"{name}, {column}"] = f"shape {old[column].shape} in OLD, {new[column].shape} in NEW"
            continue
        compared += old[column].size
        deviation = deviations(old[column], new[column])
        if deviation.max(initial=0.0) > TOLERANCE:
            where = np.flatnonzero(deviation > TOLERANCE)
            first = " and ".join(str(values[column].ravel()[where[0]]) for values in (old, new))
            how_far = f"by up to {deviation.max():.2g} relative, first {first}"
            found[f"{name}, {column}"] = f"{where.size} of {deviation.size} differ, {how_far}"
    return found, compared


@click.command(help=__doc__.splitlines()[0])
@click.argument("old", type=click.Path(exists=True, file_okay=False, path_type=Path))
@click.argument("new", type=click.Path(exists=True, file_okay=False, path_type=Path))
@click.option("--allow", multiple=True, help='A difference that is meant, "FILE" or "FILE, COLUMN"; may hold "*".')
def main(old, new, allow):
    runs = [
        {path.relative_to(run) for pattern in ("tables/*.csv", "**/*.nc") for path in run.glob(pattern)}
        for run in (old, new)
    ]
    # A table is compared as CSV, not also as NetCDF.
    every = {name for name in runs[0] | runs[1] if (name.suffix == ".csv") == (name.parts[0] == "tables")}
    found, compared = {}, 0
    for name in sorted(every):
        if holds_times(name):
            click.echo(f"not compared, holds measured times: {name}")
        elif name not in runs[0] or name not in runs[1]:
            found[str(name)] = "only in OLD" if name in runs[0] else "only in NEW"
        else:
            more, values = differences(name, content(old / name), content(new / name))
            found, compared = found | more, compared + values
    meant = {name for name in found if any(fnmatch.fnmatch(name, pattern) for pattern in allow)}
    for name, what in found.items():
        click.echo(f"{'allowed' if name in meant else 'DIFFERENCE'}: {name}: {what}")
    click.echo(f"{compared} values compared, {len(found) - len(meant)} differences")
    sys.exit(len(found) > len(meant))


if __name__ == "__main__":
    main()
