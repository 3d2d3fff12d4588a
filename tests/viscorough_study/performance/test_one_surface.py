"""Models of one surface: errors against its own full map, and their averages over surfaces."""

import numpy as np
import pandas as pd
import pytest

from viscorough.surfaces.self_affine import self_affine_disc
from viscorough_study.performance import one_surface


@pytest.fixture(scope="module")
def table():
    return one_surface.measure_one_surface(hurst=[0.4, 0.8], elements=65, surfaces=2, seed=1)


def test_every_model_is_measured_on_every_surface(table):
    assert list(table.columns) == list(one_surface.COLUMNS)
    assert (table["surfaces"] == 2).all()
    velocity = table.query("quantity == 'velocity'")
    models = {"grid": 1 + 2 * 3, "MDR": 4, "law": 1}  # the full map, and two coarser grids
    for _, rows in velocity.groupby("hurst"):
        assert rows["model"].value_counts().to_dict() == models
    assert (table.query("model != 'law'")["processor_s"] > 0).all()
    assert (table.query("model == 'law'")["processor_s"] == 0).all()


def test_errors_vanish_on_the_full_map_and_grow_with_the_spacing(table):
    grids = table.query("quantity == 'velocity' and model == 'grid' and value == 1e-3")
    for _, rows in grids.groupby("hurst"):
        errors = rows.set_index("across")["error"]
        assert errors[65] == 0
        assert 0 < errors[33] < errors[17]
    assert (grids.query("across == 65")["stated"] > 0).all()


@pytest.mark.parametrize("hurst", [0.05, 1.0])
def test_law_has_no_error_outside_its_calibration(hurst):
    """At H = 0.05 the law has no constants; at H = 1 it is not confirmed at the smallest X of the comparison."""
    table = one_surface.measure_one_surface(hurst=[hurst], elements=65, surfaces=1, seed=1)
    assert set(table[table["error"].isna()]["model"]) == {"law"}


def test_pressures_have_the_error_of_the_tolerance_on_a_map_too_large_for_dense_solutions():
    disc = self_affine_disc(0.8, 257, seed=1)
    errors = {row["value"]: row["error"] for row in one_surface._pressure_rows(disc)}
    assert 0.3 > errors[1e-1] > errors[1e-2] > errors[1e-3] > 1e-6


def test_averages_are_root_mean_squares_and_medians():
    shared = {"hurst": 0.4, "quantity": "velocity", "parameter": "tolerance", "value": 0.1, "model": "grid"}
    rows = [(0, 1.0, 0.03, 0.1), (1, 2.0, 0.04, 0.2), (2, 6.0, 0.0, 0.3)]
    columns = ["surface", "processor_s", "error", "stated"]
    (row,) = one_surface.averaged(pd.DataFrame(rows, columns=columns).assign(across=33, **shared)).to_dict("records")
    assert (row["across"], row["processor_s"], row["surfaces"]) == (33, 2.0, 3)
    assert row["error"] == pytest.approx(np.sqrt((0.03**2 + 0.04**2) / 3))
    assert row["stated"] == pytest.approx(0.2)
