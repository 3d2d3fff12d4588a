"""Compiled functions, kept on disk: what is damaged there is compiled again, and neither stops nor misleads a run.

numba keeps compiled code beside the modules (or in NUMBA_CACHE_DIR) and trusts what it finds. Here every file ends with
its SHA-256 sum, which numba's own reader passes over.
"""

import functools
import logging
from hashlib import sha256
from pathlib import Path

import numba
from numba.core import caching, dispatcher
from numba.np.ufunc import ufuncbuilder

_SUM = sha256().digest_size


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
            return super().load_overload(sig, target_context)
        except Exception as error:  # unpickling and linking damaged bytes can fail in any way
            about = self._py_func.__name__, self.cache_path, error
            logging.warning("compiled code of %s in %s is damaged (%s): it is compiled again", *about)
            self.flush()
            return None


# numba has no other way to choose how files are read. Compiled functions of other packages in the process, whose files
# have no sum, are compiled once more.
dispatcher.FunctionCache = ufuncbuilder.FunctionCache = _Cache

njit = functools.partial(numba.njit, cache=True)
vectorize = functools.partial(numba.vectorize, cache=True)
