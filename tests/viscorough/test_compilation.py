"""Compiled functions of this package are protected, those of other packages are not affected."""

import os
import shutil
import signal
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest
from numba.core import event

import viscorough
from support.faults import no_privileges
from viscorough.compilation import njit
from viscorough.interrupts import uninterrupted

OTHER_PACKAGE = """
import numba

@numba.njit(cache=True)
def before(x):
    return x + 1

def define():
    @numba.njit(cache=True)
    def after(x):
        return x + 2
    return after

@numba.vectorize(["float64(float64)"], cache=True)
def elementwise(x):
    return x + 3
"""
USE_BOTH = """
import pickle, sys
from pathlib import Path
import numba.core.caching, numba.core.dispatcher, numba.np.ufunc.ufuncbuilder
ORIGINAL = numba.core.caching.FunctionCache, numba.core.caching.IndexDataCacheFile
COMPILE = numba.core.dispatcher.Dispatcher.compile
import other
import numpy as np
import viscorough
line = viscorough.Indenter(np.array([0.0, 1.0, 0.5]), 1.0)
assert viscorough.indent and viscorough.reduce(line).depth.size, "something of ours is compiled"
after = other.define()
assert (other.before(1.0), after(1.0), other.elementwise(1.0)) == (2, 3, 4)

assert numba.core.dispatcher.Dispatcher.compile is COMPILE
assert numba.core.caching.FunctionCache is numba.core.dispatcher.FunctionCache is ORIGINAL[0]
assert numba.np.ufunc.ufuncbuilder.FunctionCache is ORIGINAL[0]
for function in (other.before, after):
    assert (type(function._cache), type(function._cache._cache_file)) == ORIGINAL
    assert function.compile.__func__ is COMPILE
files = list(Path(sys.argv[1]).glob("**/other.*.nbc"))
assert len(files) == 3, files
for file in files:
    content = file.read_bytes()
    with file.open("rb") as opened:
        pickle.load(opened)
        assert opened.tell() == len(content), "a file of another package ends with more than numba writes"
"""


def run(script, *arguments, **environment):
    options = {"capture_output": True, "text": True, "check": False, "env": os.environ | environment}
    done = subprocess.run([sys.executable, "-c", script, *map(str, arguments)], **options)
    assert done.returncode == 0, done.stderr
    return done


def test_compiled_functions_of_other_packages_are_left_alone(tmp_path):
    (tmp_path / "other.py").write_text(OTHER_PACKAGE)
    for _ in range(2):  # compiled, then loaded
        run(USE_BOTH, tmp_path, PYTHONPATH=str(tmp_path), NUMBA_CACHE_DIR=str(tmp_path / "cache"))


def test_function_without_a_source_file_is_compiled_without_a_cache():
    """numba itself refuses to compile such a function with a cache."""
    script = textwrap.dedent("""
        from viscorough.compilation import njit
        assert njit(lambda x: x + 1)(1.0) == 2
    """)
    assert run(script).stderr == ""


SPHERE = """
import numpy as np, viscorough
line = viscorough.Indenter(np.array([0.0, 1.0, 0.5]), 1.0)
print(viscorough.reduce(line).force[-1])
"""
# The only folder that numba then considers lies below a file: nobody can write there, not even root.
NOWHERE = {"NUMBA_CACHE_LOCATOR_CLASSES": "UserProvidedCacheLocator", "NUMBA_CACHE_DIR": f"{__file__}/cache"}
NO_ROOM = "import resource; resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))"


def test_without_a_folder_for_compiled_code_it_is_compiled_with_one_line_about_it():
    done = run(SPHERE, **NOWHERE)
    assert done.stdout == run(SPHERE).stdout
    assert len(done.stderr.splitlines()) == 1, done.stderr
    assert "compiled code cannot be kept on disk" in done.stderr
    assert "set NUMBA_CACHE_DIR to a folder that is writable" in done.stderr


def test_full_disk_for_compiled_code_is_one_line(tmp_path):
    done = run(NO_ROOM + SPHERE, NUMBA_CACHE_DIR=str(tmp_path))
    assert done.stdout == run(SPHERE).stdout
    assert len(done.stderr.splitlines()) == 1, done.stderr
    assert "compiled code cannot be kept on disk" in done.stderr


def test_package_and_home_that_may_not_be_written(tmp_path):
    """As in a container that runs under the number of a user whom it does not know."""
    ignore = shutil.ignore_patterns("__pycache__")
    shutil.copytree(Path(viscorough.__file__).parent, tmp_path / "viscorough", ignore=ignore)
    for folder in (tmp_path, *tmp_path.rglob("")):
        folder.chmod(0o555)
    environment = os.environ | {"PYTHONPATH": str(tmp_path), "HOME": str(tmp_path), "PYTHONDONTWRITEBYTECODE": "1"}
    environment.pop("NUMBA_CACHE_DIR", None)
    environment.pop("XDG_CACHE_HOME", None)
    command = [*no_privileges(), sys.executable, "-c", f"{SPHERE}print(viscorough.__file__)"]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines()[1].startswith(str(tmp_path))
    assert [line for line in done.stderr.splitlines() if "cannot be kept" in line] == done.stderr.splitlines()
    assert done.stderr


def test_functions_run_without_compilation_where_numba_is_disabled():
    script = "from viscorough.compilation import njit; assert njit(fastmath=True)(lambda x: x + 1)(1) == 2"
    run(script, NUMBA_DISABLE_JIT="1")


def test_functions_are_kept_on_disk(tmp_path):
    (tmp_path / "ours.py").write_text(
        "from viscorough.compilation import njit\n@njit(fastmath=True)\ndef double(x):\n    return 2 * x\n"
    )
    script = "import ours; assert ours.double(2.0) == 4; print(sum(ours.double.stats.cache_hits.values()))"
    options = {"PYTHONPATH": str(tmp_path), "NUMBA_CACHE_DIR": str(tmp_path / "cache")}
    assert [run(script, **options).stdout for _ in range(2)] == ["0\n", "1\n"]


class Interrupt(event.Listener):
    """Interrupts this process whenever numba starts to compile a function."""

    def on_start(self, event):
        os.kill(os.getpid(), signal.SIGINT)

    def on_end(self, event):
        pass


@pytest.fixture
def interrupts_raise():
    """SIGINT raises KeyboardInterrupt, also where the tests were started in the background, which ignores it."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def test_interrupt_waits_for_the_compiler(interrupts_raise):
    function = njit(eval("lambda x: x + 1"))  # without a source file, so that it is not loaded from a cache
    with pytest.raises(KeyboardInterrupt), event.install_listener("numba:compile", Interrupt()):
        function(1.0)
    assert len(function.signatures) == 1, "compiled to the end"
    assert function(1.0) == 2


def test_interrupt_waits_for_the_end_of_a_block(interrupts_raise):
    done = []

    def block():
        with uninterrupted(), uninterrupted():
            os.kill(os.getpid(), signal.SIGINT)
            done.append("first")
            done.append("last")

    handler = signal.getsignal(signal.SIGINT)
    with pytest.raises(KeyboardInterrupt):
        block()
    assert done == ["first", "last"]
    assert signal.getsignal(signal.SIGINT) is handler
