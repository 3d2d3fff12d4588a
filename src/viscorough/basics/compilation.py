"""Compile functions with numba, and keep the compiled code on disk.

numba stores the code of each function in the folder of these sources (basics.compiled_code). If no file can be written
there, every process compiles the functions again, and one line of the log states this. Only the public interface of
numba is used: options of its decorators, its configuration, and its events.
"""

import contextlib
import fcntl
import functools
import gc
import logging
import sys
import tempfile
import threading
from collections.abc import Callable
from pathlib import Path
from typing import IO, Any

import numba
from numba.core import config, event
from numba.extending import register_jitable

from viscorough.basics.compiled_code import code_folder

# Compiled code is kept on disk only if the disk has room for this many bytes, about the code of a command. Otherwise
# numba would raise an error when it stores the code of a function.
_ROOM = 2_000_000


def njit(
    function: Callable[..., Any] | None = None, *, inner: bool = False, fastmath: bool = False, counted: bool = True
) -> Callable[..., Any]:
    """Decorate a function so that numba compiles it for the types of its arguments and keeps the code on disk.

    All compiled functions release the interpreter's lock, and divide by zero without an error, as numpy does. These
    options are the same for all functions, because numba compiles its own functions, such as zeros, anew for each set
    of options, and for each type of number. Functions therefore store results in arrays that the caller passes, and
    allocate no scratch arrays: each kind of array would take 0.1 to 0.3 s to compile.

    inner : True if other compiled functions call this function. Its code then becomes part of the code of these
        functions, which halves the compile time of a short function. Called from Python, it runs without compilation
    fastmath : True if the compiler may reorder sums and assume that numbers are finite
    counted : False for an inner function that creates no array. Numba then does not count the references to the arrays
        of its arguments, which would take most of the time of short functions with many arrays
    """
    if function is None:
        return functools.partial(njit, inner=inner, fastmath=fastmath, counted=counted)
    options: dict[str, Any] = {"nogil": True, "error_model": "numpy", "fastmath": fastmath}
    options["no_cfunc_wrapper"] = True  # no function is called from C
    if inner:
        return register_jitable(_nrt=counted, **options)(function)
    folder = _writable_folder()
    if folder is None:
        return numba.njit(function, **options)
    users_folder = config.CACHE_DIR  # type: ignore[attr-defined]
    config.CACHE_DIR = str(folder)  # type: ignore[attr-defined]  # numba reads it when it decorates a function
    try:
        return numba.njit(function, cache=True, **options)
    finally:
        config.CACHE_DIR = users_folder  # type: ignore[attr-defined]


@functools.cache
def _writable_folder() -> Path | None:
    """Make the folder of the compiled code; return None if it cannot be written."""
    folder = code_folder()
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder) as file:
            file.write(bytes(_ROOM))
    except OSError:
        logging.warning(
            "compiled code cannot be kept on disk, so every process compiles it again, which takes up to half a "
            "minute; set NUMBA_CACHE_DIR to a folder that is writable and has room"
        )
        return None
    return folder


@functools.cache  # so that the message appears only once per process
def _announce_compilation() -> None:
    """Announce, on a terminal or in a notebook, that the first computation waits for the compiler."""
    if "ipykernel" in sys.modules or (sys.stderr is not None and sys.stderr.isatty()):
        print("viscorough: compiling once, which takes about 10 s", file=sys.stderr, flush=True)


class _Compilation(event.Listener):
    """Listener that announces the compiler, lets one process at a time store code, and defers garbage collection.

    numba stores code after the end of a compilation, in two files: an index of the types of arguments, and the code. If
    two processes stored code for different types at the same time, the index of one process could lead to the code of
    the other. Therefore a file is locked from the end of a compilation until numba releases its own lock. Garbage
    collection would take a tenth of the time in which numba compiles or loads code.
    """

    def __init__(self) -> None:
        self._file: IO[str] | None = None
        self._depth, self._collects = 0, False

    def on_start(self, event: event.Event) -> None:
        if event.kind == "numba:compiler_lock" and threading.current_thread() is threading.main_thread():
            if self._depth == 0:
                self._collects = gc.isenabled()
                gc.disable()
            self._depth += 1
        elif _is_ours(event):
            _announce_compilation()

    def on_end(self, event: event.Event) -> None:
        if event.kind == "numba:compiler_lock":
            if self._file:
                self._file.close()
            self._file = None
            if threading.current_thread() is threading.main_thread():
                self._depth -= 1
                if self._depth == 0 and self._collects:
                    gc.enable()
        elif not self._file and _is_ours(event) and (folder := _writable_folder()):
            with contextlib.suppress(OSError):  # for example if the file system has no locks
                self._file = (folder / "lock").open("w")
                fcntl.flock(self._file, fcntl.LOCK_EX)


def _is_ours(event: event.Event) -> bool:
    """Return True if a function of this package is compiled."""
    is_compilation = event.kind == "numba:compile"
    return is_compilation and str(event.data["dispatcher"].py_func.__module__).startswith("viscorough.")


_compilation = _Compilation()
event.register("numba:compile", _compilation)
event.register("numba:compiler_lock", _compilation)
