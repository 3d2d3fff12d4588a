"""Compiled functions of this package are protected, those of other packages are not affected."""

import os
import signal

import numba
import pytest
from numba.core import caching, event

from support.command_line import python
from viscorough.basics.compilation import njit


def test_compiled_functions_of_other_packages_are_left_alone():
    def function(x):
        return x + 1

    ours, theirs = njit(function), numba.njit(function, cache=True)
    for owned, original in ((ours, False), (theirs, True)):
        assert (type(owned._cache) is caching.FunctionCache) == original
        assert (getattr(owned.compile, "__func__", None) is numba.core.dispatcher.Dispatcher.compile) == original


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


KERNELS = {
    "parts.py": """
from viscorough.basics.compilation import njit
FACTOR = 2
@njit(inner=True)
def scaled(x):
    return FACTOR * x
""",
    "whole.py": """
from parts import scaled
from viscorough.basics.compilation import njit
@njit
def more(x):
    return scaled(x) + 1
""",
}


# Prints, for each folder, the result of its function and the number of files in the cache.
RESULTS = """
import os, sys
for folder in sys.argv[1:]:
    sys.path.insert(0, folder)
    import whole
    print(whole.more(3), len(os.listdir(os.environ["NUMBA_CACHE_DIR"])))
    sys.path.remove(folder)
    del sys.modules["whole"], sys.modules["parts"]
"""


@pytest.mark.long
def test_copies_of_a_source_share_compiled_code_and_changes_are_noticed(tmp_path):
    def results(**changes):
        """Return the results of changed copies, which one new process computes."""
        for folder, change in changes.items():
            (tmp_path / folder).mkdir()
            for name, text in KERNELS.items():
                (tmp_path / folder / name).write_text(text.replace(*change))
        folders = [str(tmp_path / folder) for folder in changes]
        done = python("-c", RESULTS, *folders, NUMBA_CACHE_DIR=str(tmp_path / "cache"))
        return [tuple(map(int, line.split())) for line in done.stdout.splitlines()]

    assert results(first=("", "")) == [(7, 1)]
    changed = results(
        copy=("", ""),
        comment=("import njit", "import njit  # a decorator"),
        constant=("FACTOR = 2", "FACTOR = 5"),
        called=("FACTOR * x", "FACTOR - x"),
        option=("(inner=True)", "(inner=True, fastmath=True)"),
    )
    assert changed == [(7, 1), (7, 1), (16, 2), (0, 3), (7, 4)]


def test_inner_functions_are_refused_in_python_whether_compiled_or_not():
    inner = njit(inner=True)(eval("lambda x: 2 * x"))
    outer = numba.njit(lambda x: inner(x) + 1)
    for _ in range(2):
        with pytest.raises(TypeError, match="can only be called by other compiled functions"):
            inner(3)
        assert outer(3) == 7


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


def test_interrupt_waits_for_the_compiler(interrupts_raise, tmp_path, monkeypatch):
    monkeypatch.setattr("numba.core.config.CACHE_DIR", str(tmp_path))
    function = njit(lambda x: x + 1)
    with pytest.raises(KeyboardInterrupt), event.install_listener("numba:compile", Interrupt()):
        function(1.0)
    assert len(function.signatures) == 1, "compiled to the end"
    assert function(1.0) == 2
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_compilation_is_announced_on_terminals(tmp_path):
    (tmp_path / "script.py").write_text(
        "import sys\n"
        "sys.stderr.isatty = lambda: True\n"
        "from viscorough.basics.compilation import njit\n"
        "@njit\ndef one(x):\n    return x + 1\n"
        "@njit\ndef two(x):\n    return x + 2\n"
        "assert one(1) + two(1) == 5\n"
    )
    for expected in ("viscorough: compiling once, which takes about 10 s\n", ""):
        done = python(str(tmp_path / "script.py"), NUMBA_CACHE_DIR=str(tmp_path / "cache"))
        assert done.stderr == expected
