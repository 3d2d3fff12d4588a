"""Calibration of the penetration law: one row for each Hurst exponent and grid, for any number of processes."""

import law
import numpy as np
import pandas as pd
from click.testing import CliRunner
from law_calibration import COLUMNS


def test_law_is_calibrated_for_every_exponent_and_grid(tmp_path, monkeypatch):
    monkeypatch.setattr(law, "HURST", (0.4, 0.9))
    monkeypatch.setattr(law, "ACROSS", (17,))
    monkeypatch.setattr(law, "RESAMPLES", 1)
    tables = []
    for cores in (2, 1):
        output = tmp_path / f"tables/{cores}.csv"
        done = CliRunner().invoke(law.main, ["--discs", "15", "--cores", str(cores), "--output", str(output)])
        assert done.exit_code == 0, done.output
        tables.append(pd.read_csv(output))
        monkeypatch.setattr(law, "HURST", (0.4,))
    table, again = tables
    assert list(table) == list(COLUMNS)
    assert table[["hurst", "across", "discs", "unused"]].to_numpy().tolist() == [[0.4, 17, 15, 15], [0.9, 17, 15, 15]]
    assert np.isfinite(table.to_numpy()).all()
    pd.testing.assert_frame_equal(table[:1], again)
