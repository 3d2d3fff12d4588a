"""Compare the tables, ensembles and loading curves of two finished runs, value by value.

    python benchmarks/compare_tables.py OLD NEW --allow "tables/literature.csv*" --allow "curves/*, residual"

OLD and NEW are folders of results. Numbers must agree to 1e-12 relative, and texts must be equal. A file or column that
exists in only one run is a difference, too, unless --allow names it. Files that hold measured times are not compared.
The exit code is 1 if there is any difference.
"""

import fnmatch
import sys
from pathlib import Path

import click
import pandas as pd
import xarray as xr
from measured_times import holds_times

COMPARED = "tables/*.csv", "ensembles/**/*.nc", "curves/**/*.nc", "surfaces/**/*.nc"
TOLERANCE = 1e-12  # relative: allows a different order of operations, and is far below any tolerance of a computation


def content(path):
    """Return {column or variable: values} of a table or a NetCDF file, with the groups of the variables."""
    if path.suffix == ".csv":
        return dict(pd.read_csv(path, comment="#"))  # without the first line, which states how the table was made
    with xr.open_datatree(path, decode_times=False) as tree:
        return {
            f"{group.path}/{name}".lstrip("/"): pd.Series(variable.values.ravel())
            for group in tree.subtree
            for name, variable in group.dataset.variables.items()
        }


def difference(old, new):
    """Return the difference of a column's values in OLD and NEW (None: no such column) as text; "" if there is none."""
    if old is None or new is None:
        return "only in NEW" if old is None else "only in OLD"
    try:
        pd.testing.assert_series_equal(old, new, check_dtype=False, rtol=TOLERANCE, atol=0)
    except AssertionError as error:
        return " ".join(str(error).splitlines()[:3])
    return ""


@click.command(help=__doc__.splitlines()[0])
@click.argument("old", type=click.Path(exists=True, file_okay=False, path_type=Path))
@click.argument("new", type=click.Path(exists=True, file_okay=False, path_type=Path))
@click.option("--allow", multiple=True, help='A difference that is meant, "FILE, COLUMN"; may hold "*".')
def main(old, new, allow):
    names = {path.relative_to(run) for run in (old, new) for pattern in COMPARED for path in run.glob(pattern)}
    compared, differences = 0, 0
    for name in sorted(name for name in names if not holds_times(name)):
        contents = [content(run / name) if (run / name).is_file() else {} for run in (old, new)]
        for column in dict.fromkeys([*contents[0], *contents[1]]):
            text, what = difference(*(columns.get(column) for columns in contents)), f"{name}, {column}"
            is_allowed = any(fnmatch.fnmatch(what, pattern) for pattern in allow)
            compared, differences = compared + 1, differences + (bool(text) and not is_allowed)
            if text:
                click.echo(f"{'allowed' if is_allowed else 'DIFFERENCE'}: {what}: {text}")
    click.echo(f"{compared} columns compared, {differences} differences")
    sys.exit(differences > 0)


if __name__ == "__main__":
    main()
