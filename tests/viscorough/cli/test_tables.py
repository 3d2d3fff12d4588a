"""Results as tables: by the suffix .csv of the output, and read again."""

import numpy as np

from support.command_line import run, sphere_heights
from viscorough.io import netcdf, tables


def test_tables_hold_the_same_as_netcdf_files(here):
    np.save("heights.npy", sphere_heights(9))
    for suffix in ("nc", "csv"):
        assert run(f"indent heights.npy --spacing 1 -o curve.{suffix}") == 0
        assert run(f"kinetics curve.{suffix} --force 1 --viscosity 2 -o motion.{suffix}") == 0
    for name in ("curve", "motion"):
        table, file = tables.read(here / f"{name}.csv"), netcdf.read(here / f"{name}.nc")
        assert table.attributes == file.attributes
        assert list(table.variables) == list(file.variables)
        for column, variable in file.variables.items():
            np.testing.assert_array_equal(table.variables[column].values, variable.values)
            assert table.variables[column].attributes == variable.attributes
