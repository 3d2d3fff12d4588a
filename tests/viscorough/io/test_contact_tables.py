"""Tables of contacts have numbers in the units that people use."""

import numpy as np
import pytest

from support.tables import read_table
from viscorough import Indenter, contact_at
from viscorough.io import contact_tables, tables

HEIGHTS = -np.add.outer(np.arange(-8.0, 9) ** 2, np.arange(-8.0, 9) ** 2) / 200
BALL = Indenter(HEIGHTS, 1.0, length_unit="um")
MODULUS = 5e5  # Pa
FORCES = ["5 uN", "10 uN"]


def contacts(indenter=BALL):
    return contact_at(indenter, force=FORCES, shear_modulus=MODULUS)


def test_numbers_are_in_micrometres_newtons_and_megapascals():
    """The expected numbers are converted by hand: G um2 is 5e-7 N, G um is 0.5 N/m, G is 0.5 MPa."""
    rows, units = contact_tables.rows_of_contacts(contacts())
    last = contacts()[-1]
    expected = {
        "depth": (last.depth, "um"),
        "normal_force": (1e-5, "N"),
        "normal_stiffness": (0.5 * last.stiffness, "N/m"),
        "contact_fraction": (last.contact_fraction, "1"),
        "contact_area": (last.contact_area, "um2"),
        "corrected_contact_area": (last.corrected_contact_area, "um2"),
        "mean_normal_pressure": (0.5 * last.mean_pressure, "MPa"),
        "largest_normal_pressure": (0.5 * last.largest_pressure, "MPa"),
        "patches": (1, "1"),
    }
    assert units == {name: unit for name, (_, unit) in expected.items()}
    assert rows[-1] == pytest.approx({name: value for name, (value, _) in expected.items()}, rel=1e-14)
    assert [row["normal_force"] for row in rows] == [5e-6, 1e-5]


@pytest.mark.parametrize("unit", ["nm", "m"])
def test_rows_do_not_depend_on_the_unit_of_the_file(unit):
    rows, units = contact_tables.rows_of_contacts(contacts())
    others, same_units = contact_tables.rows_of_contacts(contacts(BALL.to(unit)))
    assert units == same_units
    for row, other in zip(rows, others, strict=True):
        assert other == pytest.approx(row, rel=1e-5)


def test_without_a_unit_of_length_numbers_stay_consistent():
    plain = Indenter(HEIGHTS, 1.0)
    rows, units = contact_tables.rows_of_contacts([contact_at(plain, force=20.0)])
    assert (rows[0]["force"], set(units.values())) == (20.0, {"1"})
    rows, units = contact_tables.rows_of_contacts([contact_at(plain, force=20.0, shear_modulus=2.0)])
    assert (rows[0]["normal_force"], set(units.values())) == (20.0, {"1"})


def test_a_table_has_a_row_for_each_contact(tmp_path):
    tables.write(contact_tables.contact_table(contacts()), tmp_path / "table.csv")
    table, units = read_table(tmp_path / "table.csv")
    rows, expected = contact_tables.rows_of_contacts(contacts())
    assert table.to_dict("records") == rows
    assert units == expected
