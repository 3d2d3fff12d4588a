"""Compiled functions cached on disk: incomplete cache files are no error, and an interrupt waits for the compiler.

numba caches compiled code beside the modules (or in NUMBA_CACHE_DIR). Where a file of functions that are compiled here
cannot be loaded, the function is compiled again. Where nothing can be kept on disk, functions are compiled in every
process, and one line says so. Only these functions are affected, not numba itself or functions of other packages.
"""

import contextlib
import functools
import logging
import sys
from collections.abc import Callable
from typing import Any

import numba
from numba.core import caching

from viscorough.interrupts import uninterrupted


@functools.cache  # once per process
def _announce_compilation() -> None:
    """Tell those who wait at a terminal or a notebook why the first computation takes longer."""
    if "ipykernel" in sys.modules or (sys.stderr is not None and sys.stderr.isatty()):
        print("viscorough: compiling once, which takes about 20 s", file=sys.stderr, flush=True)


class _Cache(caching.FunctionCache):
    def load_overload(self, sig: Any, target_context: Any) -> Any:
        try:
            with uninterrupted():
                if (loaded := super().load_overload(sig, target_context)) is None:
                    _announce_compilation()
                return loaded
        except Exception as error:  # reading a file that a power failure cut off can fail in any way
            text = "compiled code of %s in %s is damaged (%s): it is compiled again"
            logging.warning(text, self._py_func.__name__, self.cache_path, error)
            with contextlib.suppress(OSError):
                self.flush()
            return None

    def save_overload(self, sig: Any, data: Any) -> None:
        try:
            super().save_overload(sig, data)
        except OSError:  # a full disk, for example
            _warn_cache_disabled()


@functools.cache  # once per process
def _warn_cache_disabled() -> None:
    logging.warning(
        "compiled code cannot be kept on disk, so every process compiles it again, which takes up to a minute; "
        "set NUMBA_CACHE_DIR to a folder that is writable and has room"
    )


def njit(function: Callable[..., Any] | None = None, **options: Any) -> Callable[..., Any]:
    """numba.njit with the given options, cached on disk. Use as a decorator, with or without options."""
    if function is None:
        return functools.partial(njit, **options)
    compiled: Any = numba.njit(function, **options)
    if compiled is function:  # NUMBA_DISABLE_JIT is set
        return function
    try:
        compiled._cache = _Cache(function)
    except RuntimeError:  # numba finds no writable folder for it
        _warn_cache_disabled()
    compiled.compile = uninterrupted()(compiled.compile)
    return compiled
