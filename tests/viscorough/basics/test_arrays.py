"""Checks of numbers, and arrays that objects keep: they cannot be changed from outside, and masks are not lost."""

from fractions import Fraction
from pathlib import Path

import numpy as np
import pint
import pytest

from viscorough import Indenter, Load
from viscorough.basics.arrays import fraction, positive, read_only, real_number, real_numbers, whole_number

HILL = Indenter([[0.0, 1.0], [0.5, 0.2]], 1.0)


@pytest.mark.parametrize("values", [np.arange(6.0)[::2], (1, 2), np.broadcast_to(1.0, 3)], ids=repr)
def test_arrays_are_copied(values):
    kept = read_only(values)
    np.testing.assert_array_equal(kept, values)
    assert not kept.flags.writeable
    assert not np.shares_memory(kept, values)


def test_only_immutable_arrays_are_not_copied():
    array = np.arange(3.0)
    view = array[1:]
    view.flags.writeable = False
    assert not np.shares_memory(read_only(view), array), "the view is read-only, what it shows is not"
    array.flags.writeable = False
    assert np.shares_memory(read_only(array), array)
    assert np.shares_memory(read_only(array[1:]), array)


@pytest.mark.parametrize("dtype", [float, np.float32, int])
def test_masked_entries_are_nan(dtype):
    masked = np.ma.array([[1, 2], [3, 4]], mask=[[0, 1], [0, 0]], dtype=dtype)
    for values in (masked, list(masked)):
        np.testing.assert_array_equal(read_only(values), [[1, np.nan], [3, 4]])
    np.testing.assert_array_equal(read_only(masked[1]), [3, 4])
    assert read_only(masked[1]).dtype == dtype, "where nothing is masked the type stays"


def test_masked_samples_of_a_force_are_refused():
    masked = np.ma.array([1.0, 2.0, 3.0], mask=[0, 1, 0])
    with pytest.raises(ValueError, match="sample 1 is nan"):
        Load([0, 1, 2], force=masked)
    with pytest.raises(ValueError, match="time: allowed is one row of finite numbers"):
        Load(masked, force=[1, 2, 3])


WRONG = {
    "complex": 1 + 2j,
    "complex without imaginary part": np.complex128(1),
    "truth value": True,
    "object": object(),
    "huge": 10**400,
    "more digits than Python writes": 10**5000,
    "long double beyond double": np.longdouble("1e4000"),
    "nan": np.nan,
    "infinite": -np.inf,
    "text": "abc",
    "bytes": b"1",
    "mapping": {"1": 1},
    "set": {1.0},
    "date": np.datetime64("2013-01-01"),
    "duration": np.timedelta64(1, "s"),
    "map": HILL,
    "path": Path("curve.nc"),
    "temperature": pint.Quantity(1.0, "kelvin"),
    "complex quantity": pint.Quantity(1j, "mN"),
    "rows of different lengths": [1.0, [2.0, 3.0]],
}
CHECKS = {
    "real_numbers": real_numbers,
    "real_number": real_number,
    "positive": positive,
    "fraction": fraction,
    "whole_number": lambda name, value: whole_number(name, value, at_least=0),
}


@pytest.mark.parametrize("wrong", WRONG)
@pytest.mark.parametrize("check", CHECKS)
def test_values_that_are_no_real_numbers_are_refused_in_one_line(check, wrong):
    for value in (WRONG[wrong], [0.5, WRONG[wrong]]):
        if check == "real_numbers" and wrong in ("nan", "infinite"):
            continue
        with pytest.raises((ValueError, TypeError), match=r"^x: ") as error:
            CHECKS[check]("x", value)
        assert len(str(error.value).splitlines()) == 1
        assert len(str(error.value)) < 600


@pytest.mark.parametrize("kind", [np.float16, np.float32, np.float64, np.longdouble, np.int16, Fraction])
def test_real_numbers_of_every_type_are_floats(kind):
    for check in (real_number, positive, fraction):
        assert type(check("x", kind(1))) is float
    numbers = real_numbers("x", [kind(1), kind(2)])
    assert numbers.dtype == float
    assert numbers.tolist() == [1.0, 2.0]
