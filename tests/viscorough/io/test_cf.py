"""Every kind of file that the command line writes follows the CF conventions, and says nothing of time and place."""

import netCDF4
import numpy as np
import pytest

from support.cf import violations
from support.command_line import sphere_heights
from viscorough import __version__, cli

CURVE = ("indent", "heights.npy", "--spacing", "1", "-o", "curve.nc")
MARCH = ("march", "heights.npy", "--spacing", "1", "--viscosity", "3")
COMMANDS = {
    "curve": CURVE,
    "fields": ("contact", "heights.npy", "--spacing", "1", "--force", "2", "-o", "fields.nc"),
    "several": ("contact", "heights.npy", "--spacing", "1", "--depth", "0.1,0.2", "--young", "2", "-o", "several.nc"),
    "kinetics": ("kinetics", "curve.nc", "--force", "2", "--viscosity", "3", "-o", "kinetics.nc"),
    "events": (*MARCH, "--force", "2", "--method", "events", "-o", "events.nc"),
    "steps": (*MARCH, "--force", "2", "--method", "implicit", "--times", "0.1,0.2", "-o", "steps.nc"),
    "history": (*MARCH, "--force-history", "force.csv", "--method", "explicit", "-o", "history.nc"),
}


@pytest.mark.parametrize("kind", COMMANDS)
def test_files_of_the_command_line(tmp_path, monkeypatch, capsys, kind):
    monkeypatch.chdir(tmp_path)
    np.save("heights.npy", sphere_heights(9))
    (tmp_path / "force.csv").write_text("0,1\n1,2\n2,2\n")
    for arguments in (CURVE, COMMANDS[kind]):
        assert cli.main(arguments) == 0, capsys.readouterr().err
    assert violations(tmp_path / f"{kind}.nc") == []
    with netCDF4.Dataset(tmp_path / f"{kind}.nc") as file:
        assert file.history == f"written by viscorough {__version__}"
        for name in file.ncattrs():
            assert str(tmp_path) not in str(file.getncattr(name))


def test_what_breaks_the_conventions_is_found(tmp_path):
    with netCDF4.Dataset(tmp_path / "bad.nc", "w") as file:
        file.Conventions = "CF-1.11"
        file.createDimension("x", 2)
        coordinate = file.createVariable("x", "f8", ("x",), fill_value=np.nan)
        coordinate.setncatts({"long_name": "place", "units": "MB"})
        coordinate[:] = [1.0, 1.0]
        file.createVariable("2nd", str, ("x",)).setncatts({"coordinates": "nowhere"})
    assert violations(tmp_path / "bad.nc") == [
        *("no title", "no source", "no history", "name 2nd"),
        *("x: units 'MB'", "x: a coordinate with a fill value", "x: a coordinate that is not monotonic"),
        *("2nd: no long_name", "2nd: coordinate nowhere is missing"),
    ]
