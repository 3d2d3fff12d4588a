"""`viscorough estimate`: the table on standard output, files, units, and refusals."""

import numpy as np
import pytest

from support.command_line import run
from support.tables import read_table
from viscorough import estimate
from viscorough.io.datasets import read_dataset

OPTIONS = {"hurst": "0.8", "rms": "1e-6", "diameter": "0.01", "force": "10", "viscosity": "1e6", "times": "1e-5,1e-4"}
WANTED = estimate(0.8, 1e-6, 0.01, 10.0, 1e6, [1e-5, 1e-4])
NAMES = ("time", "x", "depth", "velocity")

pytestmark = pytest.mark.usefixtures("here")


def command(output="", **changes):
    """Return a command line with some of the options changed; None: left out."""
    options = {name: value for name, value in (OPTIONS | changes).items() if value is not None}
    return " ".join(["estimate", *(f"--{name} '{value}'" for name, value in options.items()), output])


def test_table_on_standard_output(here, capsys):
    assert run(command()) == 0
    captured = capsys.readouterr()
    assert captured.err == ""
    law, units, head, *rows, errors = captured.out.splitlines()
    low, high = WANTED.law.x_low, WANTED.law.x_high
    assert law.startswith(f"vt/h = X + g(X) for H = 0.8, X from {low:.3g} to {high:.3g}, discs of 257 ")
    assert units == "time in the unit of --times, depth in the unit of --rms, velocity in that unit per unit of time"
    assert errors.startswith("mean of many surfaces: depth ± ")
    assert head.split() == ["time", "X", "depth", "velocity"]
    numbers = np.array([[float(cell) for cell in row.split()] for row in rows])
    np.testing.assert_allclose(numbers.T, [getattr(WANTED, name) for name in NAMES], rtol=1e-3)
    assert not list(here.iterdir())


def test_units_of_results_are_stated(capsys):
    lengths = {"rms": "1 um", "diameter": "1 cm"}
    assert run(command(**lengths)) == 0
    _, units, _, row, *_ = capsys.readouterr().out.splitlines()
    assert units == "time [s], depth [m], velocity [m/s]"
    assert float(row.split()[2]) == pytest.approx(WANTED.depth[0], rel=1e-3)


def test_file_has_all_numbers_of_the_table(capsys):
    for name in ("estimate.nc", "estimate.csv"):
        assert run(command(f"-o {name}")) == 0
        assert capsys.readouterr().out == f"{name}: 2 times, 2 in the range of the law\n"
    content, (table, _) = read_dataset("estimate.nc"), read_table("estimate.csv")
    for variable in NAMES:
        np.testing.assert_array_equal(content.variables[variable].values, getattr(WANTED, variable))
        np.testing.assert_array_equal(table[variable], getattr(WANTED, variable))
    assert content.attrs["hurst"] == 0.8
    for name in ("depth_error", "velocity_error"):
        assert content.attrs[name] == getattr(WANTED.law, name)
    assert content.variables["depth"].attrs["units"] == "1"
