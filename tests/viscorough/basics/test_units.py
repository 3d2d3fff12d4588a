"""Units as users and files write them."""

import pytest

from support.command_line import python
from support.contract import refused
from viscorough.basics import units

LENGTHS = {
    **dict.fromkeys(["m", "meter", "metres"], ("m", 1.0)),
    **dict.fromkeys(["um", "µm", "μm", "micron", "micrometer", "1e-6 m", "(1e-6 m)", " um\n"], ("um", 1e-6)),
    **dict.fromkeys(["nm", "nanometre", "10 angstrom"], ("nm", 1e-9)),
    **dict.fromkeys(["Å", "Angstrom"], ("1e-10 m", 1e-10)),
}


@pytest.mark.parametrize("text", LENGTHS)
def test_units_of_length_have_one_spelling_and_a_size(text):
    spelling, metres = LENGTHS[text]
    assert units.length_unit(text) == spelling
    assert units.length_unit(spelling) == spelling
    assert units.metres(text) == metres


NO_LENGTHS = ["", "1", "m2", "degrees_north", "0 m", "1e400 m", "m\nm", "é", "\x00"]
PICTURES = ["px", "Pixels", "points", "pt", "dots", "mpx", "css_pixel", "pica", "1e-6 px"]
DANGEROUS = ["9**9**9**9", "m**99999999", "__import__('os')", "a" * 10_000, "(" * 60]


@pytest.mark.parametrize("text", NO_LENGTHS + PICTURES + DANGEROUS)
def test_unknown_units_of_length_are_refused(text):
    with refused("unit") as error:
        units.length_unit(text)
    assert len(str(error.value)) < 200


@pytest.mark.parametrize(
    ("text", "unit", "number"),
    [
        ("5 mN", "N", 5e-3),
        ("4 N s/(1e-6 m)2", "Pa s", 4e12),
        ("2 GPa", "N um-2", 2e-3),
        ("7", "N", 7.0),
    ],
)
def test_quantities_are_converted(text, unit, number):
    assert units.quantity(text).to(unit) == pytest.approx(number, rel=1e-14)


@pytest.mark.parametrize("text", ["", "mN", "5 5 x", "1,5", "5 m_m"])
def test_texts_that_are_no_quantity_are_refused(text):
    with refused("number|unit"):
        units.quantity(text)
    with pytest.raises(ValueError, match="cannot be converted to N"):
        units.quantity("5 mm").to("N")


def test_common_units_do_not_need_pint():
    program = (
        "import sys; from viscorough.basics import units; units.metres('µm'); units.quantity('5'); print(sys.modules)"
    )
    modules = python("-c", program).stdout
    assert "viscorough.basics.units" in modules
    assert "pint" not in modules


@pytest.mark.parametrize(
    ("length", "spelled"),
    [
        ("um", ["um", "um2", "um s-1", "s"]),
        ("1", ["1", "1", "1", "s"]),
        ("1e-6 m", ["1e-6 m", "(1e-6 m)2", "1e-6 m s-1", "s"]),
    ],
)
def test_powers_of_a_unit_of_length_are_spelled_as_udunits_does(length, spelled):
    assert [units.with_length(unit, length) for unit in ("m", "m2", "m s-1", "s")] == spelled


def test_numbers_are_converted_to_si_units():
    assert units.in_si(units.Quantity(2.0), "m", "um", "x") == 2e-6
    assert units.in_si(units.Quantity(2.0, "mN"), "N", "um", "x") == 2e-3
    assert units.in_si(units.Quantity(2.0), "m", "1", "x") == 2.0
    with refused("x 2 mN: needs a plain number"):
        units.in_si(units.Quantity(2.0, "mN"), "N", "1", "x")
    with refused("x 2 mN: .* cannot be converted to m"):
        units.in_si(units.Quantity(2.0, "mN"), "m", "um", "x")
