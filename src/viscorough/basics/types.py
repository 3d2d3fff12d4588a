"""Abbreviations for annotations: arrays of real numbers, indices and truth values, paths, and progress functions."""

import os
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.floating[Any]]  # double precision; fields of the contact solver on a grid may have single precision
Integers = NDArray[np.integer[Any]]
Mask = NDArray[np.bool_]
Complex = NDArray[np.complexfloating[Any, Any]]
Seed = int | Sequence[int] | np.random.SeedSequence
Numbers = float | Array  # a number or an array of numbers, as argument or result of a formula
Scalar = float | np.floating[Any]
FloatType = type[np.floating[Any]] | np.dtype[Any] | str  # floating-point type, such as numpy.float32 or "float64"
Several = list[Any] | tuple[Any, ...] | NDArray[Any]  # sequence of numbers, each of which may have a unit
Pair = tuple[Array, Array] | tuple[float, float]  # values at both ends of an interval
FilePath = str | os.PathLike[str]
Progress = Callable[[float], object]  # called with the share of the work that is done
