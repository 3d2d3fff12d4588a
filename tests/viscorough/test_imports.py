"""Packages that importing the library loads, names of its top level, and its use without the packages of the study."""

import json
import subprocess
import sys
import textwrap

import numpy as np
import pytest

from support.command_line import sphere_heights

STUDY_ONLY = ("matplotlib", "pandas", "snakemake", "viscorough_study", "xarray")
# As if these packages were not installed.
HIDE = f"import sys; sys.modules.update(dict.fromkeys({STUDY_ONLY!r})); "


def python(*arguments, **options):
    done = subprocess.run([sys.executable, *arguments], capture_output=True, text=True, check=False, **options)
    assert done.returncode == 0, done.stderr
    return done


def imported(script):
    """Top-level packages that a script imports, as reported by Python."""
    lines = python("-X", "importtime", "-c", script).stderr.splitlines()
    return {line.rsplit("|", 1)[1].strip().split(".")[0] for line in lines if line.startswith("import time:")}


def test_solver_imports_nothing_of_the_study():
    packages = imported("import viscorough; viscorough.indent")
    assert {"viscorough", "numpy", "numba"} <= packages
    assert not packages & set(STUDY_ONLY)


def test_package_imports_no_slow_package():
    assert not imported("import viscorough") & {*STUDY_ONLY, "numpy", "numba", "scipy", "netCDF4", "click"}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Heights and a loading curve, made without the packages of the study."""
    folder = tmp_path_factory.mktemp("alone")
    np.save(folder / "heights.npy", sphere_heights(9))
    viscorough(folder, "indent", "heights.npy", "--spacing", "1", "-o", "curve.nc")
    return folder


def viscorough(folder, *arguments):
    script = HIDE + "from viscorough.cli import main; sys.exit(main(sys.argv[1:]))"
    done = python("-c", script, *arguments, cwd=folder)
    assert done.stderr == ""
    return done.stdout


SIZE = ["--rms", "1", "--diameter", "9"]


@pytest.mark.parametrize(
    "arguments",
    [
        ["--help"],
        ["kinetics", "curve.nc", "--force", "1", "--viscosity", "1", "-o", "kinetics.nc"],
        ["march", "heights.npy", "--spacing", "1", "--method", "implicit", "--times", "1,2", "-o", "steps.nc"],
        ["generate", "--hurst", "0.8", "--elements", "9", *SIZE, "--seed", "1", "-o", "disc.nc"],
        ["estimate", "--hurst", "0.8", *SIZE, "--force", "1", "--viscosity", "1", "--times", "1", "-o", "law.csv"],
    ],
    ids=lambda arguments: arguments[0],
)
def test_command_line_needs_no_package_of_the_study(folder, arguments):
    assert viscorough(folder, *arguments)
    if "-o" in arguments:
        assert (folder / arguments[-1]).is_file()


def test_top_level_names_are_the_same_whatever_was_imported_before():
    """A module of the same name, which becomes an attribute of the package when imported, would hide a function."""
    script = textwrap.dedent("""
        import importlib, json, pkgutil, sys, viscorough
        if sys.argv[1:]:
            for module in pkgutil.walk_packages(viscorough.__path__, "viscorough."):
                importlib.import_module(module.name)
        assert set(viscorough.__all__) <= set(dir(viscorough))
        print(json.dumps({name: getattr(viscorough, name).__module__ for name in viscorough.__all__}))
    """)
    before, after = (json.loads(python("-c", script, *arguments).stdout) for arguments in ([], ["everything"]))
    assert before == after
    assert {"indent", "reduce", "kinetics", "penetration_law", "read_heights", "SolverOptions"} <= set(before)


def test_unknown_names_are_refused():
    import viscorough

    with pytest.raises(AttributeError, match="no attribute 'indentation'"):
        viscorough.indentation  # noqa: B018
