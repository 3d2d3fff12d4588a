"""viscorough kinetics with media, force histories, times and units; and mistakes in them, each answered in one line."""

import numpy as np
import pytest

from support.command_line import sphere_heights
from support.faults import contents
from viscorough import cli
from viscorough.io import netcdf, tables
from viscorough.io.curves import curve_from_content
from viscorough.viscous.correspondence import impulses, kinetics
from viscorough.viscous.media import CreepTable, KelvinVoigt, Maxwell, Newtonian, Prony, Springpot, StandardLinearSolid

FORCE = 0.3
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
    "creep_table": ("{kind: creep_table, file: table.csv}", CreepTable([0, 1, 10], [0.2, 0.5, 0.9])),
}
TABLE, HISTORY = "t,J\n0,0.2\n1,0.5\n10,0.9\n", "t,F\n0,0\n1,0.2\n1,0.3\n9,0.3\n"


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """Folder with a curve without a unit and one in micrometres."""
    folder = tmp_path_factory.mktemp("curves")
    np.save(folder / "heights.npy", sphere_heights(17))
    indent = ["indent", str(folder / "heights.npy"), "--spacing", "1", "--until-fraction", "0.7"]
    assert cli.main([*indent, "-o", str(folder / "curve.nc")]) == 0
    content = netcdf.read(folder / "curve.nc")
    powers = {"depth": "um", "force": "um2", "stiffness": "um"}
    variables = {
        name: variable._replace(attributes=variable.attributes | {"units": powers.get(name, "1")})
        for name, variable in content.variables.items()
    }
    netcdf.write(netcdf.Content(variables, content.attributes), folder / "um.nc")
    return folder


@pytest.fixture
def here(made, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name in ("curve.nc", "um.nc"):
        (tmp_path / name).write_bytes((made / name).read_bytes())
    (tmp_path / "table.csv").write_text(TABLE)
    (tmp_path / "force.csv").write_text(HISTORY)
    (tmp_path / "newtonian.yaml").write_text(MEDIA["newtonian"][0])
    return tmp_path


def loading(here, name="curve.nc"):
    return curve_from_content(netcdf.read(here / name))


def result(here):
    return {name: variable.values for name, variable in netcdf.read(here / "kin.nc").variables.items()}


@pytest.mark.parametrize("load", ["force", "force and times", "history", "history and times"])
@pytest.mark.parametrize("kind", MEDIA)
def test_file_holds_what_python_gives(here, kind, load):
    text, medium = MEDIA[kind]
    (here / "medium.yaml").write_text(text)
    history = impulses([0, 0.2, 0.3, 0.3], [0, 1, 1, 9])
    arguments, expected = {
        "force": (["--force", str(FORCE)], (FORCE, medium)),
        "force and times": (["--force", str(FORCE), "--times", "0.5,2,7"], (FORCE, medium, [0.5, 2, 7])),
        "history": (["--force-history", "force.csv"], (history, medium)),
        "history and times": (["--force-history", "force.csv", "--times", "0.5,2,7"], (history, medium, [0.5, 2, 7])),
    }[load]
    assert cli.main(["kinetics", "curve.nc", *arguments, "--medium", "medium.yaml", "-o", "kin.nc"]) == 0
    motion, written = kinetics(loading(here), *expected), result(here)
    np.testing.assert_array_equal(written["time"], motion.time)
    np.testing.assert_array_equal(written["depth"], motion.depth)
    np.testing.assert_array_equal(written["velocity"], np.where(np.isinf(motion.velocity), np.nan, motion.velocity))
    if "history" in load:
        expected_force = [0, 0.2, 0.3, 0.3] if load == "history" else [0.1, 0.3, 0.3]
        np.testing.assert_allclose(written["force"], expected_force, rtol=1e-15)


def test_newtonian_medium_is_the_viscosity(here):
    (here / "medium.yaml").write_text(MEDIA["newtonian"][0])
    common = ["kinetics", "curve.nc", "--force", "2", "-o", "kin.nc"]
    assert cli.main([*common, "--medium", "medium.yaml"]) == 0
    by_name = result(here)
    assert cli.main([*common, "--viscosity", "30"]) == 0
    assert all((result(here)[name] == by_name[name]).all() for name in ("time", "depth", "velocity"))


def test_units_are_converted_where_the_unit_of_length_is_known(here):
    """1 Pa is 1e-12 N/um²: 3 mN on 2 kPa s is as 3e-3 on 2e-9 in N and um."""
    arguments = ["--times", "1,2", "-o", "kin.nc"]
    expected = kinetics(loading(here), 3e-3, 2e-9, [1e-6, 2e-6])
    for force, viscosity in (("3 mN", "2 kPa s"), ("0.003", "2000"), ("3e-3 N", "2e3")):
        arguments = ["--force", force, "--viscosity", viscosity, "--times", "1e-6,2e-6", "-o", "kin.nc"]
        assert cli.main(["kinetics", "um.nc", *arguments]) == 0
        np.testing.assert_allclose(result(here)["depth"], expected.depth, rtol=1e-12)
        assert netcdf.read(here / "kin.nc").variables["velocity"].attributes["units"] == "um s-1"
    (here / "medium.yaml").write_text("{kind: maxwell, shear_modulus: 2 MPa, viscosity: 5e6}")
    arguments = ["--force", "2 uN", "--medium", "medium.yaml", "--times", "1", "-o", "kin.nc"]
    assert cli.main(["kinetics", "um.nc", *arguments]) == 0
    expected = kinetics(loading(here), 2e-6, Maxwell(2e-6, 5e-6), [1.0])
    np.testing.assert_allclose(result(here)["depth"], expected.depth, rtol=1e-12)
    (here / "medium.yaml").write_text("{kind: creep_table, file: table.csv}")  # compliances in 1/Pa
    assert cli.main(["kinetics", "um.nc", "--force", "1e-12", *arguments[2:]]) == 0
    expected = kinetics(loading(here), 1.0, MEDIA["creep_table"][1], [1.0])
    np.testing.assert_allclose(result(here)["depth"], expected.depth, rtol=1e-12)


@pytest.mark.parametrize("command", ["kinetics", "march"])
def test_units_in_headings_are_converted(here, made, command):
    """A force history in ms and mN, and a creep table in h and 1/MPa, are those in s, N and 1/Pa."""
    np.save("um.npy", np.load(made / "heights.npy"))
    if command == "march":
        common = ["march", "um.npy", "--spacing", "1 um", "--unit", "um", "--method", "implicit", "-o", "kin.nc"]
    else:
        common = ["kinetics", "um.nc", "-o", "kin.nc"]
    motions = []
    for text in ("0,0\n1e-3,3e-3\n2e-3,4e-3\n", "t [ms],F [mN]\n0,0\n1,3\n2,4\n"):
        (here / "force.csv").write_text(text)
        assert cli.main([*common, "--force-history", "force.csv", "--viscosity", "2 MPa s"]) == 0
        motions.append(result(here))
    for name, values in motions[0].items():
        np.testing.assert_allclose(motions[1][name], values, rtol=1e-12, err_msg=name)
    if command == "kinetics":
        (here / "medium.yaml").write_text(MEDIA["creep_table"][0])
        depths = []
        for text in ("t,J\n0,1e-6\n3600,2e-6\n", "t (h),J (1/MPa)\n0,1\n1,2\n", "t/h,J in MPa^-1\n0,1\n1,2\n"):
            (here / "table.csv").write_text(text)
            assert cli.main([*common, "--force", "1 uN", "--medium", "medium.yaml", "--times", "1800"]) == 0
            depths += result(here)["depth"].tolist()
        np.testing.assert_allclose(
            depths, kinetics(loading(here), 1.0, viscosity=1.0, times=[1.5]).depth[0], rtol=1e-12
        )


def test_missing_values_are_warned_of(here, capsys, made):
    """A ramp passes through depths before the first level, at which the curve is not determined."""
    indent = ["indent", str(made / "heights.npy"), "--spacing", "1", "--depths", "0.15,0.6"]
    assert cli.main([*indent, "-o", "late.nc"]) == 0
    (here / "force.csv").write_text("0,0\n0.1,0.1\n1,1\n2,1\n")
    viscosity = str(1.6 / loading(here, "late.nc").force[-1])
    load = ["--force-history", "force.csv", "--viscosity"]
    assert cli.main(["kinetics", "late.nc", *load, viscosity, "-o", "kin.nc"]) == 0
    assert np.isnan(result(here)["depth"]).tolist() == [False, True, False, False]
    assert "at 1 of 4 times depth or velocity are missing" in capsys.readouterr().err
    assert "depth or velocity are missing" in netcdf.read(here / "kin.nc").attributes["warnings"]
    assert cli.main(["kinetics", "late.nc", *load, viscosity, "--times", "0.1,0.11", "-o", "k.nc"]) == 2
    assert "all are before the curve's first level" in capsys.readouterr().err
    assert not (here / "k.nc").exists()


# ---- mistakes

NUMBERS = ["0", "-1", ".nan", ".inf", "true", "null", "[1]", "{a: 1}", "one", "'1 Pa s'", "2013-11-12", "1e400", "''"]
KEYS = [
    ("newtonian", "viscosity"),
    ("maxwell", "shear_modulus"),
    ("kelvin_voigt", "viscosity"),
    ("standard_linear_solid", "relaxation_time"),
    ("springpot", "exponent"),
]
GOOD = {
    "newtonian": {"viscosity": "1"},
    "maxwell": {"shear_modulus": "1", "viscosity": "1"},
    "kelvin_voigt": {"shear_modulus": "1", "viscosity": "1"},
    "standard_linear_solid": {"instantaneous_modulus": "2", "relaxed_modulus": "1", "relaxation_time": "1"},
    "springpot": {"modulus": "1", "exponent": "0.5"},
    "prony": {"relaxed_modulus": "1", "moduli": "[1, 2]", "relaxation_times": "[1, 2]"},
    "creep_table": {"file": "table.csv"},
}


def medium_text(kind, **changed):
    entries = {"kind": kind} | GOOD[kind] | changed
    return "\n".join(f"{key}: {value}" for key, value in entries.items() if value is not None)


BAD_MEDIA = {
    **{f"{kind} {key} {bad}": (medium_text(kind, **{key: bad}), key) for kind, key in KEYS for bad in NUMBERS},
    **{f"{kind} lacks {key}": (medium_text(kind, **{key: None}), f"lacks {key}") for kind, key in KEYS},
    **{f"{kind} with more": (medium_text(kind, more=1), "unknown key 'more'; allowed for") for kind in GOOD},
    "relaxed above instantaneous": (medium_text("standard_linear_solid", relaxed_modulus=3), "allowed: below"),
    "exponent 1": (medium_text("springpot", exponent=1), "allowed: above 0 and below 1"),
    "prony, a number": (medium_text("prony", moduli=1), "a list of one or more"),
    "prony, none": (medium_text("prony", moduli="[]"), "a list of one or more"),
    "prony, texts": (medium_text("prony", moduli="[a, b]"), "moduli[0]: 'a'; allowed: a plain number"),
    "prony, lists": (medium_text("prony", moduli="[[1], [2]]"), "moduli"),
    "prony, a negative": (medium_text("prony", moduli="[1, -2]"), "moduli[1]: -2"),
    "prony, a zero time": (medium_text("prony", relaxation_times="[0, 2]"), "relaxation_times[0]: 0"),
    "prony, too few times": (medium_text("prony", relaxation_times="[1]"), "one time for every modulus"),
    "prony, negative spring": (medium_text("prony", relaxed_modulus=-1), "0 or a finite number above 0"),
    "prony, too far apart": (medium_text("prony", moduli="[1e308, 1e308]"), "too far apart"),
    "maxwell, too far apart": (medium_text("maxwell", shear_modulus="1e-300", viscosity="1e300"), "too far apart"),
    "table, missing": (medium_text("creep_table", file="none.csv"), "none.csv: not readable"),
    "table, a number": (medium_text("creep_table", file=3), "the name of a .csv or .npy file"),
    "table, other file": (medium_text("creep_table", file="curve.nc"), "a creep table is read from .csv and .npy"),
    "no kind": ("viscosity: 1", "kind None; allowed: newtonian, maxwell"),
    "other kind": ("{kind: rubber, viscosity: 1}", "kind 'rubber'; allowed"),
    "kind a list": ("{kind: [maxwell], viscosity: 1}", "kind ['maxwell']"),
    "a list": ("- kind: newtonian", "holds [{'kind': 'newtonian'}]; one mapping"),
    "a number": ("3", "holds 3"),
    "empty": ("", "holds None"),
    "no YAML": ("{kind: newtonian", "not readable"),
    "a key twice": ("kind: newtonian\nviscosity: 1\nviscosity: 2", "key viscosity for the second time"),
    "an alias": ("kind: newtonian\nviscosity: &a 1\nmore: *a", "aliases are not allowed"),
    "a python object": ("!!python/object/apply:os.system ['touch here']", "not readable"),
    "a tag": ("kind: !!binary x", "not readable"),
    "two documents": ("kind: newtonian\n---\nkind: maxwell", "not readable"),
    "no letters": ("\x00\x01", "not readable"),
    "deep": ("[" * 3000, "not readable"),
    "a key that is no text": ("{kind: newtonian, 1: 2}", "unknown key 1"),
    "a key that is a list": ("{kind: newtonian, [1]: 2}", "not readable"),
}
BAD_TABLES = {
    "decreasing": ("0,2\n1,1\n", "never decreases"),
    "convex": ("0,0\n1,1\n2,3\n", "after time 1 than before; allowed: a concave J"),
    "late": ("1,1\n2,2\n", "times that start with 0"),
    "back in time": ("0,1\n2,2\n1,3\n", "start with 0 and increase"),
    "negative": ("0,-1\n1,1\n", "starts at 0 or more"),
    "nan": ("0,1\n1,nan\n", "finite"),
    "one row": ("0,1\n", "two rows are needed"),
    "three columns": ("0,1,2\n1,2,3\n", "two columns"),
    "text": ("0,1\n1,one\n", "not readable"),
    "a unit without one of length": (
        "t,J [1/MPa]\n0,1\n1,2\n",
        "the heading 'J [1/MPa]' states a unit, but the unit of",
    ),
    "a comment with a unit": ("# t in h\n0,1\n1,2\n", "the comment '# t in h' states a unit"),
    "semicolons": ("0;1\n1;2\n", "not readable"),
    "decimal commas": ("0,0;1,5\n1,0;2,5\n", "not readable"),
}
BAD_HISTORIES = {
    "negative": ("0,1\n1,-1\n", "sample 1 is -1"),
    "nan": ("0,1\n1,nan\n", "sample 1 is nan"),
    "infinite": ("0,1\n1,inf\n", "sample 1 is inf"),
    "back in time": ("0,1\n2,1\n1,1\n", "each larger than the one before, or given twice where the force steps"),
    "thrice": ("0,1\n1,1\n1,2\n1,3\n", "or given twice where the force steps"),
    "one row": ("0,1\n", "two rows are needed"),
    "one column": ("0\n1\n", "two columns, time and force"),
    "three columns": ("0,1,2\n1,2,3\n", "two columns, time and force"),
    "text": ("0,1\n1,one\n", "not readable"),
    "empty": ("", "two columns, time and force"),
    "units": ("0 s,1 N\n1 s,2 N\n", "not readable"),
    "a unit without one of length": (
        "t [ms],F\n0,0\n1,1\n",
        "the heading 't [ms]' states a unit, but the unit of length",
    ),
    "wrong order": ("F [N],t [s]\n0,0\n1,1\n", "the heading 'F [N]' states a unit"),
    "decimal commas": ("0,0 1,5\n1,0 2,5\n", "not readable"),
    "unloading": ("0,0.3\n1,0.3\n2,0\n", "from time 1 on the contact would recede"),
    "a step down": ("0,0.3\n1,0.3\n1,0.2\n2,0.2\n", "from time 1 on the contact would recede"),
    "beyond the curve": ("0,0.3\n1,1e9\n", "at time 1 the creep"),
    "nothing but zeros": ("0,0\n1,0\n", ""),
}
BAD_OPTIONS = {
    "no force": (["--viscosity", "1"], "one of --force and --force-history is needed"),
    "two forces": (["--viscosity", "1", "--force", "1", "--force-history", "force.csv"], "one of --force"),
    "no medium": (["--force", "1"], "one of --viscosity and --medium is needed"),
    "two media": (["--force", "1", "--viscosity", "1", "--medium", "medium.yaml"], "one of --viscosity"),
    "times overflow": (["--force", "1e-320", "--viscosity", "1"], ", --viscosity 1: times overflow"),
    "times of a medium overflow": (
        ["--force", "1e-320", "--medium", "newtonian.yaml"],
        ", --medium newtonian.yaml: times overflow",
    ),
    "missing medium": (
        ["--force", "1", "--medium", "none.yaml"],
        "none.yaml: not readable (No such file or directory)",
    ),
    "a folder": (["--force", "1", "--medium", "."], "not readable (it is a folder); a regular file"),
    "missing history": (["--force-history", "none.csv", "--viscosity", "1"], "none.csv: not readable"),
    "history of another kind": (["--force-history", "curve.nc", "--viscosity", "1"], "read from .csv and .npy"),
    "times after the history": (
        ["--force-history", "force.csv", "--viscosity", "1", "--times", "1,10"],
        "times: from 1 to 10; allowed: within those of the force history, 0 to 9",
    ),
    "a unit without one of length": (["--force", "1 N", "--viscosity", "1"], "--force 1 N: needs a plain number"),
    "the same of a viscosity": (["--force", "1", "--viscosity", "1 Pa s"], "--viscosity 1 Pa s: needs a plain number"),
    "a wrong unit": (["--force", "1 Pa", "--viscosity", "1"], "'1 Pa' is not a number above 0"),
    "a wrong unit of viscosity": (["--force", "1", "--viscosity", "1 Pa"], "'1 Pa' is not a number above 0"),
    **{
        f"times {bad}": (["--force", "1", "--viscosity", "1", "--times", bad], "--times")
        for bad in ("0,1", "1,1", "2,1", "a", "", "1,nan", "-1,1", "inf", "1,,2")
    },
    **{
        f"{option} {bad}": (["--force", "1", "--viscosity", "1", option, bad], option)
        for option in ("--force", "--viscosity")
        for bad in ("0", "-1", "nan", "inf", "", "one")
    },
    "output is the medium": (["--force", "1", "--medium", "medium.yaml", "-o", "medium.yaml"], "replace the medium"),
    "output is the history": (["--force-history", "force.csv", "--viscosity", "1", "-o", "force.csv"], "replace the"),
}


def complaint(here, capsys, arguments, curve=("curve.nc",)):
    """The one line of a command that fails and leaves all files as they are."""
    before = contents(here)
    assert cli.main(["kinetics", *curve, "-o", "kin.nc", *arguments]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("viscorough kinetics: ")
    assert len(err.splitlines()) == 1, err
    assert contents(here) == before
    return err


@pytest.mark.parametrize("name", BAD_MEDIA)
def test_bad_media(here, capsys, name):
    text, message = BAD_MEDIA[name]
    (here / "medium.yaml").write_text(text)
    line = complaint(here, capsys, ["--force", "1", "--medium", "medium.yaml"])
    assert line.startswith("viscorough kinetics: medium.yaml: ")
    assert message in line
    assert len(line) < 400


@pytest.mark.parametrize("name", BAD_TABLES)
def test_bad_tables(here, capsys, name):
    text, message = BAD_TABLES[name]
    (here / "table.csv").write_text(text)
    (here / "medium.yaml").write_text(MEDIA["creep_table"][0])
    assert message in complaint(here, capsys, ["--force", "1", "--medium", "medium.yaml"])


@pytest.mark.parametrize("name", BAD_HISTORIES)
def test_bad_histories(here, capsys, name):
    text, message = BAD_HISTORIES[name]
    (here / "force.csv").write_text(text)
    (here / "medium.yaml").write_text(MEDIA["maxwell"][0])
    if message:
        assert message in complaint(here, capsys, ["--force-history", "force.csv", "--medium", "medium.yaml"])
    else:
        assert cli.main(["kinetics", "curve.nc", "--force-history", "force.csv", "--viscosity", "1", "-o", "k.nc"]) == 0


@pytest.mark.parametrize(
    ("heading", "message"),
    [
        ("F [N],t [s]", "the heading 'F [N]': unit 'N': cannot be converted to s"),
        ("t [s],F [um]", "the heading 'F [um]': unit 'um': cannot be converted to N"),
        ("t [s],F [kp]", "the heading 'F [kp]': unit 'kp': a unit such as"),
        ("# in ms", "the comment '# in ms' states a unit; a heading of both columns is needed"),
    ],
)
def test_units_of_histories_that_cannot_be_used(here, capsys, heading, message):
    (here / "curve.nc").write_bytes((here / "um.nc").read_bytes())
    (here / "force.csv").write_text(f"{heading}\n0,0\n1,1\n")
    line = complaint(here, capsys, ["--force-history", "force.csv", "--viscosity", "1"])
    assert line.startswith("viscorough kinetics: force.csv: not readable (")
    assert message in line


@pytest.mark.parametrize(
    ("name", "change", "message"),
    [
        ("force", {"units": "nm2"}, "force is in 'nm2' and depth in 'um'; 'um2' is needed for force"),
        ("depth", {"units": "mm"}, "force is in 'um2' and depth in 'mm'; 'mm2' is needed for force"),
        ("stiffness", {"units": "1"}, "stiffness is in '1' and depth in 'um'; 'um' is needed for stiffness"),
        ("contact_count", {"values": lambda count: -count}, "contact_count must be a whole number from 1 to"),
        ("contact_count", {"values": lambda count: count[::-1]}, "contact_count must not decrease"),
        ("stiffness", {"values": lambda stiffness: stiffness[::-1]}, "stiffness must not decrease (level 1)"),
        ("force", {"values": lambda force: 1e6 * force}, "force must rise with the depth as the stiffness requires"),
    ],
)
def test_bad_curves(here, capsys, name, change, message):
    for suffix in ("nc", "csv"):
        content = netcdf.read(here / "um.nc")
        variable = content.variables[name]
        if "units" in change:
            variable = variable._replace(attributes=variable.attributes | change)
        else:
            variable = variable._replace(values=change["values"](variable.values))
        content = netcdf.Content(content.variables | {name: variable}, content.attributes)
        (netcdf if suffix == "nc" else tables).write(content, here / f"bad.{suffix}")
        arguments = [f"bad.{suffix}", "--force", "1", "--viscosity", "1"]
        line = complaint(here, capsys, arguments, curve=[])
        assert line.startswith(f"viscorough kinetics: bad.{suffix}: ")
        assert message in line
        assert cli.main(["plot", f"bad.{suffix}", "-o", "bad.png"]) == 2
        assert message in capsys.readouterr().err


@pytest.mark.parametrize("name", BAD_OPTIONS)
def test_bad_options(here, capsys, name):
    arguments, message = BAD_OPTIONS[name]
    (here / "medium.yaml").write_text(MEDIA["maxwell"][0])
    assert message in complaint(here, capsys, arguments)
