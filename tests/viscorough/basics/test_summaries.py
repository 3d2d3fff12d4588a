"""Results in a few lines of text."""

from viscorough.basics.summaries import span, with_unit


def test_units_and_numbers():
    assert (span([1.0, 20000.0], "m"), span([3.0]), with_unit(1e-7 / 3, "s")) == ("1 to 2e+04 m", "3", "3.333e-08 s")
