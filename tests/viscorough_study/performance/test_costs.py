"""The Pareto front, and the fastest methods that reach an error."""

import pandas as pd

from viscorough_study.performance.costs import fastest, pareto_front

TABLE = pd.DataFrame(
    [("path", 1.0, 1e-1), ("path", 2.0, 1e-3), ("path", 5.0, 1e-5), ("marching", 3.0, 1e-2), ("model", 0.1, 0.3)],
    columns=["group", "wall_s", "error"],
)


def test_no_row_beats_the_front():
    assert pareto_front(TABLE)["wall_s"].tolist() == [0.1, 1.0, 2.0, 5.0]


def test_fastest_methods_of_each_group_reach_the_error():
    best = fastest(TABLE, 1e-2)
    assert {group: row["wall_s"] for group, row in best.items()} == {"path": 2.0, "marching": 3.0}
    assert fastest(TABLE, 1e-9) == {}
