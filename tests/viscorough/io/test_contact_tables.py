"""Tables of contacts: numbers in the units that people use, rows that are found again, grid errors and failures."""

import warnings
from pathlib import Path

import numpy as np
import pytest

from support.tables import read_table
from viscorough import Indenter, contact_at, indent, self_affine_disc
from viscorough.basics.errors import AccuracyWarning
from viscorough.io import contact_tables, tables
from viscorough.io.contact_tables import FileRows, evaluated, rows_at_loads
from viscorough.surfaces.preparation import doubts

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


def test_levels_of_a_curve_have_area_and_mean_pressure():
    curve = indent(BALL, forces=FORCES, shear_modulus=MODULUS)
    rows, units = contact_tables.rows_of_curve(curve, BALL, MODULUS)
    for row, contact in zip(rows, contacts(), strict=True):
        assert row["contact_area"] == contact.contact_area == row["contact_count"]
        assert row["mean_normal_pressure"] == pytest.approx(0.5 * contact.mean_pressure)
        assert row["normal_stiffness"] == pytest.approx(0.5 * contact.stiffness, rel=1e-6)
    assert units["mean_normal_pressure"] == "MPa"


def written(path, *results):
    tables.write(contact_tables.contact_table(contact_tables.with_one_unit(results)), path)
    return path


def test_rows_of_a_table_are_found_again(tmp_path):
    good = FileRows("b, c.csv", "12", *contact_tables.rows_of_contacts(contacts()), warnings='tilted by "1"')
    failed = FileRows("a.csv", "34", error="not readable")
    path = written(tmp_path / "table.csv", good, failed)
    assert contact_tables.rows_in_table(path) == {"b, c.csv": good}
    table, units = read_table(path)
    assert table["file"].tolist() == ["a.csv", "b, c.csv", "b, c.csv"]
    assert table["error"].fillna("").tolist() == ["not readable", "", ""]
    assert np.isnan(table["depth"].to_numpy()).tolist() == [True, False, False]
    assert units["depth"] == "um"


def test_other_files_have_no_rows(tmp_path):
    other, missing = tmp_path / "other.csv", tmp_path / "missing.csv"
    good = written(tmp_path / "good.csv", FileRows("b", "1", *contact_tables.rows_of_contacts(contacts()))).read_text()
    assert contact_tables.rows_in_table(missing) == {}
    for text in ("", "x,y\n1,2\n", "file,depth (um),error\na,1,\n", good[:-60], good.replace(",1,,,", ",one,,,", 1)):
        other.write_text(text)
        assert contact_tables.rows_in_table(other) == {}, text
    other.write_bytes(b"\xff\xfe\x00")
    assert contact_tables.rows_in_table(other) == {}


def test_files_with_and_without_a_unit_do_not_mix(tmp_path):
    in_micrometres = FileRows("micrometres.csv", "1", *contact_tables.rows_of_contacts([contact_at(BALL, force=20.0)]))
    plain = FileRows(
        "plain.csv", "2", *contact_tables.rows_of_contacts([contact_at(Indenter(HEIGHTS, 1.0), force=20.0)])
    )
    assert contact_tables.with_one_unit([plain, plain]) == [plain, plain]
    for results in ((in_micrometres, plain), (plain, in_micrometres)):
        first, second = contact_tables.with_one_unit(results)
        assert first == in_micrometres
        assert not second.rows
        assert second.error.endswith("unit is needed")


def test_digest_changes_with_file_settings_and_companions(tmp_path):
    scan = tmp_path / "scan.asc"
    scan.write_bytes(b"1")
    digests = [contact_tables.digest_of_file(scan, "a"), contact_tables.digest_of_file(scan, "b")]
    scan.with_name("scan.prj").write_bytes(b"PROJCS")
    digests.append(contact_tables.digest_of_file(scan, "a"))
    scan.write_bytes(b"2")
    digests.append(contact_tables.digest_of_file(scan, "a"))
    assert len(set(digests)) == 4
    assert contact_tables.digest_of_file(tmp_path / "missing.asc", "a") == ""
    assert contact_tables.digest_of_file(scan, "a") == digests[-1]


GRID_ERRORS = ["grid_error", "force_grid_error", "area_change"]


@pytest.mark.parametrize(("hurst", "seed"), [(0.5, 2), (0.8, 0), (0.8, 3)])
def test_grid_error_of_a_single_load_is_that_of_the_whole_curve(hurst, seed):
    """At a single force the curves of both grids can agree by chance, so that their difference says nothing."""
    disc = self_affine_disc(hurst, 129, rms=0.02, seed=seed)
    curve = indent(disc, until_fraction=0.3, estimate_grid_error=True)
    for share in (0.1, 0.3, 0.6):
        force = share * curve.force[-1]
        (row,), units = rows_at_loads(disc, force=[force], grid_error=True)
        assert [units[name] for name in GRID_ERRORS] == ["1", "1", "1"]
        expected = np.exp(np.interp(np.log(force), np.log(curve.force), np.log(curve.grid_error)))
        assert 0.5 * expected < row["grid_error"] < 2 * expected


def test_grid_errors_change_no_other_number():
    disc = self_affine_disc(0.8, 65, rms=0.02, length_unit="um", seed=1)
    rows, _ = rows_at_loads(disc, depth=[0.01, 0.02, 0.0201])
    more, _ = rows_at_loads(disc, depth=[0.01, 0.02, 0.0201], grid_error=True)
    assert [{name: row[name] for name in row if name not in GRID_ERRORS} for row in more] == rows


def test_progress_of_contacts_and_grid_errors_rises_to_one():
    done = []
    rows_at_loads(self_affine_disc(0.8, 33, seed=1), force=[0.1, 0.2], grid_error=True, progress=done.append)
    assert done == sorted(done)
    assert done[-1] == pytest.approx(1.0)


@pytest.mark.filterwarnings("default")
def test_failures_and_warnings_become_texts_without_the_path():
    def fail():
        raise ValueError("a.csv: it is empty.")

    scan = FileRows("a.csv", "12")
    result = evaluated(scan, Path("a.csv"), fail, rows_at_loads)
    assert result == scan._replace(error="it is empty")
    result = evaluated(scan, Path("a.csv"), lambda: None, lambda indenter: indenter.heights)
    assert result.error.startswith("AttributeError: ")

    def evaluate(indenter):
        assert doubts(indenter) == []
        for _ in range(2):
            warnings.warn("a.csv: tilted", AccuracyWarning, stacklevel=1)
        return rows_at_loads(indenter, force=[0.1])

    result = evaluated(scan, Path("a.csv"), lambda: Indenter(-np.eye(9), 1.0), evaluate)
    assert (result.error, result.warnings, len(result.rows)) == ("", "tilted", 1)
