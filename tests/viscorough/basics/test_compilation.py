"""Compiled code is stored safely, and the functions of other packages are not affected."""

import ast
import shutil
from pathlib import Path

import pytest

import viscorough
from support.command_line import python

PACKAGE = Path(viscorough.__file__).parent


SPHERE = """
import numpy as np, viscorough
line = viscorough.Indenter(np.array([0.0, 1.0, 0.5]), 1.0)
print(viscorough.reduce(line).force[-1])
"""
# A folder below a file: nobody can write there, not even root.
NOWHERE = {"NUMBA_CACHE_DIR": f"{__file__}/cache"}
NO_ROOM = "import resource; resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))"


@pytest.mark.parametrize("before", ["", NO_ROOM], ids=["no folder", "full disk"])
def test_unwritable_cache_is_reported_in_one_line(before, tmp_path):
    done = python("-c", before + SPHERE, **({"NUMBA_CACHE_DIR": str(tmp_path)} if before else NOWHERE))
    assert float(done.stdout) > 0
    assert len(done.stderr.splitlines()) == 1, done.stderr
    assert "compiled code cannot be kept on disk" in done.stderr
    assert "set NUMBA_CACHE_DIR to a folder that is writable" in done.stderr


# `first_decrease` calls the function `decay` of another file.
DECREASE = """
from viscorough.media.kinds import KelvinVoigt
from viscorough.media.load import Load
from viscorough.viscous.crossing import first_decrease
load = Load([0, 1, 2], force=[0, 1, 0])
print(first_decrease(KelvinVoigt(1.0, 1.0).spectrum(load), load.time, load.force))
"""


@pytest.mark.long
def test_changes_in_called_functions_of_other_files_are_noticed(tmp_path):
    shutil.copytree(PACKAGE, tmp_path / "viscorough", ignore=shutil.ignore_patterns("__pycache__"))
    called = tmp_path / "viscorough/media/creep_response.py"
    environment = {"PYTHONPATH": str(tmp_path), "NUMBA_CACHE_DIR": str(tmp_path / "cache")}
    times = [float(python("-c", DECREASE, **environment).stdout)]
    called.write_text(called.read_text().replace("_KEPT_FROM = 1.0", "_KEPT_FROM = 0.0").replace("(-x)", "(-0.5 * x)"))
    times.append(float(python("-c", DECREASE, **environment).stdout))
    assert times[0] != times[1]


def test_digest_covers_constants_of_compiled_functions():
    """The folder of compiled code depends on each file from which a compiled function imports a name."""
    for path in PACKAGE.rglob("*.py"):
        tree = ast.parse(path.read_text())
        compiled = [
            node
            for node in tree.body
            if isinstance(node, ast.FunctionDef) and any("njit" in ast.dump(each) for each in node.decorator_list)
        ]
        used = {name.id for node in compiled for name in ast.walk(node) if isinstance(name, ast.Name)}
        for node in tree.body:
            if isinstance(node, ast.ImportFrom) and node.module.startswith("viscorough."):
                source = PACKAGE.joinpath(*node.module.split(".")[1:]).with_suffix(".py")
                names = used & {each.asname or each.name for each in node.names}
                assert not names or "njit" in source.read_text(), f"{path}: {names}, {source}"
