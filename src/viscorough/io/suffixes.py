"""List the allowed suffixes of output files, {suffix: kind of file}, and check a suffix before a computation."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:  # importing `types` at run time would import numpy, which takes long
    from viscorough.basics.types import FilePath

RESULTS = {".nc": "NetCDF", ".csv": "table"}
MAPS = {".nc": "NetCDF"}
FIGURES = {".png": "picture", ".pdf": "drawing", ".svg": "drawing"}


def check_suffix(path: FilePath, allowed: Mapping[str, str]) -> str:
    """Return the suffix of a file in lower case. Raises ValueError unless it is allowed.

    allowed : {suffix: kind of file}, such as RESULTS
    """
    suffix = Path(path).suffix.lower()
    if suffix not in allowed:
        kinds = ", ".join(f"{suffix} ({kind})" for suffix, kind in allowed.items())
        raise ValueError(f"{path}: unknown kind of file; allowed: {kinds}")
    return suffix
