"""Packages that importing the library loads, and names of its top level."""

import json
import subprocess
import sys
import textwrap

import pytest

STUDY_ONLY = ("matplotlib", "pandas", "snakemake", "viscorough_study", "xarray")


def python(*arguments):
    done = subprocess.run([sys.executable, *arguments], capture_output=True, text=True, check=False)
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
