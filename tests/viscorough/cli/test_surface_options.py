"""Reading and preparing surfaces from the command line: right numbers or one line, never wrong numbers in silence."""

import os

import netCDF4
import numpy as np
import pytest
import tifffile

from viscorough import cli
from viscorough.contact.loading_path import indent
from viscorough.indenter import Indenter
from viscorough.io import netcdf
from viscorough.io.curves import curve_from_content

N = 17
DX, DY = 0.5, 0.75  # micrometres
X, Y = DX * (np.arange(N) - 8), DY * (np.arange(N) - 8)[:, None]
ROUGH = -(X**2 + Y**2) / 200 + 1e-3 * np.random.default_rng(0).standard_normal((N, N))  # micrometres
DEPTHS = ["--depths", "0.05,0.2"]


@pytest.fixture
def here(tmp_path, monkeypatch):
    """A working folder with the same map as NetCDF in several units, and others for what can go wrong."""
    monkeypatch.chdir(tmp_path)
    _write_netcdf("scan.nc", ROUGH, "um")
    _write_netcdf("nanometres.nc", 1e3 * ROUGH, "nm")
    np.save("scan.npy", ROUGH)
    np.savetxt("scan.txt", ROUGH)
    return tmp_path


def _write_netcdf(path, heights, unit, axis_unit="um"):
    with netCDF4.Dataset(path, "w") as file:
        for name, positions in (("y", Y), ("x", X)):
            file.createDimension(name, N)
            file.createVariable(name, "f8", (name,))[:] = positions.ravel()
            file[name].units = axis_unit
        file.createVariable("z", "f8", ("y", "x"))[:] = heights
        file["z"].units = unit


def curve_of(capsys, *arguments, warning=None):
    """The loading curve that indent makes, after a check of what it wrote to stderr; and its file's attributes."""
    assert cli.main(["indent", *arguments, "-o", "curve.nc"]) == 0
    err = capsys.readouterr().err
    if warning is None:
        assert err == ""
    else:
        (line,) = err.splitlines()
        assert line.startswith("viscorough indent: warning: ")
        assert warning in line
    content = netcdf.read("curve.nc")
    assert (warning or "") in content.attributes.get("warnings", "")
    return curve_from_content(content), content.attributes


def assert_same(curve, other, rtol=1e-9):
    for name in ("depth", "force", "stiffness"):
        np.testing.assert_allclose(getattr(curve, name), getattr(other, name), rtol=rtol)


def right_curve(heights=ROUGH, **options):
    return indent(Indenter(heights, DX, DY, length_unit="um"), depths=[0.05, 0.2], **options)


# ---- numbers that used to be wrong


def test_coordinates_with_different_spacings_are_used(here, capsys):
    """They were ignored, and depths were 10 to 19 % off."""
    curve, attributes = curve_of(capsys, "scan.nc", *DEPTHS)
    assert_same(curve, right_curve())
    assert curve.length_unit == "um"
    stated = {name: attributes[name] for name in ("spacing", "row_spacing", "length_unit", "preparation", "heights")}
    expected = {"spacing": DX, "row_spacing": DY, "length_unit": "um", "preparation": "none", "heights": "scan.nc"}
    assert stated == expected
    assert_same(curve_of(capsys, "scan.npy", "--spacing", "0.5,0.75", *DEPTHS)[0], curve)
    assert_same(curve_of(capsys, "scan.txt", "--spacing", "500 nm,0.75 um", "--unit", "um", *DEPTHS)[0], curve)


def test_heights_in_nanometres_beside_coordinates_in_micrometres(here, capsys):
    curve, attributes = curve_of(capsys, "nanometres.nc", "--depths", "50,200")
    right = right_curve()
    np.testing.assert_allclose(curve.depth, 1e3 * right.depth)
    np.testing.assert_allclose(curve.force, 1e6 * right.force, rtol=1e-6)
    np.testing.assert_allclose(curve.stiffness, 1e3 * right.stiffness, rtol=1e-6)
    assert (attributes["spacing"], attributes["row_spacing"], attributes["length_unit"]) == (500, 750, "nm")
    assert (curve.length_unit, netcdf.read("curve.nc").variables["force"].attributes["units"]) == ("nm", "nm2")


def test_kinetics_of_a_curve_in_micrometres_with_a_viscosity_in_pascal_seconds(here, capsys):
    """Times were wrong by 1e12: the same as in metres."""
    np.save("metres.npy", 1e-6 * ROUGH)
    times = []
    for arguments in (["scan.nc"], ["metres.npy", "--spacing", "5e-7,7.5e-7", "--unit", "m"]):
        depths = "0.05 um,0.2 um"
        assert cli.main(["indent", *arguments, "--depths", depths, "-o", "curve.nc"]) == 0
        for force, viscosity in (("5e-6", "1e6"), ("5 uN", "1 MPa s")):
            command = ["kinetics", "curve.nc", "--force", force, "--viscosity", viscosity, "-o", "kinetics.nc"]
            assert cli.main(command) == 0
            times.append(netcdf.read("kinetics.nc").variables["time"].values)
    force = right_curve().force  # over G, in square micrometres
    for time in times:
        np.testing.assert_allclose(time, force * 1e-12 * 1e6 / 5e-6, rtol=1e-6)


def test_tilt_is_told_and_removed(here, capsys):
    np.save("tilted.npy", ROUGH - ROUGH.mean() + 3 * X - 2 * Y)
    spacing = ["--spacing", "0.5,0.75", "--unit", "um"]
    assert cli.main(["indent", "tilted.npy", *spacing, *DEPTHS, "-o", "tilted.nc"]) == 0
    lines = capsys.readouterr().err.splitlines()
    assert "tilted.npy: the map is tilted: a plane through it rises by 48" in lines[0]
    assert "--detrend plane removes it" in netcdf.read("tilted.nc").attributes["warnings"]
    curve, attributes = curve_of(capsys, "tilted.npy", *spacing, *DEPTHS, "--detrend", "plane")
    plane = np.polynomial.polynomial.polyvander2d(np.broadcast_to(X, (N, N)), np.broadcast_to(Y, (N, N)), [1, 1])
    plane = plane[..., [0, 1, 2]].reshape(-1, 3)
    level = ROUGH - (plane @ np.linalg.lstsq(plane, ROUGH.ravel())[0]).reshape(N, N)
    assert_same(curve, right_curve(level), rtol=1e-6)
    assert attributes["preparation"] == "--detrend plane"


def test_marks_of_missing_points_are_told_and_removed(here, capsys):
    marked = ROUGH.copy()
    marked[0, :3] = -9999
    marked[8, 8] = np.nan
    np.save("marked.npy", marked)
    arguments = ["marked.npy", "--spacing", "0.5,0.75", "--unit", "um", *DEPTHS]
    assert cli.main(["indent", *arguments, "-o", "curve.nc"]) == 0
    err = capsys.readouterr().err
    assert "3 points (1 %) have the value -9999, far from all others" in err
    assert "1 enclosed region without heights" in err
    curve, attributes = curve_of(capsys, *arguments, "--nodata", "-9999", "--fill", "harmonic")
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
    prepared = ["--channel", "1", "--crop", "2:15,1:16", "--flip"]
    curve, attributes = curve_of(capsys, "scan.tif", "--spacing", "0.5,0.75", "--unit", "um", *DEPTHS, *prepared)
    assert_same(curve, right_curve(ROUGH[1:16, 2:15]))
    assert (attributes["channel"], attributes["preparation"]) == ("1", "--crop 2:15,1:16 --flip")


# ---- bad input

SCAN = ["scan.npy", "--spacing", "1"]
BAD = [
    *[
        (["scan.npy", "--spacing", spacing], "--spacing")
        for spacing in (
            "0.5,",
            ",1",
            "1,2,3",
            "1,-1",
            "1 V",
            "1 um,2 s",
            "um",
            "1 um 2",
            "0 um",
            "1 um",
            "1,nan",
            "2 um,3",
        )
    ],
    (["scan.npy"], "--spacing is needed"),
    (["scan.npy", "--spacing", "1,9"], "1 between columns and 9 between rows"),
    *[
        ([*SCAN, "--unit", unit], "--unit")
        for unit in ("", "1", "V", "m2", "furlongs per fortnight", "9**9**9", "-1 m")
    ],
    *[([*SCAN, "--nodata", value], "--nodata") for value in ("", "a", "1,", "nan", "inf", "1 2", "1e999")],
    *[
        ([*SCAN, "--crop", crop], "--crop")
        for crop in ("", "1", "1:2", "1:2,", "a:b,c:d", "1:2,3:4,5:6", "-1:2,0:3", "0:1.5,0:3", "1:2;3:4")
    ],
    ([*SCAN, "--crop", "0:18,0:3"], "crop to columns 0:18; within 0:17"),
    ([*SCAN, "--crop", "0:3,5:5"], "crop to rows 5:5"),
    ([*SCAN, "--detrend", "cubic"], "--detrend"),
    ([*SCAN, "--detrend", ""], "--detrend"),
    ([*SCAN, "--fill", "linear"], "--fill"),
    ([*SCAN, "--flip", "yes"], "yes"),
    ([*SCAN, "--channel", "height"], "--channel height"),
    (["scan.nc", "--spacing", "0.5"], "--spacing 0.5 um contradicts the file, in which rows are 0.75 um apart"),
    (["scan.nc", "--spacing", "0.5 nm,0.75 nm"], "contradicts the file"),
    (["scan.nc", "--unit", "nm"], "--unit nm contradicts the file"),
    (["scan.nc", "--channel", "y"], "heights have the shape (17,)"),
    (["scan.nc", "--channel", "w"], "none of them is the channel w"),
    (["volts.nc"], "unit 'V': not a unit of length"),
    (["degrees.nc"], "degrees"),
    (["degrees.nc", "--spacing", "0.5,0.75"], "degrees"),
    (["scan.npy", "--spacing", "1e-3", "--detrend", "sphere"], "crop to a cap of it"),
    (["ragged.txt", "--spacing", "1"], "line 2: 1 cells, 2 in line 1"),
    (["words.csv", "--spacing", "1"], "no row of numbers"),
    (["scattered.xyz"], "form no grid"),
    (["noise.tif", "--spacing", "1"], "noise.tif: not readable"),
    (["colours.tif", "--spacing", "1"], "3 colours"),
    (["noise.x3p"], "noise.x3p"),
    (["missing.sur"], "missing.sur: not readable (No such file"),
    (["missing.txt"], "missing.txt: not readable (No such file"),
    (["pipe.txt"], "pipe.txt: not readable (it is a pipe)"),
    (["folder.csv"], "folder.csv: not readable"),
]


@pytest.mark.parametrize(("arguments", "what"), BAD)
def test_bad_input_is_one_line(here, capsys, arguments, what):
    _write_netcdf("volts.nc", ROUGH, "V")
    _write_netcdf("degrees.nc", ROUGH, "m", "degrees_north")
    (here / "ragged.txt").write_text("1 2\n3\n")
    (here / "words.csv").write_text("a,b\nc,d\n")
    (here / "scattered.xyz").write_text("0 0 1\n1 0.3 2\n2.4 1 3\n")
    (here / "noise.tif").write_bytes(b"II*\x00" + bytes(range(200)))
    (here / "noise.x3p").write_bytes(b"PK" + bytes(range(200)))
    (here / "folder.csv").mkdir()
    os.mkfifo("pipe.txt")
    tifffile.imwrite("colours.tif", np.zeros((5, 7, 3), "u1"), photometric="rgb")
    before = sorted(here.iterdir())
    assert cli.main(["indent", *arguments, "-o", "out.nc"]) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    (line,) = captured.err.splitlines()
    assert line.startswith("viscorough indent: ")
    assert what in line
    assert len(line) < 400
    assert sorted(here.iterdir()) == before
