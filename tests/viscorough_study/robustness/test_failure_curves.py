"""Where methods begin to fail."""

import numpy as np
import pytest

from viscorough_study.robustness.failure_curves import COLUMNS, failure_curves


def test_failure_curves():
    table = failure_curves(np.random.SeedSequence(1))
    assert list(table.columns) == list(COLUMNS)
    steps = table[(table["curve"] == "steps") & (table["method"] == "error of the depth")]
    order = -np.polyfit(np.log(steps["x"][-8:]), np.log(steps["y"][-8:]), 1)[0]
    assert order == pytest.approx(1, abs=0.3)  # forward Euler
    contact = table[table["curve"] == "contact"].set_index("method")["y"]
    assert contact["path, grid, single"].max() < 1e-5
    assert contact["path, grid, no padding"].max() > 1e-2
