"""Loading curves with the error of the grid on the command line."""

import numpy as np
import pytest

from support.command_line import run, save_in, values
from viscorough import indent, load_curve, read_heights, self_affine_disc
from viscorough.io.datasets import read_dataset


@pytest.fixture
def disc(here):
    """Make a disc in the file disc.nc."""
    disc = self_affine_disc(0.8, 65, rms=2e-8, diameter=1e-6, length_unit="m", seed=1)
    save_in("um", disc, "disc.nc")
    return read_heights("disc.nc")


def test_grid_error_is_stored_and_stated(disc, capsys):
    assert run("indent disc.nc --grid-error -o curve.nc") == 0
    expected = indent(disc, estimate_grid_error=True)
    assert read_dataset("curve.nc").variables["grid_error"].dims == ("level",)
    written = load_curve("curve.nc")
    np.testing.assert_allclose([written.depth, written.force], [expected.depth, expected.force], rtol=1e-14)
    np.testing.assert_array_equal(written.grid_error, expected.grid_error)
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
    assert read_dataset("motion.nc").attrs["mean_grid_error"] == load_curve("curve.nc").mean_grid_error


def test_kinetics_states_the_grid_error_of_the_force_at_the_largest_depth(disc, capsys, here):
    assert run("indent disc.nc --grid-error -o curve.nc") == 0
    curve = load_curve("curve.nc")
    level = curve.depth.size // 2
    (here / "depth.csv").write_text(f"time (s),depth (nm)\n0,0\n1,{1e9 * curve.depth[level]:.15g}\n2,0\n")
    assert run("kinetics curve.nc --depth-history depth.csv --viscosity 1e4 -o motion.nc") == 0
    expected = curve.force_grid_error[level]
    assert f"grid error of the force about {100 * expected:.2g} %" in capsys.readouterr().out
    assert read_dataset("motion.nc").attrs["force_grid_error"] == pytest.approx(expected)
