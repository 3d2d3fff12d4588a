"""The table of contacts of measured surfaces has the numbers of the command line."""

import numpy as np
import pytest

from support.command_line import run
from support.tables import read_table
from viscorough.contact.loading_path import indent
from viscorough.surfaces.self_affine import self_affine_disc
from viscorough_study.comparisons.measured_contacts import CONTACTS, measured_contacts, rows_with_grid_errors

GRID_ERRORS = ["grid_error", "force_grid_error", "area_change"]
OF_THE_STUDY = {"scan", "group", "file", "error", "warnings", *GRID_ERRORS}

SCAN = {"name": "ground_a", "group": "ground", "file": "a.npy", "digest": "", "spacing": [10.0], "unit": "um"}
SCAN |= {"preparation": {"flip": True}, "forces": [1e-4, 1e-5], "young_modulus": 2e6, "poisson_ratio": 0.3}


@pytest.fixture(autouse=True)
def heights(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    np.save("a.npy", self_affine_disc(0.6, 17, rms=0.5, diameter=170.0, seed=1).heights)


def test_table_is_that_of_the_command_line():
    table = measured_contacts([SCAN, SCAN | {"young_modulus": None}, SCAN | {"forces": []}])
    assert list(table) == list(CONTACTS)
    assert table["scan"].tolist() == ["ground_a", "ground_a"]
    loads = "--force 1e-5,1e-4 --young 2e6 --poisson 0.3"
    assert run(f"contact a.npy --spacing 10 --unit um --flip {loads} -o a.csv") == 0
    expected, units = read_table("a.csv")
    assert list(expected) == [name for name in CONTACTS if name not in OF_THE_STUDY]
    for name in units:
        assert table[name].tolist() == pytest.approx(expected[name].tolist(), rel=1e-12), name
        assert CONTACTS[name][1] == units[name]


def test_scan_that_fails_has_a_row_with_its_reason():
    table = measured_contacts([SCAN | {"file": "missing.npy"}, SCAN])
    assert table["file"].tolist() == ["missing.npy", "a.npy", "a.npy"]
    assert "not readable (No such file" in table["error"][0]
    assert table["error"][1:].tolist() == ["", ""]
    assert np.isnan(table["depth"]).tolist() == [True, False, False]


@pytest.mark.parametrize(("hurst", "seed"), [(0.5, 2), (0.8, 0), (0.8, 3)])
def test_grid_error_of_a_single_load_is_that_of_the_whole_curve(hurst, seed):
    """At a single force the curves of both grids can agree by chance, so that their difference says nothing."""
    disc = self_affine_disc(hurst, 129, rms=0.02, seed=seed)
    curve = indent(disc, until_fraction=0.3, estimate_grid_error=True)
    for share in (0.1, 0.3, 0.6):
        force = share * curve.force[-1]
        (row,) = rows_with_grid_errors(disc, [force], 1.0)
        expected = np.exp(np.interp(np.log(force), np.log(curve.force), np.log(curve.grid_error)))
        assert 0.5 * expected < row["grid_error"] < 2 * expected
