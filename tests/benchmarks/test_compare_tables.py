"""The comparison of two runs finds every difference, except measured times and differences that are allowed."""

import compare_tables
import numpy as np
import pandas as pd
import pytest
import xarray as xr
from click.testing import CliRunner

from viscorough_study.run.tables import read_table, write_table


@pytest.fixture
def runs(tmp_path):
    """Make two runs with the same numbers and different measured times."""
    for name, seconds in (("old", 1.0), ("new", 2.0)):
        (tmp_path / name / "tables").mkdir(parents=True)
        (tmp_path / name / "surfaces").mkdir()
        claims = pd.DataFrame({"claim": ["beta"], "value": [0.3], "note": [np.nan]})
        columns = {column: (column, None) for column in claims}
        write_table(claims, tmp_path / name / "tables/claims.csv", columns=columns, title=f"Claims, {name}")
        pd.DataFrame({"wall_s": [seconds]}).to_csv(tmp_path / name / "tables/methods.csv", index=False)
        heights = xr.Dataset({"heights": (("y", "x"), [[1.0, 2.0]])})
        heights.to_netcdf(tmp_path / name / "surfaces/examples.nc", group="ensemble_1")
    return tmp_path / "old", tmp_path / "new"


def compared(runs, *options):
    """Return the exit code and the output of the comparison of two runs."""
    result = CliRunner().invoke(compare_tables.main, [*map(str, runs), *options])
    return int(result.exit_code), result.output


@pytest.mark.parametrize(
    ("column", "change", "differs"),
    [
        ("value", lambda value: value * (1 + 1e-11), True),
        ("value", lambda value: value * np.nan, True),
        ("claim", lambda value: value + "x", True),
        ("more", lambda value: 1, True),
        ("value", lambda value: value * (1 + 1e-14), False),
    ],
)
def test_difference_in_a_table_is_found(runs, column, change, differs):
    path = runs[1] / "tables/claims.csv"
    content = read_table(path)
    content.assign(**{column: change(content.get(column))}).to_csv(path, index=False)
    code, output = compared(runs)
    assert code == differs
    assert (f"DIFFERENCE: tables/claims.csv, {column}: " in output) == differs
    assert compared(runs, "--allow", f"*claims.csv, {column}")[0] == 0


def test_values_in_groups_are_compared(runs):
    heights = xr.Dataset({"heights": (("y", "x"), [[1.0, 3.0]])})
    heights.to_netcdf(runs[1] / "surfaces/examples.nc", group="ensemble_1")
    assert "DIFFERENCE: surfaces/examples.nc, ensemble_1/heights: " in compared(runs)[1]
