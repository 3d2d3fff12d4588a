"""Models of one surface: errors against its own full map, and their averages over surfaces."""

import pytest

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
