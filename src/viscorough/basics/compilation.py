"""Compile functions with numba, cache their code on disk, and defer interrupts while the compiler runs.

Compiled code is kept in the user's cache folder (~/.cache/viscorough), or in the folder that NUMBA_CACHE_DIR names. If
a file of the cache is damaged, its function is compiled again. If no file can be written, every process compiles the
functions again, and one line of the log states this. The cache serves only functions that are decorated with `njit` of
this module; numba itself and the functions of other packages are not changed.
"""

import contextlib
import functools
import gc
import logging
import pickle
import sys
import types
import uuid
from collections.abc import Callable, Iterator
from hashlib import sha256
from pathlib import Path
from typing import Any

import numba
import numpy as np
from numba.core import caching, config
from numba.core.compiler import CompileResult
from numba.core.dispatcher import Dispatcher
from numba.core.serialize import dumps
from numba.core.types import unliteral
from numba.misc.appdirs import AppDirs

from viscorough.basics.interrupts import uninterrupted


@functools.cache  # so that the message appears only once per process
def _announce_compilation() -> None:
    """Announce, on a terminal or in a notebook, that the first computation waits for the compiler."""
    if "ipykernel" in sys.modules or (sys.stderr is not None and sys.stderr.isatty()):
        print("viscorough: compiling once, which takes about 10 s", file=sys.stderr, flush=True)


class _Cache(caching.NullCache):
    """Cache of the compiled code of one function on disk, with one file for each combination of argument types.

    The name of a file contains a digest of everything that determines the code. All copies of the same source therefore
    share the files. If the function, or a function that it calls, is changed, the name of the file changes as well.
    """

    def __init__(self, compiled: Any) -> None:
        self._compiled = compiled

    @property
    def cache_path(self) -> str:
        folder = config.CACHE_DIR  # type: ignore[attr-defined]
        return folder or str(AppDirs("viscorough", appauthor=False).user_cache_dir)

    @functools.cached_property
    def _digest(self) -> str:
        # The digest is computed at the first call of the function: all functions that it calls are defined by then.
        content = sys.version_info[:2], numba.__version__, _content(self._compiled, ())
        return sha256(repr(content).encode()).hexdigest()

    def _file(self, argument_types: Any, processor: tuple[Any, ...]) -> Path:
        function, key = self._compiled.py_func, repr((self._digest, argument_types, processor))
        name = f"{function.__module__}.{function.__name__}-{sha256(key.encode()).hexdigest()[:32]}.pickle"
        return Path(self.cache_path, name)

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        target_context.refresh()
        file = self._file(sig, target_context.codegen().magic_tuple())
        try:
            stored = file.read_bytes()
        except OSError:  # usually the file does not exist yet
            _announce_compilation()
            return None
        try:
            with uninterrupted():
                return CompileResult._rebuild(target_context, *pickle.loads(stored))
        except Exception as error:  # a file that is incomplete, for example after a power failure, can raise any error
            text = "compiled code of %s in %s is damaged (%s): it is compiled again"
            logging.warning(text, self._compiled.py_func.__name__, file.parent, error)
            with contextlib.suppress(OSError):
                file.unlink()
            return None

    def save_overload(self, sig: Any, data: Any) -> None:
        # Code that contains addresses of this process cannot be cached.
        if data.lifted or data.library.has_dynamic_globals:
            return
        file = self._file(sig, data.codegen.magic_tuple())
        temporary = file.with_name(f"{file.name}.{uuid.uuid4().hex}")
        try:
            file.parent.mkdir(parents=True, exist_ok=True)
            try:
                temporary.write_bytes(dumps(data._reduce()))
                temporary.replace(file)
            finally:
                temporary.unlink(missing_ok=True)
        except OSError:  # for example because the disk is full
            _warn_cache_disabled()


def _content(value: Any, callers: tuple[Any, ...]) -> Any:
    """Return everything that determines the compiled code of a function, as nested tuples.

    value : function that `njit` decorates, or a value that such a function uses, such as an array or a module
    callers : compiled functions through whose calls `value` was reached. If `value` is one of them (a recursive call),
        only its name is returned
    """
    if isinstance(value, Dispatcher):
        function = value.py_func
        if value in callers:
            return function.__name__
        names = {name for code in _codes(function.__code__) for name in code.co_names} & set(function.__globals__)
        used = [(name, _content(function.__globals__[name], (*callers, value))) for name in sorted(names)]
        enclosed = [_content(cell.cell_contents, (*callers, value)) for cell in function.__closure__ or ()]
        options = sorted(value.targetoptions.items())
        return options, [_instructions(code, function.__doc__) for code in _codes(function.__code__)], used, enclosed
    if isinstance(value, np.ndarray):
        return value.dtype.str, value.shape, value.tobytes()
    if isinstance(value, types.ModuleType):
        return value.__name__
    if callable(value):  # a function or a class; only classes of named tuples have _fields
        return getattr(value, "__module__", ""), getattr(value, "__qualname__", ""), getattr(value, "_fields", ())
    return type(value).__name__, repr(value)


def _codes(code: types.CodeType) -> list[types.CodeType]:
    """Return a code object and all code objects nested in it."""
    return [code, *(each for const in code.co_consts if isinstance(const, types.CodeType) for each in _codes(const))]


def _instructions(code: types.CodeType, docstring: str | None) -> tuple[Any, ...]:
    """Return the instructions of a code object, with names and constants but without line numbers and docstring."""
    constants = [each for each in code.co_consts if not isinstance(each, types.CodeType) and each != docstring]
    return code.co_code, code.co_names, code.co_varnames, code.co_freevars, repr(constants)


@functools.cache  # so that the warning appears only once per process
def _warn_cache_disabled() -> None:
    logging.warning(
        "compiled code cannot be kept on disk, so every process compiles it again, which takes up to half a minute; "
        "set NUMBA_CACHE_DIR to a folder that is writable and has room"
    )


def njit(
    function: Callable[..., Any] | None = None, *, inner: bool = False, fastmath: bool = False, counted: bool = True
) -> Callable[..., Any]:
    """Decorate a function so that numba compiles it for the types of its arguments and caches the code on disk.

    All compiled functions release the interpreter's lock, and divide by zero without an error, as numpy does. These
    options are the same for all functions, because numba compiles its own functions, such as zeros, anew for each set
    of options, and for each type of number. Functions therefore store results in arrays that the caller passes, and
    allocate no scratch arrays: each kind of array would take 0.1 to 0.3 s to compile.

    inner : True if only other compiled functions call this function. Its code then becomes part of the code of these
        functions, and it is neither cached nor callable from Python. This saves half of the compile time of a short
        function
    fastmath : True if the compiler may reorder sums and assume that numbers are finite
    counted : False for an inner function that creates no array. Numba then does not count the references to the arrays
        of its arguments, which would take most of the time of short functions with many arrays
    """
    if function is None:
        return functools.partial(njit, inner=inner, fastmath=fastmath, counted=counted)
    options: dict[str, Any] = {"nogil": True, "error_model": "numpy", "fastmath": fastmath}
    options |= {"no_cfunc_wrapper": True, "no_cpython_wrapper": inner, "_nrt": counted}  # no function is called from C
    compiled: Any = numba.njit(function, **options)
    if compiled is function:  # numba compiles nothing if NUMBA_DISABLE_JIT is set
        return function
    if inner:

        def refuse(*arguments: Any, **options: Any) -> Any:
            raise TypeError(f"{function.__name__} can only be called by other compiled functions")

        # An inner function has no wrapper, so a call of its compiled code from Python would crash. Therefore numba is
        # not allowed to store this code, and a call from Python reaches `refuse`.
        compiled._compile_for_args, compiled._insert = refuse, lambda *arguments, **options: None
    else:
        compiled._cache = _Cache(compiled)
    compile_types = uninterrupted()(compiled.compile)

    def compile_once(argument_types: Any) -> Any:
        with _no_garbage_collection():
            # `unliteral` replaces the type of a literal number, such as 3, by a general type, such as int64. Otherwise
            # numba would compile the function again for each literal number in a call.
            return compile_types(tuple(map(unliteral, argument_types)))

    compiled.compile = compile_once
    return compiled


@contextlib.contextmanager
def _no_garbage_collection() -> Iterator[None]:
    """Pause Python's garbage collection within this context, because it would take a tenth of the compile time."""
    if not gc.isenabled():  # already paused while numba compiles a function that calls this function
        yield
        return
    gc.disable()
    try:
        yield
    finally:
        gc.enable()
