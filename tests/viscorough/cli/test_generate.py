"""`viscorough generate`: what other commands read back, and what is refused."""

import numpy as np
import pytest

from support.cf import violations
from support.contract import complaint
from viscorough.cli import main
from viscorough.contact.loading_path import indent
from viscorough.io import netcdf
from viscorough.io.curves import curve_from_content
from viscorough.io.surfaces import read_line
from viscorough.surfaces import self_affine_disc, self_affine_line

DISC = ["generate", "--hurst", "0.7", "--elements", "17", "--rms", "0.2", "--diameter", "34", "--unit", "um"]
LINE = ["generate", "--hurst", "0.7", "--points", "256", "--rms", "0.2", "--diameter", "128", "--unit", "um"]
END = ["--seed", "5", "-o", "made.nc"]


@pytest.fixture(autouse=True)
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_disc_has_heights_coordinates_and_units(here):
    assert main([*DISC, *END]) == 0
    made = netcdf.read(here / "made.nc")
    disc = self_affine_disc(0.7, 17, rms=0.2, diameter=34, seed=5)
    np.testing.assert_array_equal(made.variables["heights"].values, disc.heights)
    assert made.variables["heights"].dimensions == ("y", "x")
    for name in ("x", "y"):
        np.testing.assert_allclose(made.variables[name].values, 2.0 * (np.arange(17) - 8), rtol=1e-15)
    assert {variable.attributes["units"] for variable in made.variables.values()} == {"um"}
    assert (made.attributes["hurst"], made.attributes["seed"], made.attributes["diameter"]) == (0.7, 5, 34)
    assert violations(here / "made.nc") == []


def test_line_is_read_back_by_reduce(here):
    assert main([*LINE, *END]) == 0
    line = read_line(here / "made.nc")
    np.testing.assert_array_equal(line.heights, self_affine_line(0.7, 256, rms=0.2, length=128, seed=5).heights)
    assert (line.spacing, line.length_unit) == (pytest.approx(0.5, rel=1e-12), "um")
    assert violations(here / "made.nc") == []


def test_disc_is_read_back_by_indent_with_nothing_else_said(here):
    assert main([*DISC, *END]) == 0
    assert main(["indent", "made.nc", "-o", "curve.nc"]) == 0
    curve = curve_from_content(netcdf.read(here / "curve.nc"))
    wanted = indent(self_affine_disc(0.7, 17, rms=0.2, diameter=34, seed=5))
    np.testing.assert_allclose(curve.force, wanted.force, rtol=1e-9)
    assert curve.length_unit == "um"


def test_numbers_may_have_units(here):
    numbers = ["--rms", "200 nm", "--diameter", "0.034 mm", "--unit", "µm"]
    assert main([*DISC[:5], *numbers, *END]) == 0
    made = netcdf.read(here / "made.nc")
    np.testing.assert_allclose(
        made.variables["heights"].values, self_affine_disc(0.7, 17, rms=0.2, diameter=34, seed=5).heights, rtol=1e-12
    )
    assert made.variables["heights"].attributes["units"] == "um"


def test_roll_off_is_passed_on(here):
    for extra, level in (([], 0.0), (["--plateau"], 1.0)):
        assert main([*DISC, "--roll-off", "0.25", *extra, *END]) == 0
        options = {"roll_off_wavelength": 0.25, "roll_off_level": level}
        disc = self_affine_disc(0.7, 17, rms=0.2, diameter=34, seed=5, **options)
        np.testing.assert_array_equal(netcdf.read(here / "made.nc").variables["heights"].values, disc.heights)


@pytest.mark.parametrize(
    ("arguments", "what"),
    [
        ([*DISC, "--hurst", "1.2", *END], "--hurst"),
        ([*DISC, "--hurst", "nan", *END], "hurst"),
        ([*DISC, "--elements", "2", *END], "--elements"),
        ([*DISC, "--elements", "17.5", *END], "--elements"),
        ([*DISC, "--rms", "0", *END], "--rms': '0' is not a number above 0"),
        ([*DISC, "--rms", "2 s", *END], "cannot be converted to m"),
        ([*DISC, "--diameter", "-1", *END], "--diameter"),
        ([*DISC, "--unit", "kg", *END], "unit 'kg': not a unit of length"),
        ([*DISC, "--unit", "1", "--rms", "2 um", *END], "--rms 2 um: needs a plain number"),
        ([*DISC, "--seed", "-1", "-o", "made.nc"], "--seed"),
        ([*DISC, "--points", "9", *END], "one of --elements (a disc) and --points (a line) is needed"),
        ([*DISC[:3], *DISC[5:], *END], "one of --elements (a disc) and --points (a line) is needed"),
        ([*DISC, "--plateau", *END], "--plateau is for use with --roll-off"),
        ([*DISC, "--roll-off", "1e-3", *END], "roll_off_wavelength: must leave at least one wave"),
        ([*DISC, "-o", "made.nc"], "--seed"),
        ([*DISC, "--seed", "1", "-o", "made.csv"], "maps are no table; a NetCDF file (.nc) is needed"),
        ([*DISC, "--seed", "1", "-o", "none/made.nc"], "there is no folder none"),
        ([*LINE, "--points", "1", *END], "--points"),
        ([*DISC, "--elements", "9999999", *END], "memory"),
    ],
)
def test_mistakes_are_one_line(here, capsys, arguments, what):
    assert what in complaint(arguments, capsys, here)
