"""`viscorough contact`, and the options for forces and elastic constants of `viscorough indent`, through real files."""

import numpy as np
import pytest

import viscorough
from support.command_line import run, save_in, values
from support.tables import read_table
from viscorough import Indenter, contact_at, self_affine_disc
from viscorough.io.datasets import read_dataset


@pytest.fixture
def here(here):
    """Make a folder with heights.npy, a rough disc, and um.nc, the same disc in micrometres."""
    heights = self_affine_disc(0.7, 25, rms=0.3, diameter=25, seed=2).heights
    np.save("heights.npy", heights)
    save_in("um", Indenter(1e-6 * heights, 1e-6, length_unit="m"), "um.nc")
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
    assert {read_dataset("out.nc").variables[name].dims for name in ("depth", "force")} == {("level",)}
    np.testing.assert_allclose(several["gap"][1], contact("--force 30")["gap"], atol=1e-3)
    assert np.isfinite(several["patch_area"]).sum(axis=1).tolist() == several["patches"].tolist()


def test_forces_with_a_modulus_are_newtons_if_the_file_has_a_unit(here):
    """30 µm² · 2 GPa = 0.06 N."""
    shear = "--shear-modulus '2 GPa' --force 0.06", "--shear-modulus 2e9 --force '60 mN'"
    for given in (*shear, "--young '6 GPa' --force '6e4 uN'", "--young 4.5e9 --poisson 0.5 --force 0.045"):
        assert contact(given, heights="um.nc")["force"] == pytest.approx(30, rel=1e-12)
    assert contact("--depth '500 nm' --shear-modulus 1", heights="um.nc")["depth"] == 0.5
    units = {name: read_dataset("out.nc").variables[name].attrs["units"] for name in ("depth", "force", "pressure")}
    assert units == {"depth": "um", "force": "um2", "pressure": "1"}


def test_files_have_force_stiffness_and_pressure_in_si_units(here):
    """G = 2 MPa and lengths in um: G um2 is 2e-6 N and G um is 2 N/m."""
    written = contact("--depth 0.5 --shear-modulus '2 MPa'", heights="um.nc")
    variables = read_dataset("out.nc").variables
    names = {"normal_force": "N", "normal_stiffness": "N m-1", "normal_pressure": "Pa", "largest_normal_pressure": "Pa"}
    assert {name: variables[name].attrs["units"] for name in names} == names
    factors = {"force": 2e-6, "stiffness": 2.0, "pressure": 2e6}
    for name, factor in factors.items():
        np.testing.assert_allclose(written[f"normal_{name}"], factor * written[name], rtol=1e-6)
    assert run("indent um.nc --depths 0.5 --shear-modulus '2 MPa' -o curve.csv") == 0
    table, units = read_table("curve.csv")
    assert table["normal_stiffness"].tolist() == pytest.approx((2 * table["stiffness"]).tolist())
    assert (units["normal_force"], units["normal_stiffness"]) == ("N", "N m-1")


def test_kinetics_need_an_incompressible_half_space(complaint):
    command = "indent heights.npy --spacing 1 --unit 1 -o curve.nc --young 1 --forces 1,30"
    kinetics = "kinetics curve.nc --force 1 --viscosity 1 -o kin.nc"
    assert run(f"{command} --poisson 0.3") == 0
    assert "curve.nc: the curve is that of a half-space with Poisson ratio 0.3" in complaint(kinetics)
    assert run(f"{command} --poisson 0.5") == 0
    assert run(kinetics) == 0
