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
    """{column or variable: values} of a table or a NetCDF file, with the groups of the variables."""
    if path.suffix == ".csv":
        table = pd.read_csv(path)
        return {name: table[name].to_numpy() for name in table}
    with xr.open_datatree(path, decode_times=False) as tree:
        return {
            f"{group.path}/{name}".lstrip("/"): variable.values
            for group in tree.subtree
            for name, variable in group.dataset.variables.items()
        }


def difference(old, new):
    """Difference between the values of a column in OLD and NEW, None where it is absent, as text; "" if none."""
    if old is None or new is None:
        return "only in NEW" if old is None else "only in OLD"
    if old.shape != new.shape:
        return f"shape {old.shape} in OLD, {new.shape} in NEW"
    if any(values.dtype.kind not in "biuf" for values in (old, new)):
        wrong, how_far = old.astype(str) != new.astype(str), ""
    else:
        old, new = old.astype(float), new.astype(float)
        wrong = ~np.isclose(new, old, rtol=TOLERANCE, atol=0, equal_nan=True)
        with np.errstate(invalid="ignore", divide="ignore"):
            how_far = f"by up to {np.max(np.abs(new / old - 1), where=wrong, initial=0):.2g} relative, "
    first = " and ".join(str(values.ravel()[np.argmax(wrong)]) for values in (old, new)) if wrong.any() else ""
    return f"{wrong.sum()} of {wrong.size} differ, {how_far}first {first}" if wrong.any() else ""


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
    differences, compared = {}, 0
    for name in sorted(every):
        if holds_times(name):
            click.echo(f"not compared, holds measured times: {name}")
        elif name not in runs[0] or name not in runs[1]:
            differences[str(name)] = "only in OLD" if name in runs[0] else "only in NEW"
        else:
            contents = content(old / name), content(new / name)
            for column in dict.fromkeys([*contents[0], *contents[1]]):
                values = [columns.get(column) for columns in contents]
                compared += values[0] is not None and values[0].size
                differences |= {f"{name}, {column}": text} if (text := difference(*values)) else {}
    allowed = {name for name in differences if any(fnmatch.fnmatch(name, pattern) for pattern in allow)}
    for name, text in differences.items():
        click.echo(f"{'allowed' if name in allowed else 'DIFFERENCE'}: {name}: {text}")
    click.echo(f"{compared} values compared, {len(differences) - len(allowed)} differences")
    sys.exit(len(differences) > len(allowed))


if __name__ == "__main__":
    main()
