"""First tasks of a new user, on the command line, compared with numbers converted to SI by hand.

The scan of a ball of radius 0.1 mm is in nanometres, with points 500 nm apart. The tasks lead from the scan to the
force-depth curve, to the contact under a force, to the penetration of rubber over time, and to a figure. The expected
numbers follow from Hertz; the grid meets them to 2 %.
"""

import numpy as np
import pytest

import viscorough
from support.command_line import run
from support.contract import refused
from support.tables import read_table
from viscorough.basics.errors import AccuracyWarning
from viscorough.io.datasets import read_dataset

RADIUS, SPACING, POINTS = 1e-4, 5e-7, 41  # m
YOUNG, FORCE = 2e6, 1e-5  # Pa, N
MODULUS = YOUNG / (1 - 0.5**2) / 4  # E* = 4 G
DEPTH = (FORCE * 3 / 4 / (4 * MODULUS) / RADIUS**0.5) ** (2 / 3)  # F = 4/3 E* R^(1/2) u^(3/2)
RADIUS_OF_CONTACT = (RADIUS * DEPTH) ** 0.5
LARGEST_PRESSURE = 1.5 * FORCE / (np.pi * RADIUS_OF_CONTACT**2)
RUBBER = viscorough.StandardLinearSolid(instantaneous_modulus=3e6, relaxed_modulus=1e6, relaxation_time=0.2)
RUBBER_FILE = """kind: standard_linear_solid
instantaneous_modulus: 3 MPa
relaxed_modulus: 1 MPa
relaxation_time: 200 ms
"""


def depth_in_rubber(time):
    """Return the depth by Lee and Radok, u^(3/2) = 3 F J/(16 R^(1/2)), in m."""
    return (3 * FORCE * RUBBER.creep_compliance(time) / (16 * RADIUS**0.5)) ** (2 / 3)


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    position = SPACING * (np.arange(POINTS) - (POINTS - 1) / 2)
    np.savetxt("scan.txt", -1e9 * np.add.outer(position**2, position**2) / (2 * RADIUS))
    (tmp_path / "rubber.yaml").write_text(RUBBER_FILE)
    return tmp_path


def test_tasks_give_the_numbers_of_hertz(here, capsys):
    scan = "scan.txt --spacing 500 --unit nm"
    for output in ("curve.csv", "curve.nc"):
        assert run(f"indent {scan} --until-force '50 uN' --young '2 MPa' -o {output}") == 0
    assert ", F " in capsys.readouterr().out
    curve, units = read_table("curve.csv")
    assert units["normal_force"] == "N"
    assert curve["normal_force"].iloc[-1] == pytest.approx(5e-5, rel=0.3)
    assert 1e-9 * np.interp(FORCE, curve["normal_force"], curve["depth"]) == pytest.approx(DEPTH, rel=0.02)

    assert run(f"contact {scan} --force '10 uN' --young '2 MPa' -o fields.nc") == 0
    assert f"F {FORCE:g} N, largest p " in capsys.readouterr().out
    fields = read_dataset("fields.nc").variables
    assert float(fields["normal_force"].values) == pytest.approx(1e-5, rel=1e-12)
    assert fields["normal_force"].attrs["units"] == "N"
    assert fields["largest_normal_pressure"].attrs["units"] == "Pa"
    assert float(fields["largest_normal_pressure"].values) == pytest.approx(LARGEST_PRESSURE, rel=0.03)
    assert np.nansum(fields["normal_pressure"].values) * SPACING**2 == pytest.approx(FORCE, rel=1e-5)

    assert run("kinetics curve.nc --force '10 uN' --medium rubber.yaml -o motion.csv") == 0
    motion, units = read_table("motion.csv")
    assert (units["time"], units["depth"]) == ("s", "nm")
    times, depths = motion["time"].to_numpy(), motion["depth"].to_numpy()
    np.testing.assert_allclose(depths[1:] * 1e-9, depth_in_rubber(times[1:]), rtol=0.02)

    for made in ("scan.txt --spacing 500 --unit nm", "curve.nc", "fields.nc"):
        assert run(f"plot {made} -o figure.png") == 0


def test_implausible_results_give_a_warning(here):
    surface = viscorough.read_heights("scan.txt", 500, unit="nm")
    complete = "contact is complete, the contact fraction is 1 at the depth u, 10 um"
    larger = r"the depth u, 300 mm, is larger than the map is wide, 2"
    with pytest.warns(AccuracyWarning, match="contact is complete"), pytest.warns(AccuracyWarning, match=larger):
        viscorough.contact_at(surface, depth=0.3)
    with pytest.warns(AccuracyWarning, match=complete):
        viscorough.contact_at(surface, depth=1e-5)
    with refused(r"the load has the depth of F/G = 1 in an elastic half-space, beyond the curve's last level; allowed"):
        viscorough.kinetics(viscorough.indent(surface, until_fraction=0.3), 1.0, 1.0, [1.0])
