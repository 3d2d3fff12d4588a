"""Compiled functions, kept on disk: what is damaged there is compiled again, and neither stops nor misleads a run.

numba keeps compiled code beside the modules (or in NUMBA_CACHE_DIR) and trusts what it finds. Here every file ends with
its SHA-256 sum, which numba's own reader passes over.
"""

import contextlib
import functools
import logging
import signal
import threading
from hashlib import sha256
from pathlib import Path

import numba
from numba.core import caching, dispatcher
from numba.np.ufunc import ufuncbuilder

_SUM = sha256().digest_size


@contextlib.contextmanager
def uninterrupted():
    """Let an interrupt wait: in LLVM's callbacks into Python it would be lost, or crash the process, as it does where a
    compiled function that was interrupted hands over its results.
    """
    if threading.current_thread() is not threading.main_thread():  # to which interrupts never come
        yield
        return
    arrived = []
    before = signal.signal(signal.SIGINT, lambda *arguments: arrived.append(arguments))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
        if arrived and callable(before):
            before(*arrived[-1])


def _compile(self, sig, compile=dispatcher.Dispatcher.compile):
    with uninterrupted():
        return compile(self, sig)


class _File(caching.IndexDataCacheFile):
    def _dump(self, obj):
        dumped = super()._dump(obj)
        return dumped + sha256(dumped).digest()

    def _load_data(self, name):
        content = Path(self._data_path(name)).read_bytes()
        if sha256(content[:-_SUM]).digest() != content[-_SUM:]:
            raise ValueError(f"{name} is not what was written")
        return super()._load_data(name)


class _Cache(caching.FunctionCache):
    def __init__(self, py_func):
        super().__init__(py_func)
        self._cache_file.__class__ = _File

    def load_overload(self, sig, target_context):
        try:
            with uninterrupted():
                return super().load_overload(sig, target_context)
        except Exception as error:  # unpickling and linking damaged bytes can fail in any way
            about = self._py_func.__name__, self.cache_path, error
            logging.warning("compiled code of %s in %s is damaged (%s): it is compiled again", *about)
            self.flush()
            return None


# numba has no other way to choose how files are read. Compiled functions of other packages in the process, whose files
# have no sum, are compiled once more.
dispatcher.FunctionCache = ufuncbuilder.FunctionCache = _Cache
dispatcher.Dispatcher.compile = _compile

njit = functools.partial(numba.njit, cache=True)


def vectorize(signatures):
    """numba.vectorize, which compiles or loads at once, kept on disk."""
    decorator = numba.vectorize(signatures, cache=True)

    def decorated(function):
        with uninterrupted():
            return decorator(function)

    return decorated
