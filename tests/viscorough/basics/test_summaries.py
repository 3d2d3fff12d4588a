"""Results in a few lines of text."""

import numpy as np

from support.curves import random_curve
from viscorough import Indenter, contact_at
from viscorough.basics.summaries import span, unit_power, with_unit


def test_curve_in_three_lines():
    levels = {"depth": [0.5, 2], "force": [1, 3], "stiffness": [1, 2], "contact_count": [1, 504], "residual": [0, 0]}
    curve = random_curve(**levels, length_unit="um", elements=1008)
    assert str(curve).splitlines() == [
        "Loading curve by boundary elements: 2 levels, 1008 elements",
        "depth u 0.5 to 2 um, force F/G 1 to 3 um2, stiffness k/G 1 to 2 um",
        "contact fraction 0.0009921 to 0.5",
    ]


def test_contact_in_three_lines():
    heights = np.array([[0.0, 0.0], [-1.0, np.nan]])
    contact = contact_at(Indenter(heights, 2.0, length_unit="um"), depth=0.1)
    first, second, third = str(contact).splitlines()
    assert first == "Contact of 2 of 3 elements"
    assert second.startswith("depth u 0.1 um, force F/G ")
    assert third.startswith("contact area 8 um2 (66.7 %), corrected 7.528 um2, mean p/G ")


def test_indenter_in_three_lines():
    assert repr(Indenter(np.array([[0.0, 1.5], [-1.0, np.nan]]), 2.0, length_unit="um")).splitlines() == [
        "Indenter: map of 2 x 2 points, 3 elements",
        "spacing 2 um",
        "highest over lowest point 2.5 um",
    ]


def test_units_and_numbers():
    for unit, squared in (("m", "m2"), ("1", "1"), ("1e-6 m", "(1e-6 m)2")):
        assert unit_power(unit, 2) == squared
        assert (unit_power(unit, 1), unit_power(unit, 0)) == (unit, "1")
    assert (span([1.0, 20000.0], "m"), span([3.0]), with_unit(1e-7 / 3, "s")) == ("1 to 2e+04 m", "3", "3.333e-08 s")
