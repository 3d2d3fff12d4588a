"""`viscorough creep`: a medium from a record of depth, in the units of its heading, and what is refused."""

import re

import numpy as np
import pytest
import yaml

import viscorough
from support.command_line import run
from support.curves import curve_of_body
from support.tables import read_table

MEDIUM = viscorough.StandardLinearSolid(3e6, 1e6, 0.2)
TIMES = np.geomspace(0.01, 10, 30)
FORCE = 2e-5  # N, brings the creep to 20 um2


@pytest.fixture
def here(here):
    """A curve in micrometres, and a record in ms and nm of a step of force on a rubber."""
    curve = curve_of_body(viscorough.reference.sphere(100.0), np.geomspace(1e-6, 3, 200))
    object.__setattr__(curve, "length_unit", "um")
    viscorough.save(curve, "curve.nc")
    motion = viscorough.kinetics(curve, FORCE, MEDIUM, TIMES)
    np.savetxt("record.csv", np.c_[1e3 * TIMES, 1e3 * motion.depth], "%.17g", ",", header="t_ms,u [nm]", comments="")
    return here


def compliances(line):
    """First and last J in the closing line."""
    return [float(number) for number in re.search(r"J (\S+) to (\S+) 1/Pa", line).groups()]


@pytest.mark.parametrize("fit", ["table", "prony", "springpot"])
def test_media_are_read_back(here, capsys, fit):
    """The closing line has J of the medium, and a warning follows if this misses the record."""
    assert run(f"creep curve.nc record.csv --force '20 uN' --fit {fit} -o rubber.yaml") == 0
    lines = capsys.readouterr()
    medium = viscorough.read_medium("rubber.yaml", "um")
    assert compliances(lines.out) == pytest.approx(medium.creep_compliance(TIMES[[0, -1]]), rel=1e-3)
    assert ("misses the record by" in lines.err) == (fit == "springpot")
    error = 0.2 if fit == "springpot" else 0.003
    np.testing.assert_allclose(medium.creep_compliance(TIMES[1:]), MEDIUM.creep_compliance(TIMES[1:]), rtol=error)
    assert (here / "rubber.csv").exists() == (fit == "table")
    assert run("kinetics curve.nc --force 2e-5 --medium rubber.yaml --times 0.5,5 -o motion.nc") == 0


def test_tables_hold_the_intervals(here):
    assert run("creep curve.nc record.csv --force 20e-6 --scatter '1 nm' -o rubber.yaml") == 0
    assert yaml.safe_load((here / "rubber.yaml").read_text()) == {"kind": "creep_table", "file": "rubber.csv"}
    table, units = read_table("rubber.csv")
    assert '# record: "record.csv"' in (here / "rubber.csv").read_text()
    assert units == {"time": "s", **dict.fromkeys(("compliance", "low", "high"), "1/Pa")}
    np.testing.assert_allclose(table["compliance"], MEDIUM.creep_compliance(table["time"]), rtol=1e-9)
    assert (table["low"] <= table["compliance"]).all()


def test_force_histories(here):
    """A force that steps at time 0 is the constant one."""
    (here / "force.csv").write_text("t,F [uN]\n0,20\n10,20\n")
    for name, force in (("a", "--force 20e-6"), ("b", "--force-history force.csv")):
        assert run(f"creep curve.nc record.csv {force} -o {name}.yaml") == 0
    a, b = (read_table(f"{name}.csv")[0]["compliance"] for name in "ab")
    np.testing.assert_allclose(a, b, rtol=1e-9)


def test_unknown_and_stated_scatter(here, capsys):
    """Exact rows do not determine the scatter: the intervals are unknown, or follow from the scatter that is stated."""
    short = np.loadtxt("record.csv", delimiter=",", skiprows=1)[[0, 4, 8, 12, 16, 20, 25, 29]]
    np.savetxt("short.csv", short, "%.17g", ",", header="t_ms,u [nm]", comments="")
    widths = []
    for option, text in (("", "scatter of depth unknown"), ("--scatter '2 nm'", "scatter of depth 0.002 um")):
        assert run(f"creep curve.nc short.csv --force 20e-6 {option} -o rubber.yaml") == 0
        assert text in capsys.readouterr().out
        table, _ = read_table("rubber.csv")
        widths.append(table["high"] - table["low"])
        assert viscorough.read_medium("rubber.yaml", "um").creep_compliance(1.0) > 0
    assert np.isnan(widths[0]).all()
    assert (widths[1] > 0).all()
