"""Define short names for type annotations: arrays of numbers and truth values, paths, and progress functions."""

import os
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.floating[Any]]  # array in double precision; some fields of the grid solver have single precision
Integers = NDArray[np.integer[Any]]
Mask = NDArray[np.bool_]
Complex = NDArray[np.complexfloating[Any, Any]]
Seed = int | Sequence[int] | np.random.SeedSequence
Numbers = float | Array  # a number or an array of numbers, as argument or result of a formula
Scalar = float | np.floating[Any]
Several = Sequence[Any] | NDArray[Any]  # several numbers
Pair = tuple[Array, Array] | tuple[float, float]  # values at both ends of an interval
FilePath = str | os.PathLike[str]
Progress = Callable[[float], object]  # function that a computation calls with the finished share of its work, 0 to 1
