"""Units as users and files write them."""

import pint
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


@pytest.mark.parametrize("force", ["5 mN", "2", units.Quantity(5.0, "mN"), pint.Quantity(5.0, "mN")])
def test_force_with_a_unit_needs_a_modulus(force):
    with pytest.raises(ValueError, match=r"^force .*: a force needs shear_modulus"):
        units.forces_over_modulus([1.0, force], None, "m", "force")
    assert units.forces_over_modulus([1.0, units.Quantity(2.0)], None, "m", "force").tolist() == [1.0, 2.0]
