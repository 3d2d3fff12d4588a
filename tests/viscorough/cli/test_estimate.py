"""`viscorough estimate`: the table on standard output, files, units, and what is refused."""

import numpy as np
import pytest

from support.contract import complaint
from viscorough.cli import main
from viscorough.estimates import estimate
from viscorough.io import netcdf, tables
from viscorough.viscous.media import Maxwell

SI = ["--rms", "1e-6", "--diameter", "0.01", "--force", "10", "--viscosity", "1e6"]
ESTIMATE = ["estimate", "--hurst", "0.8", *SI, "--times", "1e-5,1e-4"]
WANTED = estimate(0.8, 1e-6, 0.01, 10.0, 1e6, [1e-5, 1e-4])


@pytest.fixture(autouse=True)
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_table_on_standard_output(here, capsys):
    assert main(ESTIMATE) == 0
    captured = capsys.readouterr()
    assert captured.err == ""
    law, head, *rows = captured.out.splitlines()
    assert law.startswith(
        "vt/h = X + g(X) for H = 0.8, X from 0.001 to 30; X^beta/zeta from 0.000962 to 0.0736: beta 0.4418 ["
    )
    assert head.split() == ["time", "X", "depth", "from", "to", "velocity", "from", "to"]
    numbers = np.array([[float(cell) for cell in row.split()] for row in rows])
    names = ("time", "x", "depth", "depth_low", "depth_high", "velocity", "velocity_low", "velocity_high")
    np.testing.assert_allclose(numbers.T, [getattr(WANTED, name) for name in names], rtol=1e-3)
    assert not list(here.iterdir())


@pytest.mark.parametrize("name", ["estimate.nc", "estimate.csv"])
def test_files_hold_every_number(here, capsys, name):
    assert main([*ESTIMATE, "-o", name]) == 0
    assert capsys.readouterr().out == f"{name}: 2 times, 2 in the range of the law\n"
    content = (tables if name.endswith("csv") else netcdf).read(here / name)
    for variable in ("time", "x", "depth", "depth_low", "depth_high", "velocity", "velocity_low", "velocity_high"):
        np.testing.assert_array_equal(content.variables[variable].values, getattr(WANTED, variable))
    assert content.attributes["hurst"] == 0.8
    assert content.variables["depth"].attributes["units"] == "1"


def test_units_are_converted(here):
    units = ["--rms", "1 um", "--diameter", "1 cm", "--force", "1e4 mN", "--viscosity", "1 MPa s"]
    assert main(["estimate", "--hurst", "0.8", *units, "--times", "1e-5,1e-4", "-o", "a.nc"]) == 0
    variables = netcdf.read(here / "a.nc").variables
    np.testing.assert_allclose(variables["depth"].values, WANTED.depth, rtol=1e-12)
    assert (variables["depth"].attributes["units"], variables["velocity"].attributes["units"]) == ("m", "m s-1")


def test_media_are_read_from_files(here):
    (here / "maxwell.yaml").write_text("kind: maxwell\nshear_modulus: 50 MPa\nviscosity: 1000 Pa s\n")
    units = ["--rms", "1 um", "--diameter", "1 cm", "--force", "10 mN"]
    times = ["--times", "1e-4,1e-3", "-o", "a.nc"]
    assert main(["estimate", "--hurst", "0.8", *units, "--medium", "maxwell.yaml", *times]) == 0
    wanted = estimate(0.8, 1e-6, 0.01, 0.01, Maxwell(5e7, 1e3), [1e-4, 1e-3])
    content = netcdf.read(here / "a.nc")
    np.testing.assert_allclose(content.variables["velocity"].values, wanted.velocity, rtol=1e-12)
    assert content.attributes["medium"] == "maxwell.yaml"


def test_times_outside_of_the_range_are_marked_and_warned_about(here, capsys):
    assert main([*ESTIMATE[:-1], "1e-9,1e-5,1"]) == 0
    captured = capsys.readouterr()
    assert captured.err.startswith(
        "viscorough estimate: warning: 2 of 3 times are outside the range of the law, X from "
    )
    rows = captured.out.splitlines()[2:]
    assert [row.split()[-1] for row in rows] == ["below", rows[1].split()[7], "above"]
    assert rows[0].split()[2:8] == ["-"] * 6


@pytest.mark.parametrize(
    ("arguments", "what"),
    [
        (["--hurst", "0.05"], "hurst of the penetration law: must be from 0.1 to 1"),
        (["--hurst", "2"], "--hurst"),
        (["--rms", "0"], "--rms"),
        (["--rms", "1 um"], "--rms 1 um, --diameter 0.01: one has a unit; both or none is allowed"),
        (["--diameter", "inf"], "--diameter"),
        (["--force", "-1"], "--force"),
        (["--force", "1 N"], "--force 1 N: has a unit, but the lengths have none"),
        (["--force", "1 Pa"], "cannot be converted to N"),
        (["--viscosity", "0"], "--viscosity"),
        (["--viscosity", "1 MPa s"], "--viscosity 1 MPa s: has a unit, but the lengths have none"),
        (["--times", "2,1"], "each number must be larger"),
        (["--times", "0,1"], "--times"),
        (["--times", ""], "--times"),
        (["--times", "1,2"], "where the law holds; elsewhere indent a surface made by viscorough generate"),
        (["--force", "1e300", "--rms", "1e-300"], "where the law holds"),
        (["-o", "none/out.nc"], "there is no folder none"),
        (["--medium", "none.yaml"], "one of --viscosity and --medium is needed"),
    ],
)
def test_mistakes_are_one_line(here, capsys, arguments, what):
    assert what in complaint([*ESTIMATE, *arguments], capsys, here)


@pytest.mark.parametrize(
    ("text", "options", "what"),
    [
        ("kind: water", [], "medium.yaml: kind 'water'; allowed: newtonian"),
        ("kind: newtonian\nviscosity: 1 Pa s", [], "since the unit of length is not known"),
        ("kind: creep_table\nfile: J.csv", [], "beyond the last time of the creep table"),
        ("kind: newtonian\nviscosity: 1.0e+6", ["-o", "medium.yaml"], "would replace the medium"),
        ("", ["--medium", "none.yaml"], "none.yaml: not readable (No such file or directory)"),
    ],
)
def test_mistakes_in_media_are_one_line(here, capsys, text, options, what):
    (here / "medium.yaml").write_text(text)
    (here / "J.csv").write_text("0,0\n1e-6,1e-12\n")
    place = ESTIMATE.index("--viscosity")
    arguments = [*ESTIMATE[:place], *ESTIMATE[place + 2 :], "--medium", "medium.yaml", *options]
    assert what in complaint(arguments, capsys, here)


def test_options_that_are_missing_are_named(here, capsys):
    for option in ("--hurst", "--rms", "--diameter", "--force", "--viscosity", "--times"):
        place = ESTIMATE.index(option)
        assert option in complaint(ESTIMATE[:place] + ESTIMATE[place + 2 :], capsys, here)
