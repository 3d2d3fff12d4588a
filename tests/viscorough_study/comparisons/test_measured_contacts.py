"""The table of contacts of measured surfaces has the numbers of the command line."""

import numpy as np
import pytest

from support.command_line import run
from support.tables import read_table
from viscorough.surfaces import self_affine_disc
from viscorough_study.comparisons.measured import CONTACTS, measured_contacts


def test_rows_agree_with_the_command_line(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    np.save("a.npy", self_affine_disc(0.6, 17, rms=0.5, diameter=170.0, seed=1).heights)
    scan = {"name": "ground_a", "group": "ground", "file": "a.npy", "digest": "", "spacing": [10.0], "unit": "um"}
    scan |= {"preparation": {"flip": True}, "forces": [1e-4, 1e-5], "young_modulus": 2e6, "poisson_ratio": 0.3}
    table = measured_contacts([scan, scan | {"young_modulus": None}, scan | {"forces": []}])
    assert list(table) == list(CONTACTS)
    assert table["scan"].tolist() == ["ground_a", "ground_a"]
    assert run("contact a.npy --spacing 10 --unit um --flip --force 1e-5,1e-4 --young 2e6 --poisson 0.3 -o a.csv") == 0
    expected, units = read_table("a.csv")
    for name in set(units) - {"file", "error", "warnings", "digest"}:
        assert table[name].tolist() == pytest.approx(expected[name].tolist(), rel=1e-12), name
        assert CONTACTS[name][1] == units[name]
