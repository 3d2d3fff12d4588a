"""The cheapest sufficient model: the fastest within the error at every Hurst exponent, or the closest."""

import numpy as np
import pandas as pd

from viscorough_study.comparisons.sufficient_models import sufficient_models


def one_surface(rows):
    columns = ["hurst", "model", "across", "parameter", "value", "processor_s", "error", "stated"]
    return pd.DataFrame(rows, columns=columns).assign(quantity="velocity", surfaces=2)


def grids(*, coarse=(0.15, 0.25)):
    full = [(hurst, "grid", 513, "tolerance", 1e-3, 9.0, 0.0, 0.04) for hurst in (0.4, 0.8)]
    rows = [(0.4, "grid", 33, "tolerance", 0.1, 0.01, coarse[0], np.nan)]
    rows += [(0.8, "grid", 33, "tolerance", 0.1, 0.02, coarse[1], np.nan)]
    rows += [(hurst, "grid", 129, "tolerance", 0.1, 0.1, 0.06, np.nan) for hurst in (0.4, 0.8)]
    rows += [(0.4, "MDR", np.nan, "points", 256, 0.001, 0.1, np.nan)]  # not measured at 0.8
    rows += [(hurst, "law", np.nan, np.nan, np.nan, 0.0, 0.21, np.nan) for hurst in (0.4, 0.8)]
    return one_surface(full + rows)


NO_MEANS = pd.DataFrame(columns=["hurst", "quantity", "model", "across", "surfaces", "processor_s", "error"])


def chosen(table):
    rows = sufficient_models(table, NO_MEANS)
    return rows.set_index("allowed")


def test_the_worst_hurst_exponent_decides_on_error_and_time():
    rows = chosen(grids())
    assert rows.loc[0.2, ["model", "setting"]].tolist() == ["viscorough.indent", "129 × 129 points, tolerance=0.1"]
    assert rows.loc[0.2, ["error", "processor_s"]].tolist() == [0.06, 0.1]
    assert set(rows.index) == {0.2, 0.1, 0.05, 0.01}
    rows = chosen(grids(coarse=(0.15, 0.19)))
    assert rows.loc[0.2, "setting"] == "33 × 33 points, tolerance=0.1"
    assert rows.loc[0.2, "hurst"] == "0.4, 0.8"


def test_means_are_answered_by_the_model_without_cost_where_it_suffices():
    rows = [(0.4, "law", np.nan, 0, 0.0, 0.03), (0.4, "grid", 65.0, 64, 2.0, 0.02), (0.4, "grid", 65.0, 1, 0.1, 0.3)]
    means = pd.DataFrame(rows, columns=["hurst", "model", "across", "surfaces", "processor_s", "error"])
    for error, setting in ((0.03, ""), (0.06, "64 discs of 65 × 65 points")):
        changed = means.assign(quantity="velocity", error=means["error"].mask(means["model"] == "law", error))
        table = sufficient_models(one_surface([]), changed)
        (row,) = table.query("question == 'mean velocity' and allowed == 0.05").to_dict("records")
        assert (row["setting"], row["error"]) == (setting, 0.02 if setting else 0.03)
