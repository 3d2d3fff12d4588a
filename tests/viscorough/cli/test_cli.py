"""The contract of the command line, through real files."""

import os
import signal
import subprocess
import sys
import textwrap
import time
import warnings
from pathlib import Path

import click
import numpy as np
import pytest
import xarray as xr

from support.command_line import RADIUS, VISCOROUGH, sphere_heights
from viscorough import cli
from viscorough.contact import loading_path
from viscorough.errors import ConvergenceError
from viscorough.indenter import Indenter
from viscorough.io import netcdf
from viscorough.io.curves import curve_from_content
from viscorough.io.datasets import read_dataset, write_dataset
from viscorough.surfaces import self_affine_disc

FORCE, VISCOSITY = 2.0, 3.0


@pytest.fixture(scope="module")
def sphere(tmp_path_factory):
    """Folder with heights.npy, curve.nc and kinetics.nc of a sphere, made by real processes."""
    folder = tmp_path_factory.mktemp("sphere")
    np.save(folder / "heights.npy", sphere_heights())
    for arguments in (
        ["indent", "heights.npy", "--spacing", "1", "--until-fraction", "0.5", "-o", "curve.nc"],
        ["kinetics", "curve.nc", "--force", str(FORCE), "--viscosity", str(VISCOSITY), "-o", "kinetics.nc"],
    ):
        done = subprocess.run([VISCOROUGH, *arguments], cwd=folder, capture_output=True, text=True, check=False)
        assert (done.returncode, done.stderr) == (0, "")
        assert done.stdout.startswith(arguments[-1])
    return folder


@pytest.fixture
def here(tmp_path, monkeypatch):
    """A working folder that holds only a small heights.npy."""
    monkeypatch.chdir(tmp_path)
    np.save("heights.npy", sphere_heights(9))
    return tmp_path


def complaint(capsys):
    """The one line on stderr; nothing on stdout."""
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.endswith("\n")
    assert len(captured.err.splitlines()) == 1, captured.err
    assert "Traceback" not in captured.err
    return captured.err


# ---- contents of the files


def test_curve_file_follows_the_contract(sphere):
    ds = xr.open_dataset(sphere / "curve.nc")
    names = {"depth", "force", "stiffness", "contact_count", "contact_fraction"}
    assert names <= set(ds.data_vars)
    assert all(ds[name].dims == ("level",) for name in names)
    elements = int(np.isfinite(sphere_heights()).sum())
    assert ds.elements == elements
    np.testing.assert_array_equal(ds.contact_fraction, ds.contact_count / elements)
    assert 0.5 <= ds.contact_fraction[-1] < 1
    assert ds.contact_fraction[-2] < 0.5
    assert (ds.spacing, ds.heights, ds.tolerance) == (1, "heights.npy", 1e-3)


def test_files_contain_the_results_of_the_functions(sphere):
    curve = loading_path.indent(Indenter(sphere_heights(), 1.0), until_fraction=0.5)
    stored = curve_from_content(netcdf.read(sphere / "curve.nc"))
    for name in ("depth", "force", "stiffness", "contact_count"):
        np.testing.assert_allclose(getattr(stored, name), getattr(curve, name), rtol=1e-12)


def test_kinetics_file_adds_to_the_curve(sphere):
    curve, kinetics = (xr.open_dataset(sphere / name) for name in ("curve.nc", "kinetics.nc"))
    xr.testing.assert_identical(kinetics.drop_vars(["time", "velocity"]).drop_attrs(), curve.drop_attrs())
    np.testing.assert_allclose(kinetics.time, curve.force * VISCOSITY / FORCE, rtol=1e-15)
    np.testing.assert_allclose(kinetics.velocity, FORCE / (VISCOSITY * curve.stiffness), rtol=1e-15)
    assert (kinetics.force.units, kinetics.time.units, kinetics.velocity.units) == ("1", "s", "s-1")
    assert (kinetics.attrs["force"], kinetics.attrs["viscosity"]) == (FORCE, VISCOSITY)
    assert "exact" in kinetics.correspondence


def test_sphere_follows_lee_and_radok(sphere):
    """u^(3/2) = 3Ft/(16η√R), within the errors of square elements of side d in a contact of radius a.

    For a > 5d the depth is off by up to 0.05 (d/a)², second order as for any smooth shape, until the
    tolerance takes over; the velocity, for which the count of elements decides, by up to 0.16 d/a. The test allows
    about twice that.
    """
    ds = xr.open_dataset(sphere / "kinetics.nc")
    ds = ds.isel(level=ds.depth.values * RADIUS > 5**2)
    assert ds.level.size >= 5
    across = np.sqrt(ds.depth * RADIUS).values
    depth = (3 * FORCE * ds.time / (16 * VISCOSITY * np.sqrt(RADIUS))) ** (2 / 3)
    velocity = 2 * depth / (3 * ds.time)
    assert (abs(ds.depth / depth - 1) < 0.1 / across**2 + 1e-5).all()
    assert (abs(ds.velocity / velocity - 1) < 0.25 / across).all()


def test_depths_are_met_exactly_and_in_order(here):
    assert cli.main(["indent", "heights.npy", "--spacing", "1", "--depths", "1e-3, 0.02,0.035", "-o", "a.nc"]) == 0
    ds = read_dataset("a.nc")
    assert ds.depth.values.tolist() == [1e-3, 0.02, 0.035]
    np.testing.assert_allclose(ds.force[0], ds.stiffness[0] * 1e-3, rtol=1e-9)
    assert ds.contact_count[0] == 1


def test_units_of_heights_go_through_to_the_kinetics(here):
    heights = xr.Dataset({"z": (("y", "x"), sphere_heights(9), {"long_name": "height", "units": "um"})})
    write_dataset(heights, "heights.nc")
    assert cli.main(["indent", "heights.nc", "--spacing", "1", "-o", "curve.nc"]) == 0
    assert cli.main(["kinetics", "curve.nc", "--force", "1", "--viscosity", "1", "-o", "curve.nc"]) == 0
    ds = read_dataset("curve.nc")
    units = {name: ds[name].units for name in ("depth", "force", "stiffness", "time", "velocity")}
    assert units == {"depth": "um", "force": "um2", "stiffness": "um", "time": "s", "velocity": "um s-1"}


def test_tolerance_is_passed_on(here):
    for tolerance in ("1e-2", "1e-8"):
        assert cli.main(["indent", "heights.npy", "--spacing", "1", "--tolerance", tolerance, "-o", "a.nc"]) == 0
        ds = read_dataset("a.nc")
        assert ds.tolerance == float(tolerance)
        assert float(ds.residual.max()) <= float(tolerance)


# ---- mistakes of the user

INDENT = ["indent", "heights.npy", "--spacing", "1", "-o", "out.nc"]
KINETICS = ["kinetics", "curve.nc", "--force", "1", "--viscosity", "1", "-o", "out.nc"]
MISTAKES = [
    ([], "viscorough: ", "Missing command"),
    (["grow"], "viscorough: ", "grow"),
    (["--colour"], "viscorough: ", "--colour"),
    (["indent"], "viscorough indent: ", "HEIGHTS"),
    (["indent", "heights.npy", "-o", "out.nc"], "viscorough indent: ", "--spacing"),
    (["indent", "heights.npy", "--spacing", "1"], "viscorough indent: ", "--output"),
    (
        ["indent", "missing.npy", *INDENT[2:]],
        "viscorough indent: ",
        "missing.npy: not readable (No such file",
    ),
    (["indent", "curve.nc", *INDENT[2:]], "viscorough indent: ", "curve.nc: no two-dimensional variable"),
    (["indent", "line.npy", *INDENT[2:]], "viscorough indent: ", "line.npy: heights have the shape (3,)"),
    (["indent", "infinite.npy", *INDENT[2:]], "viscorough indent: ", "infinite.npy"),
    (["indent", "outside.npy", *INDENT[2:]], "viscorough indent: ", "outside.npy"),
    ([*INDENT, "--until", "1"], "viscorough indent: ", "No such option '--until'"),
    ([*INDENT, "more.npy"], "viscorough indent: ", "more.npy"),
    ([*INDENT, "--tolerance", "0"], "viscorough indent: ", "--tolerance"),
    ([*INDENT, "--tolerance", "1e-30"], "viscorough indent: ", "tolerance"),
    ([*INDENT, "--tolerance", "2"], "viscorough indent: ", "--tolerance"),
    ([*INDENT, "--until-fraction", "1.5"], "viscorough indent: ", "up to 1"),
    ([*INDENT, "--until-fraction", "0.5", "--depths", "1"], "viscorough indent: ", "exclude"),
    *[
        ([*INDENT[:3], spacing, *INDENT[4:]], "viscorough indent: ", f"'{spacing}' is not a number above 0")
        for spacing in ("0", "-1", "nan", "inf", "1e-400", "")
    ],
    *[
        ([*INDENT, "--depths", depths], "viscorough indent: ", "--depths")
        for depths in ("", "a", "1,,2", "1,2,", "1,1", "2,1", "0,1", "-1,1", "1,inf", "1 2", "nan")
    ],
    *[
        ([*command[:-1], output], f"viscorough {command[0]}: ", output)
        for command in (INDENT, KINETICS)
        for output in ("none/out.nc", "folder", "pipe")
    ],
    (
        ["indent", "huge.npy", "--spacing", "1e300", "-o", "out.nc"],
        "viscorough indent: ",
        "",
    ),  # F/G overflows
    ([*INDENT[:-1], "heights.npy"], "viscorough indent: ", "replace the heights"),
    (["kinetics", "curve.nc", "-o", "out.nc"], "viscorough kinetics: ", "one of --force and --force-history"),
    (
        ["kinetics", "missing.nc", *KINETICS[2:]],
        "viscorough kinetics: ",
        "missing.nc: not readable (No such file",
    ),
    (["kinetics", "heights.npy", *KINETICS[2:]], "viscorough kinetics: ", "heights.npy: not readable"),
    (["kinetics", "map.nc", *KINETICS[2:]], "viscorough kinetics: ", "map.nc: no numbers depth(level)"),
    *[
        ([*KINETICS, option, value], "viscorough kinetics: ", f"{option}': '{value}' is not a number above 0")
        for option in ("--force", "--viscosity")
        for value in ("0", "-1", "nan", "inf", "five")
    ],
    *[
        ([*KINETICS, "--force", force, "--viscosity", viscosity], "viscorough kinetics: ", "overflow")
        for force, viscosity in (("1e-300", "1e300"), ("1e300", "1e-300"))
    ],
    *[
        (
            ["march", *INDENT[1:], "--method", "events", "--force", force, "--viscosity", viscosity],
            "viscorough march: ",
            "times or velocities overflow",
        )
        for force, viscosity in (("1e-300", "1e300"), ("1e-10", "1.7e308"), ("1e300", "1e-300"))
    ],
]


@pytest.mark.parametrize(("arguments", "where", "what"), MISTAKES, ids=[" ".join(m[0]) for m in MISTAKES])
def test_mistakes_are_one_line(here, sphere, capsys, arguments, where, what):
    np.save("line.npy", np.zeros(3))
    np.save("huge.npy", sphere_heights(9) * 1e300)
    np.save("infinite.npy", np.array([[0, np.inf]]))
    np.save("outside.npy", np.full((3, 3), np.nan))
    Path("curve.nc").write_bytes((sphere / "curve.nc").read_bytes())
    heights = xr.Dataset({"z": (("y", "x"), sphere_heights(9), {"long_name": "height", "units": "m"})})
    write_dataset(heights, "map.nc")
    Path("folder").mkdir()
    os.mkfifo("pipe")
    before = {path: path.stat().st_mtime_ns for path in here.rglob("*")}
    assert cli.main(arguments) == 2
    line = complaint(capsys)
    assert line.startswith(where)
    assert what in line
    assert {path: path.stat().st_mtime_ns for path in here.rglob("*")} == before


@pytest.fixture
def run():
    """Run the command line with one command, `indent`, which calls a function."""

    def run_with(function):
        commands = click.Group()
        commands.command("indent")(function)
        return cli.main(["indent"], commands)

    return run_with


@pytest.mark.parametrize(
    ("error", "code", "what"),
    [
        (ConvergenceError("level 3 did not\nconverge"), 1, "viscorough indent: level 3 did not converge"),
        (MemoryError("Unable to allocate 8 TiB"), 2, "not enough memory (Unable to allocate 8 TiB)"),
        (MemoryError(), 2, "not enough memory; a smaller map"),
        (ValueError("depth: too deep"), 2, "viscorough indent: depth: too deep"),
        (OSError("a.nc: not written"), 2, "viscorough indent: a.nc: not written"),
    ],
)
def test_errors_are_one_line(run, capsys, error, code, what):
    def fail():
        warnings.warn("overflow on the way", RuntimeWarning, stacklevel=1)
        raise error

    assert run(fail) == code
    assert what in complaint(capsys)


def test_warnings_are_written_once_and_on_one_line(run, capsys):
    def warn():
        for _ in range(3):
            warnings.warn("the spacing\nis odd", UserWarning, stacklevel=1)

    assert run(warn) == 0
    assert capsys.readouterr().err == "viscorough indent: warning: the spacing is odd\n"


def test_steep_slopes_give_a_warning_on_stderr_and_in_the_file(here, capsys):
    np.save("steep.npy", 100 * sphere_heights(9))
    assert cli.main(["indent", "steep.npy", *INDENT[2:]]) == 0
    line = capsys.readouterr().err
    assert line.startswith("viscorough indent: warning: steep.npy: the rms slope is ")
    warned = read_dataset("out.nc").attrs["warnings"]
    assert warned in line
    assert "small slopes" in warned


def test_gentle_slopes_do_not_warn(here, capsys):
    assert cli.main(INDENT) == 0
    assert capsys.readouterr().err == ""
    assert "warnings" not in read_dataset("out.nc").attrs


def test_errors_in_the_code_are_not_hidden(run):
    with pytest.raises(ZeroDivisionError):
        run(lambda: 1 / 0)


# ---- real processes


def test_mistake_in_a_real_process(here):
    arguments = [VISCOROUGH, "indent", "heights.npy", "--spacing", "-1", "-o", "out.nc"]
    done = subprocess.run(arguments, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (2, "")
    assert len(done.stderr.splitlines()) == 1
    assert done.stderr.startswith("viscorough indent: ")
    assert os.listdir(here) == ["heights.npy"]


def test_interrupt_is_quiet_and_leaves_nothing(here):
    """The whole curve of this map takes minutes; the interrupt comes while modules load or in the solver."""
    np.save("heights.npy", np.random.default_rng(0).random((600, 600)))
    script = textwrap.dedent("""
        import sys
        from viscorough import cli
        from viscorough.io import heights
        read = heights.read_heights
        def announced(*arguments, **options):
            print("reading", flush=True)
            return read(*arguments, **options)
        heights.read_heights = announced
        sys.exit(cli.main(sys.argv[1:]))
    """)
    command = [sys.executable, "-c", script, *INDENT, "--until-fraction", "1"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        assert process.stdout.readline() == "reading\n"
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=60)
    assert (process.returncode, out, err) == (-signal.SIGINT, "", ""), "a shell reports 130"
    assert os.listdir(here) == ["heights.npy"]


def test_full_disk_in_a_real_process(here):
    script = "import resource, sys; resource.setrlimit(resource.RLIMIT_FSIZE, (2000, 2000)); "
    script += "from viscorough.cli import main; sys.exit(main(sys.argv[1:]))"
    command = [sys.executable, "-c", script, *INDENT]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("viscorough indent: out.nc: not written")
    assert len(done.stderr.splitlines()) == 1
    assert os.listdir(here) == ["heights.npy"]


def test_help_and_mistakes_do_not_wait_for_slow_imports():
    script = textwrap.dedent("""
        import sys
        from viscorough.cli import main
        assert main(["--help"]) == main(["indent", "--help"]) == main(["kinetics", "--help"]) == 0
        assert main(["--version"]) == 0
        assert main(["indent", "--spacing", "x"]) == 2
        print(sorted({"numpy", "numba", "scipy", "xarray", "netCDF4"} & set(sys.modules)))
    """)
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "[]"
    assert "viscorough 0." in done.stdout
    assert "larger is higher" in done.stdout.lower()
    assert done.stdout.count("Example") == 3


# ---- march


def test_march_methods_agree_with_kinetics(tmp_path):
    """The three direct integrations and the correspondence, through files."""
    disc = self_affine_disc(0.6, 17, seed=1)
    np.save(tmp_path / "heights.npy", disc.heights)
    heights = [str(tmp_path / "heights.npy"), "--spacing", str(disc.spacing)]
    times = "1,3,9"
    common = ["--force", "2", "--viscosity", "4"]
    assert cli.main(["march", *heights, "--method", "events", *common, "-o", str(tmp_path / "events.nc")]) == 0
    steps = ["--method", "implicit", "--times", times, "-o", str(tmp_path / "implicit.nc")]
    assert cli.main(["march", *heights, *common, *steps]) == 0
    steps = ["--method", "explicit", "--times", times, "--overlap", "1e-3", "-o", str(tmp_path / "explicit.nc")]
    assert cli.main(["march", *heights, *common, *steps]) == 0
    ends = xr.load_dataset(tmp_path / "implicit.nc", decode_times=False)
    depths = ",".join(repr(float(u)) for u in ends["depth"].values)
    assert (
        cli.main(["indent", *heights, "--depths", depths, "--tolerance", "1e-9", "-o", str(tmp_path / "curve.nc")]) == 0
    )
    assert cli.main(["kinetics", str(tmp_path / "curve.nc"), *common, "-o", str(tmp_path / "kin.nc")]) == 0
    exact = xr.load_dataset(tmp_path / "kin.nc", decode_times=False)
    np.testing.assert_allclose(exact["time"], [1, 3, 9], rtol=1e-5)
    np.testing.assert_allclose(exact["velocity"], ends["velocity"], rtol=1e-4)
    events = xr.load_dataset(tmp_path / "events.nc", decode_times=False)
    np.testing.assert_allclose(np.interp(ends["time"], events["time"], events["depth"]), ends["depth"], rtol=1e-5)
    explicit = xr.load_dataset(tmp_path / "explicit.nc", decode_times=False)
    np.testing.assert_allclose(explicit["depth"], ends["depth"], rtol=5e-3)
    assert 0 < explicit["overlap"].max() <= 1.001e-3
    assert explicit.attrs["method"] == "explicit"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--method", "events", "--times", "1,2"], "--times is not for --method events"),
        (["--method", "explicit"], "--times is needed by --method explicit"),
        (["--method", "implicit", "--times", "2,1"], "must be larger than the one before"),
        (["--method", "implicit", "--times", "1", "--overlap", "0.1"], "--overlap is not for"),
        (["--method", "explicit", "--times", "1", "--until-fraction", "0.1"], "--until-fraction is not for"),
        (["--method", "magic"], "magic"),
        (["--method", "events", "--force-history", "none.csv"], "none.csv"),
        (
            ["--method", "events", "--force-history", "none.csv", "--force", "1"],
            "--force-history replaces --force and --times",
        ),
    ],
)
def test_march_refuses(tmp_path, capsys, arguments, message):
    np.save(tmp_path / "heights.npy", np.eye(3))
    output = tmp_path / "kin.nc"
    assert cli.main(["march", str(tmp_path / "heights.npy"), "--spacing", "1", "-o", str(output), *arguments]) == 2
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1
    assert not output.exists()


@pytest.fixture
def pulses(tmp_path):
    """A force history with a ramp, a rest and a pulse; and a disc."""
    disc = self_affine_disc(0.6, 17, seed=1)
    np.save(tmp_path / "heights.npy", disc.heights)
    (tmp_path / "force.csv").write_text("time,force\n1,0\n2,1e0\n4,1\n5,0\n9,0\n9.5,6\n10,0\n")
    return disc, ["march", str(tmp_path / "heights.npy"), "--spacing", str(disc.spacing), "--viscosity", "4"]


@pytest.mark.parametrize(
    ("method", "tolerance"),
    [("events", 1e-9), ("implicit", 1e-5), ("explicit --overlap 1e-3", 5e-3), ("heun --overlap 1e-3", 5e-3)],
)
def test_march_under_a_force_history(tmp_path, pulses, method, tolerance):
    disc, command = pulses
    output = tmp_path / "kin.nc"
    history = ["--force-history", str(tmp_path / "force.csv")]
    assert cli.main([*command, "--method", *method.split(), *history, "-o", str(output)]) == 0
    ds = xr.load_dataset(output, decode_times=False)
    times, force = ds["time"].values, ds["force"].values
    np.testing.assert_array_equal(times, [1, 2, 4, 5, 9, 9.5, 10])
    np.testing.assert_array_equal(force, [0, 1, 1, 0, 0, 6, 0])
    impulse = np.array([0, 0.5, 2.5, 3, 3, 4.5, 6])
    depth = ds["depth"].values
    assert depth[0] == 0
    np.testing.assert_array_equal(depth[3], depth[4])  # at rest
    elastic = loading_path.indent(disc, tolerance=1e-11, depths=np.unique(depth[1:]))
    reached = np.unique(impulse[1:]) / 4
    np.testing.assert_allclose(elastic.force, reached, rtol=3 * tolerance)
    velocity = ds["velocity"].values
    np.testing.assert_array_equal(velocity[force == 0], 0)
    levels = np.searchsorted(reached, impulse[force > 0] / 4)
    np.testing.assert_allclose(velocity[force > 0], force[force > 0] / (4 * elastic.stiffness[levels]), rtol=0.02)


@pytest.mark.parametrize(
    ("history", "message"),
    [
        ("0,1\n1,-1\n", "sample 1 is -1.0; allowed: finite, 0 or more (without adhesion a pull opens the contact)"),
        ("1,1\n0,1\n", "each larger than the one before"),
        ("0,1\n0,1\n", "no time passes while there is a force"),
        ("0,0\n1,0\n", "no time passes while there is a force"),
        ("0\n1\n", "two columns, time and force"),
        ("0,1\n1,one\n", "not readable"),
    ],
)
def test_march_refuses_histories(tmp_path, pulses, capsys, history, message):
    _, command = pulses
    (tmp_path / "force.csv").write_text(history)
    output = tmp_path / "kin.nc"
    arguments = ["--method", "events", "--force-history", str(tmp_path / "force.csv"), "-o", str(output)]
    assert cli.main([*command, *arguments]) == 2
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1
    assert not output.exists()


def test_output_does_not_replace_the_force_history(tmp_path, pulses, capsys):
    _, command = pulses
    history, content = tmp_path / "force.csv", (tmp_path / "force.csv").read_text()
    (tmp_path / "link.csv").symlink_to(history)
    for name in ("force.csv", "link.csv"):
        arguments = ["--method", "events", "--force-history", str(history), "-o", str(tmp_path / name)]
        assert cli.main([*command, *arguments]) == 2
        assert "would replace the force history; another name is needed" in capsys.readouterr().err
        assert history.read_text() == content


def test_march_refuses_impulses_beyond_its_events(tmp_path, pulses, capsys):
    _, command = pulses
    arguments = ["--method", "events", "--until-fraction", "0.05", "--force-history", str(tmp_path / "force.csv")]
    assert cli.main([*command, *arguments, "-o", str(tmp_path / "kin.nc")]) == 2
    assert "is beyond the contact fraction at which events end; allowed: up to" in capsys.readouterr().err
