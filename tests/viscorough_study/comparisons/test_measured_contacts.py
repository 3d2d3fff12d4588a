"""The table of contacts of measured surfaces has the numbers of the command line."""

import numpy as np
import pytest

from support.command_line import run
from support.tables import read_table
from viscorough.contact.loading_path import indent
from viscorough.surfaces.self_affine import self_affine_disc
from viscorough_study.comparisons.measured import CONTACTS, measured_contacts, measured_motions

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
    loads = "--force 1e-5,1e-4 --young 2e6 --poisson 0.3 --grid-error"
    assert run(f"contact a.npy --spacing 10 --unit um --flip {loads} -o a.csv") == 0
    expected, units = read_table("a.csv")
    assert list(expected) == list(CONTACTS)[2:]
    for name in set(units) - {"file", "error", "warnings", "digest"}:
        assert table[name].tolist() == pytest.approx(expected[name].tolist(), rel=1e-12), name
        assert CONTACTS[name][1] == units[name]


def test_digest_changes_with_file_and_settings():
    digests = {measured_contacts([SCAN | change])["digest"][0] for change in ({}, {"forces": [1e-4]}, {"unit": "nm"})}
    np.save("a.npy", 2 * np.load("a.npy"))
    assert len(digests | {measured_contacts([SCAN])["digest"][0]}) == 4


def test_motions_end_where_their_curve_ends():
    """In a Newtonian medium F t/η is the impulse over the viscosity, which replaces F/G."""
    curve = indent(self_affine_disc(0.6, 9, rms=0.5e-6, diameter=90e-6, seed=1, length_unit="m"))
    media = [{"name": "fluid", "kind": "newtonian", "viscosity": 1e6}]
    times = {"low": 1e-9, "high": 1e3, "per_decade": 10}
    (motion,) = measured_motions(curve, [1e-4, 1e9], media=media, times=times)
    end = curve.force[-1] * 1e6 / 1e-4
    assert end / 10**0.1 < motion["time"].max() <= end
    assert set(motion["force"]) == {1e-4}


def test_scan_that_fails_has_a_row_with_its_reason():
    table = measured_contacts([SCAN | {"file": "missing.npy"}, SCAN])
    assert table["file"].tolist() == ["missing.npy", "a.npy", "a.npy"]
    assert "not readable (No such file" in table["error"][0]
    assert table["error"][1:].tolist() == ["", ""]
    assert np.isnan(table["depth"]).tolist() == [True, False, False]
