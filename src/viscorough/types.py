"""Abbreviations for annotations."""

import os
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Integers = NDArray[np.int64]
Mask = NDArray[np.bool_]
FilePath = str | os.PathLike[str]
Progress = Callable[[float], object]  # called with the share of the work that is done
