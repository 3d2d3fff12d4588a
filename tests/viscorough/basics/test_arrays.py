"""Checks of numbers in arguments."""

from pathlib import Path

import numpy as np
import pint
import pytest

from viscorough.basics.arrays import fraction, positive, real_number, real_numbers, whole_number

WRONG = {
    "complex": 1 + 2j,
    "truth value": True,
    "object": object(),
    "huge": 10**400,
    "nan": np.nan,
    "infinite": -np.inf,
    "text": "5 mN",
    "date": np.datetime64("2013-01-01"),
    "duration": np.timedelta64(1, "s"),
    "path": Path("curve.nc"),
    "quantity": pint.Quantity(1.0, "mN"),
    "masked": np.ma.array([1.0, 2.0], mask=[0, 1]),
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
    if check == "real_numbers" and wrong in ("nan", "infinite"):
        return
    with pytest.raises(ValueError, match=r"^x: ") as error:
        CHECKS[check]("x", WRONG[wrong])
    assert len(str(error.value).splitlines()) == 1
    assert len(str(error.value)) < 200


def test_numbers_are_copied():
    numbers = np.arange(3.0)
    checked = real_numbers("x", numbers)
    numbers[0] = 7.0
    assert checked.tolist() == [0.0, 1.0, 2.0]
