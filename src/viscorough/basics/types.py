"""Abbreviations for annotations: arrays of real numbers, indices and truth values, paths, and progress functions."""

import os
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.floating[Any]]  # in double precision, except for fields of the contact on a grid
Integers = NDArray[np.integer[Any]]
Mask = NDArray[np.bool_]
Complex = NDArray[np.complexfloating[Any, Any]]
Seed = int | Sequence[int] | np.random.SeedSequence
Numbers = float | Array  # arguments and results of formulas
Scalar = float | np.floating[Any]
FloatType = type[np.floating[Any]] | np.dtype[Any] | str  # a type of numbers, such as numpy.float32 or "float64"
Several = list[Any] | tuple[Any, ...] | NDArray[Any]  # numbers in order, which may have units
Pair = tuple[Array, Array] | tuple[float, float]  # values at both ends of an interval
FilePath = str | os.PathLike[str]
Progress = Callable[[float], object]  # called with the share of the work that is done
