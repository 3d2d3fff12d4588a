"""Loading curves with the error of the grid on the command line."""

import pytest

import viscorough
from support.command_line import run, values
from viscorough import indent, load_curve, read_heights, self_affine_disc
from viscorough.io import netcdf


@pytest.fixture
def disc(here):
    """Make a disc in the file disc.nc."""
    viscorough.save(self_affine_disc(0.8, 65, rms=0.02, length_unit="um", seed=1), "disc.nc")
    return read_heights("disc.nc")


def test_grid_error_is_stored_and_stated(disc, capsys):
    assert run("indent disc.nc --grid-error -o curve.nc") == 0
    expected = indent(disc, estimate_grid_error=True)
    assert netcdf.read("curve.nc").variables["grid_error"].dimensions == ("level",)
    written = load_curve("curve.nc")
    assert written == expected
    text = f"grid error about {100 * expected.mean_grid_error:.2g} %: a scan twice as fine would change the velocity by"
    assert text in capsys.readouterr().out.splitlines()[-1]
    assert run("indent disc.nc -o curve.nc") == 0
    assert "grid error" not in capsys.readouterr().out
    assert "grid_error" not in values("curve.nc")


def test_kinetics_states_the_grid_error_of_its_curve(disc, capsys):
    assert run("indent disc.nc --grid-error -o curve.nc") == 0
    line = capsys.readouterr().out.splitlines()[-1]
    assert run("kinetics curve.nc --force '1 uN' --viscosity 1e4 -o motion.nc") == 0
    assert capsys.readouterr().out.splitlines()[-1] == line
    assert netcdf.read("motion.nc").attributes["mean_grid_error"] == load_curve("curve.nc").mean_grid_error


def test_kinetics_states_the_grid_error_of_the_force_at_the_largest_depth(disc, capsys, here):
    assert run("indent disc.nc --grid-error -o curve.nc") == 0
    curve = load_curve("curve.nc")
    level = curve.depth.size // 2
    (here / "depth.csv").write_text(f"time (s),depth (nm)\n0,0\n1,{1000 * curve.depth[level]:.15g}\n2,0\n")
    assert run("kinetics curve.nc --depth-history depth.csv --viscosity 1e4 -o motion.nc") == 0
    expected = curve.force_grid_error[level]
    assert f"grid error of the force about {100 * expected:.2g} %" in capsys.readouterr().out
    assert netcdf.read("motion.nc").attributes["force_grid_error"] == pytest.approx(expected)
