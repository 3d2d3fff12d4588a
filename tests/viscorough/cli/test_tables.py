"""Results as tables: by the suffix .csv of the output, and read again."""

import numpy as np
import pytest

from support.command_line import sphere_heights
from viscorough.cli import main
from viscorough.io import netcdf, tables


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    np.save("heights.npy", sphere_heights(9))
    return tmp_path


def test_tables_hold_the_same_as_netcdf_files(here):
    for suffix in ("nc", "csv"):
        curve, motion = f"curve.{suffix}", f"motion.{suffix}"
        assert main(["indent", "heights.npy", "--spacing", "1", "-o", curve]) == 0
        assert main(["kinetics", curve, "--force", "1", "--viscosity", "2", "-o", motion]) == 0
    for name in ("curve", "motion"):
        table, file = tables.read(here / f"{name}.csv"), netcdf.read(here / f"{name}.nc")
        assert table.attributes == file.attributes
        assert list(table.variables) == list(file.variables)
        for column, variable in file.variables.items():
            np.testing.assert_array_equal(table.variables[column].values, variable.values)
            assert table.variables[column].attributes == variable.attributes


@pytest.mark.parametrize("text", ["", "depth\n1.0\n", "a,b\n1,2\n"])
def test_other_tables_are_refused_in_one_line(here, capsys, text):
    (here / "curve.csv").write_text(text)
    assert main(["kinetics", "curve.csv", "--force", "1", "--viscosity", "2", "-o", "motion.nc"]) == 2
    error = capsys.readouterr().err
    assert error.startswith("viscorough kinetics: curve.csv: ")
    assert len(error.splitlines()) == 1
    assert not (here / "motion.nc").exists()
