"""Compiled code is stored safely, and the functions of other packages are not affected."""

import ast
import fcntl
import os
import shutil
import signal
from pathlib import Path

import numba
import numpy as np
import pytest
from numba.core import event

import viscorough
from support.command_line import python
from viscorough.basics import compilation
from viscorough.basics.compilation import njit
from viscorough.contact.grid import kernels

PACKAGE = Path(viscorough.__file__).parent


def test_compiled_functions_of_other_packages_are_stored_elsewhere():
    def function(x):
        return x + 1

    ours, theirs = njit(function), numba.njit(function, cache=True)
    assert ours.stats.cache_path.startswith(str(compilation._folder()))
    assert not theirs.stats.cache_path.startswith(str(compilation._folder()))


def test_functions_run_if_numba_is_disabled():
    script = "from viscorough.basics.compilation import njit; assert njit(fastmath=True)(lambda x: x + 1)(1.0) == 2"
    assert python("-c", script, NUMBA_DISABLE_JIT="1").stderr == ""


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


@pytest.fixture
def empty_cache(tmp_path, monkeypatch):
    """Let functions that are decorated during the test be stored in an empty folder; return the folder."""
    monkeypatch.setattr("numba.core.config.CACHE_DIR", str(tmp_path))
    compilation._folder.cache_clear()
    yield compilation._folder()
    compilation._folder.cache_clear()


class TryLock(event.Listener):
    """Record, at each event, whether another process could now store code."""

    def __init__(self, folder):
        self._path, self.could_store = folder / "lock", []

    def on_start(self, event):
        pass

    def on_end(self, event):
        with self._path.open("w") as file:
            try:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                self.could_store.append(False)
            else:
                self.could_store.append(True)


def test_one_process_at_a_time_stores_code(empty_cache):
    """From the end of a compilation until numba has stored the code, other processes have to wait."""
    function = njit(kernels.total.py_func)
    compiled, stored = TryLock(empty_cache), TryLock(empty_cache)
    with event.install_listener("numba:compile", compiled), event.install_listener("numba:compiler_lock", stored):
        assert function(field=np.arange(3.0), places=np.arange(3)) == 3
    assert list(empty_cache.glob("*/*.nbi"))
    assert compiled.could_store[-1] is False
    assert stored.could_store[-1] is True


class Interrupt(event.Listener):
    """Interrupt this process whenever numba starts to compile a function."""

    def on_start(self, event):
        os.kill(os.getpid(), signal.SIGINT)

    def on_end(self, event):
        pass


@pytest.fixture
def interrupts_raise():
    """Let SIGINT raise KeyboardInterrupt, also in a background process, which ignores it by default."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def test_interrupt_waits_for_the_compiler(interrupts_raise, empty_cache):
    function = njit(lambda x: x + 1)
    with pytest.raises(KeyboardInterrupt), event.install_listener("numba:compile", Interrupt()):
        function(1.0)
    assert len(function.signatures) == 1, "compiled to the end"
    assert function(1.0) == 2
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_compilation_is_announced_on_terminals(tmp_path):
    terminal = "import sys; sys.stderr.isatty = lambda: True" + SPHERE
    for expected in ("viscorough: compiling once, which takes about 10 s\n", ""):
        assert python("-c", terminal, NUMBA_CACHE_DIR=str(tmp_path)).stderr == expected
