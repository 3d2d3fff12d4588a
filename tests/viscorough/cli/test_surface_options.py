"""Reading and preparing surfaces from the command line: right numbers or one line, never wrong numbers in silence."""

import numpy as np
import pytest
import tifffile

from support.command_line import run
from viscorough import Indenter, indent, load_curve
from viscorough.io import netcdf

N = 17
DX, DY = 0.5, 0.75  # micrometres
X, Y = DX * (np.arange(N) - 8), DY * (np.arange(N) - 8)[:, None]
ROUGH = -(X**2 + Y**2) / 200 + 1e-3 * np.random.default_rng(0).standard_normal((N, N))  # micrometres
DEPTHS = "--depths 0.05,0.2"
SPACING = "--spacing 0.5,0.75 --unit um"


@pytest.fixture
def here(here):
    """A working folder with the same map in several formats and units."""
    Indenter(ROUGH, DX, DY, length_unit="um").save("scan.nc")
    np.save("scan.npy", ROUGH)
    np.savetxt("scan.txt", ROUGH)
    return here


def curve_of(capsys, arguments, *warnings):
    """The loading curve that indent makes, after a check of what it wrote to stderr; and its file's attributes."""
    assert run(f"indent {arguments} -o curve.nc") == 0
    lines, attributes = capsys.readouterr().err.splitlines(), netcdf.read("curve.nc").attributes
    assert len(lines) == len(warnings)
    for line, warning in zip(lines, warnings, strict=True):
        assert line.startswith("viscorough indent: warning: ")
        assert warning in line
        assert warning in attributes["warnings"]
    return load_curve("curve.nc"), attributes


def assert_same(curve, other, rtol=1e-9):
    for name in ("depth", "force", "stiffness"):
        np.testing.assert_allclose(getattr(curve, name), getattr(other, name), rtol=rtol)


def right_curve(heights=ROUGH):
    return indent(Indenter(heights, DX, DY, length_unit="um"), depths=[0.05, 0.2])


# ---- numbers that used to be wrong


def test_coordinates_with_different_spacings_are_used(here, capsys):
    """They were ignored, and depths were 10 to 19 % off."""
    curve, attributes = curve_of(capsys, f"scan.nc {DEPTHS}")
    assert_same(curve, right_curve())
    assert curve.length_unit == "um"
    expected = {"spacing": DX, "row_spacing": DY, "length_unit": "um", "preparation": "none", "heights": "scan.nc"}
    assert {name: attributes[name] for name in expected} == expected
    assert_same(curve_of(capsys, f"scan.npy --spacing 0.5,0.75 {DEPTHS}")[0], curve)
    assert_same(curve_of(capsys, f"scan.txt --spacing '500 nm,0.75 um' --unit um {DEPTHS}")[0], curve)


def test_tilt_is_told_and_removed(here, capsys):
    np.save("tilted.npy", ROUGH - ROUGH.mean() + 3 * X - 2 * Y)
    tilted = "tilted.npy: the map is tilted: a plane through it rises by 48"
    _, attributes = curve_of(capsys, f"tilted.npy {SPACING} {DEPTHS}", tilted, "slope")
    assert "--detrend plane removes it" in attributes["warnings"]
    curve, attributes = curve_of(capsys, f"tilted.npy {SPACING} {DEPTHS} --detrend plane")
    plane = np.stack([np.ones((N, N)), np.broadcast_to(X, (N, N)), np.broadcast_to(Y, (N, N))], axis=-1).reshape(-1, 3)
    level = ROUGH - (plane @ np.linalg.lstsq(plane, ROUGH.ravel())[0]).reshape(N, N)
    assert_same(curve, right_curve(level), rtol=1e-6)
    assert attributes["preparation"] == "--detrend plane"


def test_marks_of_missing_points_are_told_and_removed(here, capsys):
    marked = ROUGH.copy()
    marked[0, :3] = -9999
    marked[8, 8] = np.nan
    np.save("marked.npy", marked)
    assert run(f"indent marked.npy {SPACING} {DEPTHS} -o curve.nc") == 0
    err = capsys.readouterr().err
    assert "3 points (1 %) have the value -9999, far from all others" in err
    assert "1 enclosed region without heights" in err
    curve, attributes = curve_of(capsys, f"marked.npy {SPACING} {DEPTHS} --nodata -9999 --fill harmonic")
    filled = ROUGH.copy()
    filled[0, :3] = np.nan
    aspect = (DY / DX) ** 2
    across, along = filled[8, 7] + filled[8, 9], filled[7, 8] + filled[9, 8]
    filled[8, 8] = (aspect * across + along) / (2 * aspect + 2)
    assert_same(curve, right_curve(filled))
    assert curve.elements == N * N - 3
    assert attributes["preparation"] == "--nodata -9999 --fill harmonic"


def test_crop_flip_and_channel_are_recorded(here, capsys):
    tifffile.imwrite("scan.tif", np.stack([0 * ROUGH, -ROUGH]), photometric="minisblack")
    curve, attributes = curve_of(capsys, f"scan.tif {SPACING} {DEPTHS} --channel 1 --crop 2:15,1:16 --flip")
    assert_same(curve, right_curve(ROUGH[1:16, 2:15]))
    assert (attributes["channel"], attributes["preparation"]) == ("1", "--crop 2:15,1:16 --flip")
