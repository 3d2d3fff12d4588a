"""`viscorough contact`, and the options for forces and elastic constants of `viscorough indent`, through real files."""

import re

import numpy as np
import pytest

from support.command_line import sphere_heights
from viscorough.cli import main
from viscorough.contact.influence import influence_coefficient
from viscorough.io import netcdf
from viscorough.surfaces import self_affine_disc


@pytest.fixture
def here(tmp_path, monkeypatch):
    """A folder with heights.npy, a rough disc, and um.nc, the same in micrometres."""
    monkeypatch.chdir(tmp_path)
    disc = self_affine_disc(0.7, 25, rms=0.3, diameter=25, seed=2)
    np.save("heights.npy", disc.heights)
    unit = {"long_name": "height", "units": "um"}
    variables = {"heights": netcdf.Variable(("y", "x"), disc.heights, unit)}
    netcdf.write(netcdf.Content(variables, {"title": "disc"}), "um.nc")
    return tmp_path


def contact(*arguments, heights="heights.npy", code=0):
    """The Content that a command line with these arguments writes."""
    assert main(["contact", heights, "--spacing", "1", "-o", "out.nc", *arguments]) == code
    return netcdf.read("out.nc") if code == 0 else None


def values(content):
    return {name: variable.values for name, variable in content.variables.items()}


@pytest.mark.parametrize(("force", "tolerance"), [(30, 1e-3), (300, 1e-3), (300, 1e-7)])
def test_what_is_written_solves_the_contact_problem_by_itself(here, force, tolerance):
    """Force balance, complementarity and deflection from the file alone, with a dense sum over the pressures."""
    np.save("larger.npy", self_affine_disc(0.7, 41, rms=0.3, diameter=41, seed=1).heights)
    content = contact("--force", str(force), "--tolerance", str(tolerance), heights="larger.npy")
    of = values(content)
    (dx,), (dy,) = np.unique(np.diff(of["x"])), np.unique(np.diff(of["y"]))
    row, column = np.nonzero(np.isfinite(of["heights"]))
    pressure, gap, heights = (of[name][row, column].astype(float) for name in ("pressure", "gap", "heights"))
    assert np.isnan(of["pressure"]).sum() == np.isnan(of["heights"]).sum()
    influence = influence_coefficient(np.subtract.outer(row, row) * 1.0, np.subtract.outer(column, column) * 1.0)
    deflection = influence @ pressure * np.sqrt(dx * dy) / (4 * np.pi)
    recomputed = deflection - of["depth"] + heights.max() - heights
    in_contact = of["contact"][row, column] == 1
    assert of["force"] == force
    assert pressure.sum() * dx * dy == pytest.approx(force, rel=1e-6)
    assert (pressure >= 0).all()
    np.testing.assert_array_equal(in_contact, pressure > 0)
    assert np.abs(recomputed[in_contact]).max() <= 1.01 * tolerance * of["depth"]
    assert recomputed.min() >= -1.01 * tolerance * of["depth"]
    np.testing.assert_allclose(gap, recomputed, atol=3e-6 if tolerance > 1e-4 else 1e-12)
    assert of["contact_fraction"] == in_contact.mean()
    assert of["contact_area"] == in_contact.sum() * dx * dy
    assert of["mean_pressure"] == pytest.approx(pressure[in_contact].mean(), rel=1e-6)
    assert of["largest_pressure"] == pytest.approx(pressure.max(), rel=1e-6)
    assert of["patch_area"].size == of["patches"] > 1
    assert of["patch_area"].sum() == pytest.approx(of["contact_area"])
    assert (of["residual"] > 0) == (force == 300), "few elements in contact are solved exactly"
    assert of["residual"] <= tolerance


def test_several_forces_have_a_dimension(here, capsys):
    content = contact("--force", "1,30")
    assert content.variables["pressure"].dimensions == ("level", "y", "x")
    assert content.variables["depth"].dimensions == ("level",)
    np.testing.assert_array_equal(content.variables["force"].values, [1, 30])
    assert capsys.readouterr().out.startswith("out.nc: 2 levels, the last at depth ")
    alone = contact("--force", "30")
    assert alone.variables["pressure"].dimensions == ("y", "x")
    np.testing.assert_allclose(values(content)["gap"][1], values(alone)["gap"], atol=1e-3)
    areas = values(content)["patch_area"]
    assert np.isfinite(areas).sum(axis=1).tolist() == values(content)["patches"].tolist()


def test_closing_line_says_what_was_found(here, capsys):
    contact("--depth", "0.5")
    out = capsys.readouterr().out
    assert out.startswith("out.nc: depth 0.5, F/G ")
    assert "contact fraction 0." in out
    assert out.rstrip().endswith("patches")


def test_closing_lines_state_the_unit_that_is_known(here, capsys):
    contact("--depth", "0.5", "--unit", "um")
    out = capsys.readouterr().out
    assert out.startswith("out.nc: depth 0.5 um, F/G ")
    assert " um2, contact fraction " in out
    sphere, curve = ["heights.npy", "--spacing", "1", "--unit", "um"], "curve.nc"
    for command in (
        ["indent", *sphere, "--depths", "0.5", "-o", curve],
        ["kinetics", curve, "--force", "1", "--viscosity", "1", "-o", "motion.nc"],
        ["march", *sphere, "--method", "events", "--until-fraction", "0.1", "-o", "events.nc"],
    ):
        assert main(command) == 0
        assert re.search(r" depth [\d.]+ um ", capsys.readouterr().out)


def test_a_depth_of_the_curve_has_its_force(here):
    of = values(contact("--depth", "0.2,0.9"))
    assert main(["indent", "heights.npy", "--spacing", "1", "--depths", "0.2,0.9", "-o", "curve.nc"]) == 0
    curve = values(netcdf.read("curve.nc"))
    for name in ("depth", "force", "stiffness", "contact_fraction"):
        np.testing.assert_allclose(of[name], curve[name], rtol=1e-3)


def test_forces_with_a_modulus_are_newtons_where_the_unit_is_known(here):
    """30 µm² · 2 GPa = 0.06 N."""
    for given in (["--shear-modulus", "2 GPa"], ["--shear-modulus", "2e9"], ["--young", "6 GPa"]):
        for force in ("0.06", "60 mN", "6e4 uN"):
            assert values(contact("--force", force, *given, heights="um.nc"))["force"] == pytest.approx(30, rel=1e-12)
    of = contact("--depth", "500 nm", "--shear-modulus", "1", heights="um.nc")
    assert of.variables["depth"].values == 0.5
    assert of.variables["depth"].attributes["units"] == "um"
    assert of.variables["force"].attributes["units"] == "um2"
    assert of.variables["pressure"].attributes["units"] == "1"


def test_moduli_are_in_consistent_units_where_no_unit_is_known(here):
    of = contact("--force", "60", "--young", "1.5", "--poisson", "0")
    assert values(of)["force"] == pytest.approx(60 / (1.5 / 4), rel=1e-12)
    assert (of.attributes["young_modulus"], of.attributes["poisson_ratio"]) == (1.5, 0)


def test_curves_stand_at_forces_and_end_at_one(here):
    command = ["indent", "um.nc", "--spacing", "1", "-o", "out.nc", "--shear-modulus", "1 MPa"]
    assert main([*command, "--forces", "1 uN,30 uN"]) == 0
    np.testing.assert_allclose(netcdf.read("out.nc").variables["force"].values, [1, 30], rtol=1e-12)
    assert main([*command, "--until-force", "30 uN"]) == 0
    force = netcdf.read("out.nc").variables["force"].values
    assert force[-1] >= 30 > force[-2]


def test_kinetics_need_an_incompressible_half_space(here, capsys):
    command = ["indent", "heights.npy", "--spacing", "1", "-o", "curve.nc", "--young", "1", "--forces", "1,30"]
    kinetics = ["kinetics", "curve.nc", "--force", "1", "--viscosity", "1", "-o", "kin.nc"]
    assert main([*command, "--poisson", "0.3"]) == 0
    assert main(kinetics) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert "curve.nc: the curve is that of a half-space with Poisson ratio 0.3" in error
    assert not (here / "kin.nc").exists()
    assert main([*command, "--poisson", "0.5"]) == 0
    assert main(kinetics) == 0


CONTACT, INDENT = "contact heights.npy --spacing 1 -o out.nc", "indent heights.npy --spacing 1 -o out.nc"
CONTACT_UM, INDENT_UM = CONTACT.replace("heights.npy", "um.nc"), INDENT.replace("heights.npy", "um.nc")
EXCLUDE = "exclude each other; one of them is allowed"
POSITIVE = "is not a number above 0 and finite, plain or with a unit such as"
MISTAKES = [
    (CONTACT, "one of --force and --depth is needed"),
    (f"{CONTACT} --force 1 --depth 1", "one of --force and --depth is needed"),
    (f"{CONTACT} --force 0", POSITIVE),
    (f"{CONTACT} --force -1", POSITIVE),
    (f"{CONTACT} --force nan", POSITIVE),
    (f"{CONTACT} --force inf", POSITIVE),
    (f"{CONTACT} --force 1e400", POSITIVE),
    (f"{CONTACT} --force much", POSITIVE),
    (f"{CONTACT} --force 1,", POSITIVE),
    (f"{CONTACT} --force 2,1", "each number must be larger than the one before"),
    (f"{CONTACT} --force 1,1", "each number must be larger than the one before"),
    (f"{CONTACT} --force 1|mN", "a force needs --shear-modulus or --young"),
    (f"{CONTACT_UM} --force 1|mN", "a force needs --shear-modulus or --young"),
    (f"{CONTACT_UM} --force 1|Pa --young 1", POSITIVE),
    (f"{CONTACT_UM} --force 1|mN,2 --young 1", "all or none of them may have one"),
    (f"{CONTACT_UM} --force 2|mN,1|uN --young 1", "each number must be larger than the one before"),
    (f"{CONTACT} --force 1|mN --shear-modulus 1", "the unit of length is not known"),
    (f"{CONTACT} --force 1 --shear-modulus 1|MPa", "the unit of length is not known"),
    (f"{CONTACT} --force 1 --young 1|MPa", "the unit of length is not known"),
    (f"{CONTACT} --depth 1|um", "the unit of length is not known"),
    (f"{CONTACT_UM} --depth 1|N", POSITIVE),
    (f"{CONTACT} --depth 0", POSITIVE),
    (f"{CONTACT} --depth 1,0.5", "each number must be larger than the one before"),
    (f"{CONTACT} --depth 1e300", "up to which depths are allowed"),
    (f"{CONTACT} --force 1e300", "up to which depths are allowed"),
    (f"{CONTACT} --force 1 --shear-modulus 0", POSITIVE),
    (f"{CONTACT} --force 1 --shear-modulus -2", POSITIVE),
    (f"{CONTACT} --force 1 --shear-modulus 1 --young 1", EXCLUDE),
    (f"{CONTACT} --force 1 --poisson 0.3", "--poisson is for use with --young"),
    (f"{CONTACT} --force 1 --shear-modulus 1 --poisson 0.3", "--poisson is for use with --young"),
    (f"{CONTACT} --force 1 --young 1 --poisson 0.6", "is not a number above -1 and up to 0.5"),
    (f"{CONTACT} --force 1 --young 1 --poisson -1", "is not a number above -1 and up to 0.5"),
    (f"{CONTACT} --force 1 --young 1 --poisson nan", "is not a number above -1 and up to 0.5"),
    (f"{CONTACT} --force 1 --young stiff", POSITIVE),
    (f"{CONTACT} --force 1e-300 --young 1e300", "one row of finite numbers above 0"),
    (f"{CONTACT} --force 1e300 --young 1e-300", "one row of finite numbers above 0"),
    (f"{CONTACT} --force 1 --tolerance 1", "is not a number above 0 and up to 0.1"),
    *[
        (f"{CONTACT} --force 1 --threads {n}", f"'--threads': {n} is not in the range 1<=x<=1024")
        for n in (0, -1, 1025)
    ],
    *[(f"{CONTACT} --force 1 --threads {n}", f"'{n}' is not a valid integer") for n in ("two", "1.5")],
    *[(f"{INDENT} --threads {n}", f"'--threads': {n} is not in the range 1<=x<=1024") for n in (0, -1, 1025)],
    *[(f"{INDENT} --threads {n}", f"'{n}' is not a valid integer") for n in ("two", "1.5")],
    (f"{CONTACT} --force 1 --tolerance 1e-13", "tolerance must be between 1e-12 and 0.1"),
    (f"{CONTACT.replace('out.nc', 'out.csv')} --force 1", "maps are no table"),
    (f"{CONTACT.replace('heights.npy', 'none.npy')} --force 1", "none.npy"),
    (f"{CONTACT.replace('out.nc', 'heights.npy')} --force 1", "would replace the heights"),
    (f"{INDENT} --forces 1,1", "each number must be larger than the one before"),
    (f"{INDENT} --forces 1 --depths 1", EXCLUDE),
    (f"{INDENT} --forces 1 --until-fraction 0.5", EXCLUDE),
    (f"{INDENT} --forces 1 --until-force 1", EXCLUDE),
    (f"{INDENT} --depths 1 --until-force 1", EXCLUDE),
    (f"{INDENT} --until-force 0", POSITIVE),
    (f"{INDENT} --until-force 1|N", "a force needs --shear-modulus or --young"),
    (f"{INDENT_UM} --until-force 1|m --young 1", POSITIVE),
    (f"{INDENT} --depths 1|um,2", "all or none of them may have one"),
    (f"{INDENT} --young 1 --shear-modulus 1", EXCLUDE),
]


@pytest.mark.parametrize(("line", "message"), MISTAKES, ids=[line for line, _ in MISTAKES])
def test_mistakes_are_one_line(here, capsys, line, message):
    arguments = [argument.replace("|", " ") for argument in line.split()]
    before = {path: path.read_bytes() for path in here.iterdir()}
    assert main(arguments) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.startswith(f"viscorough {arguments[0]}: ")
    assert captured.err.count("\n") == 1
    assert message in captured.err
    assert {path: path.read_bytes() for path in here.iterdir()} == before


def test_a_file_of_fields_can_be_indented_again(here):
    contact("--force", "1")
    assert main(["indent", "out.nc", "--spacing", "1", "--depths", "0.5", "-o", "curve.nc"]) == 0


def test_numbers_beyond_single_precision_are_kept(here):
    """Heights of 1e100: the same contact as that of heights of 1, scaled."""
    np.save("huge.npy", 1e100 * np.load("heights.npy"))
    one, huge = values(contact("--depth", "0.5")), values(contact("--depth", "0.5e100", heights="huge.npy"))
    for name in ("pressure", "gap", "force"):
        np.testing.assert_allclose(1e-100 * huge[name], one[name], rtol=1e-5, atol=1e-6)


def test_a_sphere_has_one_patch(here, capsys):
    np.save("sphere.npy", sphere_heights(33))
    assert values(contact("--depth", "1", heights="sphere.npy"))["patches"] == 1
    assert capsys.readouterr().out.rstrip().endswith(", 1 patch")


def test_the_whole_contact_is_a_straight_line(here):
    """Far beyond full contact the force is still met at once."""
    of = values(contact("--force", "1e12"))
    assert of["contact_fraction"] == 1
    assert of["force"] == pytest.approx(of["stiffness"] * of["depth"], rel=1e-3)
