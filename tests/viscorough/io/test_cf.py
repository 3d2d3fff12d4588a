"""Every kind of file that the command line writes follows the CF conventions, and says nothing of time and place."""

import netCDF4
import numpy as np

from support.cf import violations
from support.command_line import run, sphere_heights
from viscorough import __version__

MARCH = "march heights.npy --spacing 1 --viscosity 3"
LINES = [
    "indent heights.npy --spacing 1 -o curve.nc",
    "contact heights.npy --spacing 1 --force 2 -o fields.nc",
    "contact heights.npy --spacing 1 --depth 0.1,0.2 --young 2 -o several.nc",
    "kinetics curve.nc --force 2 --viscosity 3 -o kinetics.nc",
    f"{MARCH} --force 2 --method events -o events.nc",
    f"{MARCH} --force 2 --method implicit --times 0.1,0.2 -o steps.nc",
    f"{MARCH} --force-history force.csv --method explicit -o history.nc",
]


def test_files_of_the_command_line(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    np.save("heights.npy", sphere_heights(9))
    (tmp_path / "force.csv").write_text("0,1\n1,2\n2,2\n")
    for line in LINES:
        assert run(line) == 0
        name = line.split()[-1]
        assert violations(name) == []
        with netCDF4.Dataset(name) as file:
            assert file.history == f"written by viscorough {__version__}"
            assert not any(str(tmp_path) in str(file.getncattr(attribute)) for attribute in file.ncattrs())
