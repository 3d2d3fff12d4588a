"""Cache compiled functions on disk; incomplete cache files are no error, and interrupts wait for the compiler.

numba caches compiled code next to the modules (or in NUMBA_CACHE_DIR). If a file of functions compiled here cannot be
loaded, the function is compiled again. If the cache cannot be written, functions are compiled in every process, and one
line says so. Only these functions are affected, not numba itself or functions of other packages.
"""

import contextlib
import functools
import gc
import logging
import sys
from collections.abc import Callable, Iterator
from typing import Any

import numba
from numba.core import caching
from numba.core.types import unliteral

from viscorough.interrupts import uninterrupted


@functools.cache  # once per process
def _announce_compilation() -> None:
    """Announce on a terminal or in a notebook why the first computation takes longer."""
    if "ipykernel" in sys.modules or (sys.stderr is not None and sys.stderr.isatty()):
        print("viscorough: compiling once, which takes about 10 s", file=sys.stderr, flush=True)


class _Cache(caching.FunctionCache):
    def load_overload(self, sig: Any, target_context: Any) -> Any:
        try:
            with uninterrupted():
                if (loaded := super().load_overload(sig, target_context)) is None:
                    _announce_compilation()
                return loaded
        except Exception as error:  # reading a truncated file can fail in any way
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
        "compiled code cannot be kept on disk, so every process compiles it again, which takes up to half a minute; "
        "set NUMBA_CACHE_DIR to a folder that is writable and has room"
    )


def njit(
    function: Callable[..., Any] | None = None, *, inner: bool = False, fastmath: bool = False
) -> Callable[..., Any]:
    """Compile a function for the types of its arguments, and cache it on disk. Use as a decorator.

    All functions release the interpreter's lock, and divide by zero without an error, as numpy does. They share these
    options because numba compiles what it provides (zeros, for example) once more for each set of options.

    inner : whether only other compiled functions call it, which contain its code: it is neither cached nor callable
        from Python, which saves half the time that a short function takes to compile
    fastmath : whether the compiler may reorder sums and assume that numbers are finite
    """
    if function is None:
        return functools.partial(njit, inner=inner, fastmath=fastmath)
    options: dict[str, Any] = {"nogil": True, "error_model": "numpy", "fastmath": fastmath}
    options |= {"no_cfunc_wrapper": True, "no_cpython_wrapper": inner}  # no function is called from C
    compiled: Any = numba.njit(function, **options)
    if compiled is function:  # NUMBA_DISABLE_JIT is set
        return function
    if not inner:
        try:
            compiled._cache = _Cache(function)
        except RuntimeError:  # numba finds no writable folder for it
            _warn_cache_disabled()
    compile_types = uninterrupted()(compiled.compile)

    def compile_once(types: Any) -> Any:
        # A number that a caller passes as it stands in the source needs no variant of its own.
        with _no_garbage_collection():
            return compile_types(tuple(map(unliteral, types)))

    compiled.compile = compile_once
    return compiled


@contextlib.contextmanager
def _no_garbage_collection() -> Iterator[None]:
    """Pause the search for unreachable objects, which takes a tenth of the time that the compiler takes."""
    if not gc.isenabled():  # in a function that another one calls
        yield
        return
    gc.disable()
    try:
        yield
    finally:
        gc.enable()
