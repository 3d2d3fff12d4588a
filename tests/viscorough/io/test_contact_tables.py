"""Tables of contacts have numbers in the units that people use."""

import numpy as np
import pytest

from support.tables import read_table
from viscorough import Indenter, contact_at
from viscorough.io import contact_tables, tables

HEIGHTS = -np.add.outer(np.arange(-8.0, 9) ** 2, np.arange(-8.0, 9) ** 2) / 200
BALL = Indenter(1e-6 * HEIGHTS, 1e-6, length_unit="m")
MODULUS = 5e5  # Pa
FORCES = np.array([5e-6, 1e-5])  # N


def contacts():
    return contact_at(BALL, force=FORCES / MODULUS)


def test_numbers_are_in_micrometres_newtons_and_megapascals():
    """The expected numbers are converted by hand: G is 0.5 MPa."""
    table = contact_tables.table_of_contacts(contacts(), MODULUS)
    last = contacts()[-1]
    expected = {
        "depth": (1e6 * last.depth, "um"),
        "normal_force": (1e-5, "N"),
        "normal_stiffness": (5e5 * last.stiffness, "N/m"),
        "contact_fraction": (last.contact_fraction, "1"),
        "contact_area": (1e12 * last.contact_area, "um2"),
        "corrected_contact_area": (1e12 * last.corrected_contact_area, "um2"),
        "mean_normal_pressure": (0.5 * last.mean_pressure, "MPa"),
        "largest_normal_pressure": (0.5 * last.largest_pressure, "MPa"),
        "patches": (1, "1"),
    }
    assert table.keys() == expected.keys()
    for name, (value, unit) in expected.items():
        values, stated = table[name]
        assert (values[-1], stated) == (pytest.approx(value, rel=1e-14), unit)
    assert table["normal_force"][0].tolist() == [5e-6, 1e-5]


def test_without_a_unit_of_length_numbers_stay_consistent():
    plain = Indenter(HEIGHTS, 1.0)
    for name, force, modulus in (("force", 20.0, None), ("normal_force", 10.0, 2.0)):
        table = contact_tables.table_of_contacts([contact_at(plain, force=force)], modulus)
        assert table[name][0] == 20.0
        assert {unit for _, unit in table.values()} == {"1"}


def test_a_table_has_a_row_for_each_contact(tmp_path):
    expected = contact_tables.table_of_contacts(contacts(), MODULUS)
    tables.write(tmp_path / "table.csv", *contact_tables.table_to_content(expected))
    table, units = read_table(tmp_path / "table.csv")
    assert table.to_dict("list") == {name: values.tolist() for name, (values, _) in expected.items()}
    assert units == {name: unit for name, (_, unit) in expected.items()}
