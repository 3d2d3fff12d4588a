"""Name the folder in which numba keeps the compiled code of these sources. This module does not import numba."""

import functools
import os
from hashlib import sha256
from importlib.metadata import version
from pathlib import Path

_PACKAGE = Path(__file__).parents[1]


@functools.cache
def code_folder() -> Path:
    """Return the folder for the compiled code of these sources and this version of numba, which may not exist yet.

    It lies below the folder that NUMBA_CACHE_DIR names, or below the user's cache folder (~/.cache/viscorough). numba
    compiles a function again if its own file has changed, but does not notice changes of the functions and constants
    that it imports from other files. Therefore each state of the sources has a folder, whose name is a digest of all
    files that contain the word njit. A module that defines constants or types of compiled functions contains this word,
    too.
    """
    digest = sha256(version("numba").encode())
    for path in sorted(_PACKAGE.rglob("*.py")):
        source = path.read_bytes()
        if b"njit" in source:
            digest.update(source)
    caches = os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")
    return Path(os.environ.get("NUMBA_CACHE_DIR") or Path(caches, "viscorough"), digest.hexdigest()[:16])
