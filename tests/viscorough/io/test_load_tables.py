"""Tables of loads: numbers in the units that people use, and rows that are found again."""

import numpy as np
import pytest

from support.tables import read_table
from viscorough import Indenter, contact_at, indent
from viscorough.io import load_tables, tables
from viscorough.io.load_tables import LoadRows

HEIGHTS = -np.add.outer(np.arange(-8.0, 9) ** 2, np.arange(-8.0, 9) ** 2) / 200
BALL = Indenter(HEIGHTS, 1.0, length_unit="um")
MODULUS = 5e5  # Pa
FORCES = ["5 uN", "10 uN"]


def contacts(indenter=BALL):
    return contact_at(indenter, force=FORCES, shear_modulus=MODULUS)


def test_numbers_are_in_micrometres_newtons_and_megapascals():
    """The expected numbers are converted by hand: G um2 is 5e-7 N, G um is 0.5 N/m, G is 0.5 MPa."""
    rows, units = load_tables.rows_of_contacts(contacts())
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
    rows, units = load_tables.rows_of_contacts(contacts())
    others, same_units = load_tables.rows_of_contacts(contacts(BALL.to(unit)))
    assert units == same_units
    for row, other in zip(rows, others, strict=True):
        assert other == pytest.approx(row, rel=1e-5)


def test_without_a_unit_of_length_numbers_stay_consistent():
    plain = Indenter(HEIGHTS, 1.0)
    rows, units = load_tables.rows_of_contacts([contact_at(plain, force=20.0)])
    assert (rows[0]["force"], set(units.values())) == (20.0, {"1"})
    rows, units = load_tables.rows_of_contacts([contact_at(plain, force=20.0, shear_modulus=2.0)])
    assert (rows[0]["normal_force"], set(units.values())) == (20.0, {"1"})


def test_levels_of_a_curve_have_area_and_mean_pressure():
    curve = indent(BALL, forces=FORCES, shear_modulus=MODULUS)
    rows, units = load_tables.rows_of_curve(curve, BALL, MODULUS)
    for row, contact in zip(rows, contacts(), strict=True):
        assert row["contact_area"] == contact.contact_area == row["contact_count"]
        assert row["mean_normal_pressure"] == pytest.approx(0.5 * contact.mean_pressure)
        assert row["normal_stiffness"] == pytest.approx(0.5 * contact.stiffness, rel=1e-6)
    assert units["mean_normal_pressure"] == "MPa"


def written(path, *results):
    tables.write(load_tables.load_table(load_tables.with_one_unit(results)), path)
    return path


def test_rows_of_a_table_are_found_again(tmp_path):
    good = LoadRows("b, c.csv", "12", *load_tables.rows_of_contacts(contacts()), warnings='tilted by "1"')
    failed = LoadRows("a.csv", "34", error="not readable")
    path = written(tmp_path / "table.csv", good, failed)
    assert load_tables.finished_rows(path) == {"b, c.csv": good}
    table, units = read_table(path)
    assert table["file"].tolist() == ["a.csv", "b, c.csv", "b, c.csv"]
    assert table["error"].fillna("").tolist() == ["not readable", "", ""]
    assert np.isnan(table["depth"].to_numpy()).tolist() == [True, False, False]
    assert units["depth"] == "um"


def test_other_files_have_no_rows(tmp_path):
    other, missing = tmp_path / "other.csv", tmp_path / "missing.csv"
    good = written(tmp_path / "good.csv", LoadRows("b", "1", *load_tables.rows_of_contacts(contacts()))).read_text()
    assert load_tables.finished_rows(missing) == {}
    for text in ("", "x,y\n1,2\n", "file,depth (um),error\na,1,\n", good[:-60], good.replace(",1,,,", ",one,,,", 1)):
        other.write_text(text)
        assert load_tables.finished_rows(other) == {}, text
    other.write_bytes(b"\xff\xfe\x00")
    assert load_tables.finished_rows(other) == {}


def test_files_with_and_without_a_unit_do_not_mix(tmp_path):
    in_micrometres = LoadRows("micrometres.csv", "1", *load_tables.rows_of_contacts([contact_at(BALL, force=20.0)]))
    plain = LoadRows("plain.csv", "2", *load_tables.rows_of_contacts([contact_at(Indenter(HEIGHTS, 1.0), force=20.0)]))
    assert load_tables.with_one_unit([plain, plain]) == [plain, plain]
    for results in ((in_micrometres, plain), (plain, in_micrometres)):
        first, second = load_tables.with_one_unit(results)
        assert first == in_micrometres
        assert not second.rows
        assert second.error.endswith("unit is needed")


def test_digest_changes_with_file_settings_and_companions(tmp_path):
    scan = tmp_path / "scan.tif"
    scan.write_bytes(b"1")
    digests = [load_tables.digest_of_scan(scan, "a"), load_tables.digest_of_scan(scan, "b")]
    scan.with_name("scan.tif.msk").write_bytes(b"mask")
    digests.append(load_tables.digest_of_scan(scan, "a"))
    scan.write_bytes(b"2")
    digests.append(load_tables.digest_of_scan(scan, "a"))
    assert len(set(digests)) == 4
    assert load_tables.digest_of_scan(tmp_path / "missing.tif", "a") == ""
    assert load_tables.digest_of_scan(scan, "a") == digests[-1]
