"""`viscorough generate`: files that other commands read back, and refusals."""

import numpy as np
import pytest

from support.command_line import run
from viscorough import indent, load_curve, read_line, self_affine_disc, self_affine_line
from viscorough.io.datasets import read_dataset

COMMON = "generate --hurst 0.7 --rms 0.2"
DISC = f"{COMMON} --elements 17 --diameter 34 --unit um"
LINE = f"{COMMON} --points 256 --diameter 128 --unit um"
END = "--seed 5 -o made.nc"

pytestmark = pytest.mark.usefixtures("here")


def disc(**options):
    return self_affine_disc(0.7, 17, rms=0.2, diameter=34, seed=5, **options)


def test_disc_has_heights_coordinates_and_units_and_is_read_back_by_indent():
    assert run(f"{DISC} {END}") == 0
    made = read_dataset("made.nc")
    np.testing.assert_allclose(made.variables["heights"].values, disc().heights, rtol=1e-14)
    assert made.variables["heights"].dims == ("y", "x")
    for name in ("x", "y"):
        np.testing.assert_allclose(made.variables[name].values, 2.0 * (np.arange(17) - 8), rtol=1e-15)
    assert {variable.attrs["units"] for variable in made.variables.values()} == {"um"}
    assert (made.attrs["hurst"], made.attrs["seed"], made.attrs["diameter"]) == (0.7, 5, 34)
    assert run("indent made.nc -o curve.nc") == 0
    curve = load_curve("curve.nc")
    np.testing.assert_allclose(curve.force, 1e-12 * indent(disc()).force, rtol=1e-9)
    assert curve.length_unit == "m"


def test_line_is_read_back_by_reduce():
    assert run(f"{LINE} {END}") == 0
    line = read_line("made.nc")
    expected = self_affine_line(0.7, 256, rms=0.2, length=128, seed=5).heights
    np.testing.assert_allclose(line.heights, 1e-6 * expected, rtol=1e-5, atol=1e-13)
    assert (line.spacing, line.length_unit) == (pytest.approx(5e-7, rel=1e-12), "m")
    assert run("reduce made.nc -o curve.nc") == 0


@pytest.mark.parametrize(
    ("line", "options"),
    [
        ("generate --hurst 0.7 --elements 17 --rms '200 nm' --diameter '0.034 mm' --unit µm", {}),
        (f"{DISC} --roll-off 0.25", {"roll_off_wavelength": 0.25, "roll_off_level": 0.0}),
        (f"{DISC} --roll-off 0.25 --plateau", {"roll_off_wavelength": 0.25, "roll_off_level": 1.0}),
    ],
)
def test_units_and_roll_off_are_passed_on(line, options):
    assert run(f"{line} {END}") == 0
    heights = read_dataset("made.nc").variables["heights"]
    np.testing.assert_allclose(heights.values, disc(**options).heights, rtol=1e-12)
    assert heights.attrs["units"] == "um"
