"""viscorough kinetics with media, force histories, times and units; and mistakes in them, each answered in one line.

Units in headings of histories are tested in tests/viscorough/io/test_histories.py.
"""

import dataclasses

import numpy as np
import pytest
import yaml

import viscorough
from support.command_line import run, save_in, sphere_heights, values
from viscorough import Indenter, Load, indent, kinetics
from viscorough.io.datasets import read_dataset
from viscorough.media.kinds import KelvinVoigt, Maxwell, Newtonian, Prony, Springpot, StandardLinearSolid

MEDIA = {
    "newtonian": ("{kind: newtonian, viscosity: 30}", Newtonian(30.0)),
    "maxwell": ("kind: maxwell\nshear_modulus: 2\nviscosity: 5e0\n", Maxwell(2.0, 5.0)),
    "kelvin_voigt": ("{kind: kelvin_voigt, shear_modulus: 2.0, viscosity: 5}", KelvinVoigt(2.0, 5.0)),
    "standard_linear_solid": (
        "kind: standard_linear_solid\ninstantaneous_modulus: 4\nrelaxed_modulus: 1.5\nrelaxation_time: 0.3\n",
        StandardLinearSolid(4.0, 1.5, 0.3),
    ),
    "prony": (
        "kind: prony\nrelaxed_modulus: 0.5\nmoduli: [10, 1, 3]\nrelaxation_times: [1e-2, 1, 50]\n",
        Prony(0.5, [10.0, 1.0, 3.0], [0.01, 1.0, 50.0]),
    ),
    "springpot": ("{kind: springpot, modulus: 2, exponent: 0.4}", Springpot(2.0, 0.4)),
}
HISTORY = Load([0, 1, 1, 9], force=[0, 0.2, 0.3, 0.3])
KINETICS = "kinetics curve.nc -o kin.nc"


@pytest.fixture(scope="module")
def curve():
    return indent(Indenter(sphere_heights(17), 1.0), until_fraction=0.7)


@pytest.fixture
def here(curve, here):
    """Make a folder with a curve without a unit, the same in micrometres, and media and force histories."""
    viscorough.save(curve, "curve.nc")
    lengths = {"depth": 1e-6 * curve.depth, "force": 1e-12 * curve.force, "stiffness": 1e-6 * curve.stiffness}
    save_in("um", dataclasses.replace(curve, **lengths, length_unit="m"), "um.nc")
    (here / "force.csv").write_text("time,force\n0,0\n1,0.2\n1,0.3\n9,0.3\n")
    (here / "medium.yaml").write_text(MEDIA["maxwell"][0])
    return here


@pytest.mark.parametrize(
    ("kind", "load", "force"),
    [
        ("maxwell", "--force 0.3", None),
        ("maxwell", "--force 0.3 --times 0.5,2,7", 0.3),
        ("maxwell", "--force-history force.csv", [0, 0.2, 0.3, 0.3]),
        *[(kind, "--force-history force.csv --times 0.5,2,7", [0.1, 0.3, 0.3]) for kind in MEDIA],
    ],
)
def test_file_has_the_results_of_python(here, curve, kind, load, force):
    text, medium = MEDIA[kind]
    (here / "medium.yaml").write_text(text)
    assert run(f"{KINETICS} {load} --medium medium.yaml") == 0
    history, times = HISTORY if "history" in load else 0.3, [0.5, 2, 7] if "times" in load else None
    motion, written = kinetics(curve, history, medium, times), values("kin.nc")
    np.testing.assert_array_equal(written["time"], motion.time)
    np.testing.assert_array_equal(written["depth"], motion.depth)
    np.testing.assert_array_equal(written["velocity"], np.where(np.isinf(motion.velocity), np.nan, motion.velocity))
    if force is not None:
        np.testing.assert_allclose(written["force"], force, rtol=1e-15)


@pytest.mark.parametrize("times", [None, [0.5, 1.5, 4.0]])
def test_depth_histories_load_hold_unload_and_lift(here, curve, capsys, times):
    """The file holds the motion of Python, and force falls to zero while the indenter is lifted."""
    text, medium = MEDIA["prony"]
    (here / "medium.yaml").write_text(text)
    (here / "depth.csv").write_text("time,depth\n0,0\n1,0.2\n2,0.2\n3,0\n4,-0.1\n")
    option = "" if times is None else f"--times {','.join(map(str, times))}"
    assert run(f"{KINETICS} --depth-history depth.csv --medium medium.yaml {option}") == 0
    load = Load([0, 1, 2, 3, 4], depth=[0, 0.2, 0.2, 0, -0.1])
    motion, written = kinetics(curve, medium=medium, depth=load, times=times), values("kin.nc")
    for name in ("time", "depth", "force", "velocity", "contact_fraction"):
        np.testing.assert_array_equal(written[name], getattr(motion, name))
    assert written["force"].max() > 0
    assert (written["force"][-1], written["contact_fraction"][-1]) == (0, 0)
    assert read_dataset("kin.nc").attrs["depth"] == "depth.csv"
    assert "and force 0 at time 4" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        ("--force '3 mN' --viscosity '2 kPa s' --times 1e-6,2e-6", (3e-3, 2e-9, [1e-6, 2e-6])),
        ("--force 3e-3 --viscosity 2e3 --times 1e-6,2e-6", (3e-3, 2e-9, [1e-6, 2e-6])),
        ("--force '2 uN' --medium mega.yaml --times 1", (2e-6, Maxwell(2e-6, 5e-6), [1.0])),
    ],
)
def test_units_are_converted_if_the_curve_has_a_unit_of_length(here, curve, options, expected):
    """1 Pa is 1e-12 N/um², so 3 mN on 2 kPa s equals 3e-3 on 2e-9 in N and um."""
    (here / "mega.yaml").write_text("{kind: maxwell, shear_modulus: 2 MPa, viscosity: 5e6}")
    assert run(f"kinetics um.nc -o kin.nc {options}") == 0
    np.testing.assert_allclose(values("kin.nc")["depth"], kinetics(curve, *expected).depth, rtol=1e-12)
    assert read_dataset("kin.nc").variables["velocity"].attrs["units"] == "um s-1"


def test_curve_in_a_unit_that_is_a_number_of_metres_is_read_again(here):
    np.save("heights.npy", sphere_heights(17))
    assert run("indent heights.npy --spacing 1 --unit angstrom --depths 0.2,0.97 -o a.nc") == 0
    np.testing.assert_array_equal(values("a.nc")["depth"], [0.2, 0.97])
    assert run("kinetics a.nc --force '1e-4 nN' --viscosity 1e-3 --times 1e-9 -o kin.nc") == 0
    assert {read_dataset("kin.nc")[name].attrs["units"] for name in ("depth", "velocity")} == {"1e-10 m", "1e-10 m s-1"}


def test_missing_values_give_a_warning(here, capsys, complaint):
    """A ramp passes through depths before the first level, where the curve is not determined."""
    late = indent(Indenter(sphere_heights(17), 1.0), depths=[0.15, 0.6])
    viscorough.save(late, "late.nc")
    (here / "force.csv").write_text("time,force\n0,0\n0.1,0.1\n1,1\n2,1\n")
    load = f"--force-history force.csv --viscosity {1.6 / late.force[-1]}"
    assert run(f"kinetics late.nc {load} -o kin.nc") == 0
    assert np.isnan(values("kin.nc")["depth"]).tolist() == [False, True, False, False]
    assert "at 1 of 4 times depth, force or velocity are missing" in capsys.readouterr().err
    assert "depth, force or velocity are missing" in read_dataset("kin.nc").attrs["warnings"]
    line = f"kinetics late.nc {load} --times 0.1,0.11 -o k.nc"
    assert "all times are before the curve's first level" in complaint(line)


# ---- mistakes


def medium_text(kind, **changed):
    """Return a file of that kind of medium with some entries changed, as YAML text; None: left out."""
    entries = {key: str(value) for key, value in yaml.safe_load(MEDIA[kind][0]).items()} | changed
    return "\n".join(f"{key}: {value}" for key, value in entries.items() if value is not None)


BAD_MEDIA = [
    *[
        (medium_text("newtonian", viscosity=bad), "viscosity")
        for bad in ("0", "null", "{a: 1}", "'1 Pa s'", "2013-11-12")
    ],
    *[(medium_text("maxwell", **{key: None}), f"lacks {key}") for key in ("shear_modulus", "viscosity")],
    (medium_text("newtonian", young_modulus=6), "unknown key 'young_modulus'; allowed for newtonian: viscosity"),
    (medium_text("maxwell", more=1), "unknown key 'more'; allowed for"),
    (medium_text("springpot", exponent="half"), "exponent: 'half'; allowed: a plain number"),
    (medium_text("prony", moduli="[a, b]"), "moduli[0]: 'a'; allowed: a plain number"),
    (
        "kind: creep_table\nfile: table.csv",
        "kind 'creep_table'; allowed: newtonian, maxwell, kelvin_voigt, standard_linear_solid, prony, springpot. "
        "For a table of J or ψ, fit a Prony series, for example with pyRheo or RHEOS, and give kind: prony\n",
    ),
    ("viscosity: 1", "kind None; allowed: newtonian, maxwell"),
    ("- kind: newtonian", "it holds [{'kind': 'newtonian'}]); one mapping"),
    ("kind: newtonian\nviscosity: 1\nviscosity: 2", "key viscosity for the second time"),
    ("kind: newtonian\nviscosity: &a 1\nmore: *a", "aliases are not allowed"),
    ("!!python/object/apply:os.system ['touch here']", "not readable"),
    ("[" * 1000, "not readable"),
]


@pytest.mark.parametrize(("text", "message"), BAD_MEDIA)
def test_bad_media_are_one_line(here, complaint, text, message):
    (here / "medium.yaml").write_text(text)
    line = complaint(f"{KINETICS} --force 1 --medium medium.yaml")
    assert message in line
    assert line.startswith("viscorough kinetics: medium.yaml: ")
