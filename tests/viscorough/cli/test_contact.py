"""`viscorough contact`, and the options for forces and elastic constants of `viscorough indent`, through real files."""

import re

import numpy as np
import pytest

import viscorough
from support.command_line import run, values
from support.tables import read_table
from viscorough import Indenter, contact_at, self_affine_disc
from viscorough.io import netcdf


@pytest.fixture
def here(here):
    """Make a folder with heights.npy, a rough disc, and um.nc, the same disc in micrometres."""
    heights = self_affine_disc(0.7, 25, rms=0.3, diameter=25, seed=2).heights
    np.save("heights.npy", heights)
    viscorough.save(Indenter(heights, 1.0, length_unit="um"), "um.nc")
    return here


def contact(options, heights="heights.npy"):
    """Return the values in the file that a command line with these options writes."""
    unit = "" if heights.endswith(".nc") or "--unit" in options else "--unit 1"
    assert run(f"contact {heights} --spacing 1 {unit} -o out.nc {options}") == 0
    return values("out.nc")


SCALARS = ("depth", "force", "stiffness", "contact_fraction", "contact_area", "corrected_contact_area")
SCALARS += ("mean_pressure", "largest_pressure", "residual")


@pytest.mark.parametrize("tolerance", [1e-3, 1e-7])
def test_file_has_the_results_of_python(here, tolerance):
    """tests/viscorough/contact/test_one_contact.py tests that Python solves the contact problem."""
    written, heights = contact(f"--force 30 --tolerance {tolerance}"), np.load("heights.npy")
    expected = contact_at(Indenter(heights, 1.0), force=30, tolerance=tolerance)
    viscorough.save(expected, "saved.nc")
    saved = values("saved.nc")
    np.testing.assert_array_equal(written["heights"], heights)
    assert set(written) - set(saved) == {"heights"}
    for of in (written, saved):
        assert {name: of[name].item() for name in SCALARS} == {name: getattr(expected, name) for name in SCALARS}
        np.testing.assert_array_equal(of["contact"], expected.contact)
        np.testing.assert_array_equal(of["patch_area"], expected.patches()[1])
        np.testing.assert_array_equal([of["x"], of["y"]], [np.arange(25) - 12] * 2)
        for name in ("pressure", "gap"):
            np.testing.assert_allclose(of[name], getattr(expected, name), rtol=1e-6, atol=1e-6)


def test_several_forces_add_a_dimension(here, capsys):
    several = contact("--force 1,30")
    assert several["pressure"].shape == (2, 25, 25)
    np.testing.assert_array_equal(several["force"], [1, 30])
    assert capsys.readouterr().out.startswith("out.nc: 2 levels, the last at depth ")
    assert {netcdf.read("out.nc").variables[name].dimensions for name in ("depth", "force")} == {("level",)}
    np.testing.assert_allclose(several["gap"][1], contact("--force 30")["gap"], atol=1e-3)
    assert np.isfinite(several["patch_area"]).sum(axis=1).tolist() == several["patches"].tolist()


def test_closing_line_states_results_in_the_unit_of_the_file(here, capsys):
    written = contact("--depth 0.5 --unit um")
    line = capsys.readouterr().out
    assert re.match(r"out.nc: depth 0.5 um, F/G \S+ um2, contact fraction 0.*patches$", line)
    areas = [written[name].item() for name in ("contact_area", "corrected_contact_area")]
    assert "contact area {:.4g} um2 (corrected {:.4g} um2), ".format(*areas) in line
    written = contact("--depth 0.5 --shear-modulus '2 MPa'", heights="um.nc")
    line = capsys.readouterr().out
    assert f"F {2e-6 * written['force']:.6g} N, largest p {2 * written['largest_pressure']:.4g} MPa, " in line
    assert f"k {2 * written['stiffness']:.4g} N/m, " in line
    contact("--depth 0.001")
    assert re.match(r"out.nc: depth 0.001, F/G \S+, contact fraction 0.*, 1 patch$", capsys.readouterr().out)
    assert run("indent heights.npy --spacing 1 --unit um --depths 0.5 -o curve.nc") == 0
    assert " depth 0.5 um " in capsys.readouterr().out


def test_forces_with_a_modulus_are_newtons_if_the_file_has_a_unit(here):
    """30 µm² · 2 GPa = 0.06 N."""
    shear = "--shear-modulus '2 GPa' --force 0.06", "--shear-modulus 2e9 --force '60 mN'"
    for given in (*shear, "--young '6 GPa' --force '6e4 uN'", "--young 4.5e9 --poisson 0.5 --force 0.045"):
        assert contact(given, heights="um.nc")["force"] == pytest.approx(30, rel=1e-12)
    assert contact("--depth '500 nm' --shear-modulus 1", heights="um.nc")["depth"] == 0.5
    units = {name: netcdf.read("out.nc").variables[name].attributes["units"] for name in ("depth", "force", "pressure")}
    assert units == {"depth": "um", "force": "um2", "pressure": "1"}


def test_moduli_are_in_consistent_units_if_the_file_has_no_unit(here):
    force = contact("--force 60 --young 1.5 --poisson 0.25")["force"]
    assert force == pytest.approx(60 / (1.5 / (4 * (1 - 0.25**2))), rel=1e-12)
    in_python = contact_at(Indenter(np.load("heights.npy"), 1.0), force=60, young_modulus=1.5, poisson=0.25)
    assert in_python.force == force
    assert netcdf.read("out.nc").attributes.items() >= {"young_modulus": 1.5, "poisson_ratio": 0.25}.items()


def test_files_have_force_stiffness_and_pressure_in_si_units(here):
    """G = 2 MPa and lengths in um: G um2 is 2e-6 N and G um is 2 N/m."""
    written = contact("--depth 0.5 --shear-modulus '2 MPa'", heights="um.nc")
    variables = netcdf.read("out.nc").variables
    names = {"normal_force": "N", "normal_stiffness": "N m-1", "normal_pressure": "Pa", "largest_normal_pressure": "Pa"}
    assert {name: variables[name].attributes["units"] for name in names} == names
    factors = {"force": 2e-6, "stiffness": 2.0, "pressure": 2e6}
    for name, factor in factors.items():
        np.testing.assert_allclose(written[f"normal_{name}"], factor * written[name], rtol=1e-6)
    assert run("indent um.nc --depths 0.5 --shear-modulus '2 MPa' -o curve.csv") == 0
    table, units = read_table("curve.csv")
    assert table["normal_stiffness"].tolist() == pytest.approx((2 * table["stiffness"]).tolist())
    assert (units["normal_force"], units["normal_stiffness"]) == ("N", "N m-1")


def test_ball_follows_hertz_in_si_units(here):
    """Check depth, corrected area and largest pressure of a ball of radius 0.1 mm on E = 2 MPa to 0.5 %.

    F = 4/3 E* a^3/R, u = a^2/R, p = 2 E* a/(pi R).
    """
    radius = 40.5  # of the contact, in elements, which are 0.25 um wide
    points, ball, reduced_modulus = 2 * int(1.15 * radius) + 1, 100.0, 2 / 0.75  # um, MPa
    position, a = 0.25 * (np.arange(points) - points // 2), 0.25 * radius
    np.save("ball.npy", -np.add.outer(position**2, position**2) / (2 * ball))
    force = 4 / 3 * reduced_modulus * a**3 / ball  # uN
    assert run(f"contact ball.npy --spacing 0.25 --unit um --young '2 MPa' --force '{force!r} uN' -o out.csv") == 0
    table, units = read_table("out.csv")
    expected = {"depth": a**2 / ball, "corrected_contact_area": np.pi * a**2}
    expected |= {"largest_normal_pressure": 2 * reduced_modulus * a / (np.pi * ball), "normal_force": 1e-6 * force}
    assert table.loc[0, [*expected]].tolist() == pytest.approx([*expected.values()], rel=5e-3)
    assert [units[name] for name in expected] == ["um", "um2", "MPa", "N"]


def test_curves_have_levels_at_forces_and_end_at_a_force(here):
    command = "indent um.nc --spacing 1 -o out.nc --shear-modulus '1 MPa'"
    assert run(f"{command} --forces '1 uN,30 uN'") == 0
    np.testing.assert_allclose(values("out.nc")["force"], [1, 30], rtol=1e-12)
    assert run(f"{command} --until-force '30 uN'") == 0
    force = values("out.nc")["force"]
    assert force[-1] >= 30 > force[-2]


def test_kinetics_need_an_incompressible_half_space(complaint):
    command = "indent heights.npy --spacing 1 --unit 1 -o curve.nc --young 1 --forces 1,30"
    kinetics = "kinetics curve.nc --force 1 --viscosity 1 -o kin.nc"
    assert run(f"{command} --poisson 0.3") == 0
    assert "curve.nc: the curve is that of a half-space with Poisson ratio 0.3" in complaint(kinetics)
    assert run(f"{command} --poisson 0.5") == 0
    assert run(kinetics) == 0


def test_heights_beyond_single_precision_are_computed(here):
    """Heights of 1e100 give the same contact as heights of 1, scaled."""
    np.save("huge.npy", 1e100 * np.load("heights.npy"))
    usual, huge = contact("--depth 0.5"), contact("--depth 0.5e100", heights="huge.npy")
    for name in ("pressure", "gap", "force"):
        np.testing.assert_allclose(1e-100 * huge[name], usual[name], rtol=1e-5, atol=1e-6)
