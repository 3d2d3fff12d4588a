"""The Pareto front, the fastest methods that reach an error, and the cost at the same error."""

import pandas as pd
import pytest

from viscorough_study.performance.costs import fastest, pareto_front
from viscorough_study.performance.equal_error import COLUMNS, equal_error

TABLE = pd.DataFrame(
    [("path", 1.0, 1e-1), ("path", 2.0, 1e-3), ("path", 5.0, 1e-5), ("marching", 3.0, 1e-2), ("model", 0.1, 0.3)],
    columns=["group", "wall_s", "error"],
)


def test_no_row_beats_those_of_the_front():
    assert pareto_front(TABLE)["wall_s"].tolist() == [0.1, 1.0, 2.0, 5.0]


def test_the_fastest_of_each_group_reach_the_error():
    best = fastest(TABLE, 1e-2)
    assert {group: row["wall_s"] for group, row in best.items()} == {"path": 2.0, "marching": 3.0}
    assert fastest(TABLE, 1e-9) == {}


# ---- cost at the same error


def methods(rows):
    columns = ["problem", "elements", "method", "group", "value", "error", "wall_s"]
    return pd.DataFrame(rows, columns=columns).assign(hurst=0.4)


DISC = [
    ("disc", 65, "MDR", "model", 64, 0.30, 0.001),
    ("disc", 65, "MDR", "model", 256, 0.21, 0.002),
    ("disc", 65, "MDR", "model", 1024, 0.20, 0.004),
    ("disc", 65, "path, at the depths", "path", 0.1, 0.25, 0.01),
    ("disc", 65, "path, at the depths", "path", 0.01, 0.02, 0.03),
    ("disc", 65, "path, automatic levels", "path", 0.01, 0.01, 0.05),
]


def test_the_fastest_path_as_accurate_as_the_line_is_compared_with_it():
    (row,) = equal_error(methods(DISC)).to_dict("records")
    assert list(row) == list(COLUMNS)
    assert (row["points"], row["line_error"]) == (256, 0.21)  # more points gain nothing, fewer are worse
    assert (row["tolerance"], row["error"]) == (0.01, 0.02)
    assert row["ratio"] == pytest.approx(15)


def test_indenters_without_a_comparison_are_left_out():
    no_lines = [("cone", 65, *row[2:]) for row in DISC if row[2] != "MDR"]
    too_accurate = [("sphere", 65, "MDR", "model", 64, 1e-9, 0.001), *[("sphere", 65, *row[2:]) for row in DISC[3:]]]
    assert equal_error(methods(no_lines + too_accurate)).empty
