"""Results in a few lines of text."""

from viscorough.basics.summaries import span, unit_power, with_unit


def test_units_and_numbers():
    for unit, squared in (("m", "m2"), ("1", "1"), ("1e-6 m", "(1e-6 m)2")):
        assert unit_power(unit, 2) == squared
        assert (unit_power(unit, 1), unit_power(unit, 0)) == (unit, "1")
    assert (span([1.0, 20000.0], "m"), span([3.0]), with_unit(1e-7 / 3, "s")) == ("1 to 2e+04 m", "3", "3.333e-08 s")
