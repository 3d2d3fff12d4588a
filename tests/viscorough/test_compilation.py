"""Compiled functions of this package are protected, those of other packages are not affected."""

import os
import signal

import numba
import pytest
from numba.core import caching, event

from support.command_line import python
from viscorough.compilation import njit


def test_compiled_functions_of_other_packages_are_left_alone():
    def function(x):
        return x + 1

    ours, theirs = njit(function), numba.njit(function, cache=True)
    for owned, original in ((ours, False), (theirs, True)):
        assert (type(owned._cache) is caching.FunctionCache) == original
        assert (getattr(owned.compile, "__func__", None) is numba.core.dispatcher.Dispatcher.compile) == original


def test_functions_run_if_numba_is_disabled():
    script = "from viscorough.compilation import njit; assert njit(fastmath=True)(lambda x: x + 1)(1.0) == 2"
    assert python("-c", script, NUMBA_DISABLE_JIT="1").stderr == ""


SPHERE = """
import numpy as np, viscorough
line = viscorough.Indenter(np.array([0.0, 1.0, 0.5]), 1.0)
print(viscorough.reduce(line).force[-1])
"""
# The only folder that numba considers then is below a file, so nobody can write there, not even root.
NOWHERE = {"NUMBA_CACHE_LOCATOR_CLASSES": "UserProvidedCacheLocator", "NUMBA_CACHE_DIR": f"{__file__}/cache"}
NO_ROOM = "import resource; resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))"


@pytest.mark.parametrize("before", ["", NO_ROOM], ids=["no folder", "full disk"])
def test_unwritable_cache_is_reported_in_one_line(before, tmp_path):
    done = python("-c", before + SPHERE, **({"NUMBA_CACHE_DIR": str(tmp_path)} if before else NOWHERE))
    assert float(done.stdout) > 0
    assert len(done.stderr.splitlines()) == 1, done.stderr
    assert "compiled code cannot be kept on disk" in done.stderr
    assert "set NUMBA_CACHE_DIR to a folder that is writable" in done.stderr


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


def test_interrupt_waits_for_the_compiler(interrupts_raise):
    function = njit(eval("lambda x: x + 1"))  # without a source file, so it is not loaded from a cache
    with pytest.raises(KeyboardInterrupt), event.install_listener("numba:compile", Interrupt()):
        function(1.0)
    assert len(function.signatures) == 1, "compiled to the end"
    assert function(1.0) == 2
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_compilation_is_announced_on_terminals(tmp_path):
    (tmp_path / "script.py").write_text(
        "import sys\n"
        "sys.stderr.isatty = lambda: True\n"
        "from viscorough.compilation import njit\n"
        "@njit\ndef one(x):\n    return x + 1\n"
        "@njit\ndef two(x):\n    return x + 2\n"
        "assert one(1) + two(1) == 5\n"
    )
    for expected in ("viscorough: compiling once, which takes about 10 s\n", ""):
        done = python(str(tmp_path / "script.py"), NUMBA_CACHE_DIR=str(tmp_path / "cache"))
        assert done.stderr == expected
