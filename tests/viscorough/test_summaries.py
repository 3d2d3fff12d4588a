"""Results in a few lines of text; numbers with units."""

import numpy as np

from support.curves import random_curve
from viscorough import Indenter
from viscorough.summaries import span, unit_power, with_unit


def test_results_in_short():
    curve = random_curve(depth=[0.5, 2], stiffness=[1, 2], force=[1, 3], contact_count=[1, 504], residual=[0, 0])
    first, depth, *others = str(curve).splitlines()
    assert (first, depth) == ("LoadingCurve", "depth: 2 numbers from 0.5 to 2")
    assert "elements: 1009" in others
    assert others[-1] == "length_unit: m"
    assert repr(Indenter([[0.0, 1.5], [-1.0, np.nan]], 2.0, length_unit="um")).splitlines() == [
        "Indenter",
        "heights: 2 x 2 numbers from -1 to 1.5",
        "spacing: 2",
        "row_spacing: 2",
        "length_unit: um",
    ]


def test_units_and_numbers():
    for unit, squared in (("m", "m2"), ("1", "1"), ("1e-6 m", "(1e-6 m)2")):
        assert unit_power(unit, 2) == squared
        assert (unit_power(unit, 1), unit_power(unit, 0)) == (unit, "1")
    assert (span([1.0, 20000.0], "m"), span([3.0]), with_unit(1e-7 / 3, "s")) == ("1 to 2e+04 m", "3", "3.333e-08 s")
