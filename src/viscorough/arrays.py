"""Arrays that an object keeps: copies that cannot be changed, in which masked entries are nan."""

import dataclasses

import numpy as np


def read_only(values):
    """The values as an array that cannot be changed: a copy, unless nobody can change it already.

    Masked entries of numpy's masked arrays, also of a list of them, become nan.
    """
    if isinstance(values, list | tuple) and any(map(np.ma.isMaskedArray, values)):
        values = np.ma.array(values)
    mask, array = np.ma.getmask(values), np.ma.getdata(values, subok=False)
    if mask is not np.ma.nomask and mask.any() and array.dtype.kind in "iuf":
        array = np.where(mask, np.nan, array)
    elif not _cannot_change(array):
        array = np.array(array)
    array.flags.writeable = False
    return array


def keep_read_only(instance):
    """Replace every array field of a frozen dataclass by `read_only` of it; for its __post_init__."""
    for field in dataclasses.fields(instance):
        if field.type is np.ndarray:
            object.__setattr__(instance, field.name, read_only(getattr(instance, field.name)))


def _cannot_change(array):
    """Whether an array and all arrays that it is a view of are read-only."""
    while isinstance(array, np.ndarray):
        if array.flags.writeable:
            return False
        array = array.base
    return array is None
