"""Light loads on square maps: the load for a contact fraction, its solution, and the table."""

import numpy as np
import pytest

from viscorough.contact import ranking
from viscorough.contact.one_contact import contact_at
from viscorough_study.performance import light_contact


@pytest.fixture(scope="module")
def table():
    """Two loads on a map of 64 x 64 elements and one on a smaller one; no other solver."""
    race = {"elements": [64], "fractions": [0.02, 0.1]}
    settings = {"elements": [32, 64], "fractions": [0.02], "threads": [1], "residual": 1e-5}
    return light_contact.time_light_contact(seed=1, hurst=0.8, race=race, pairs=1, peers={}, **settings)


def test_maps_of_the_growth_and_of_the_race_are_all_in_the_table(table):
    assert list(table.columns) == list(light_contact.COLUMNS)
    rows = [tuple(row) for row in table[["elements", "fraction"]].to_numpy()]
    assert rows == [(32, 0.02), (64, 0.02), (64, 0.1)]
    assert (table["met"] == 1).all()
    assert (table["residual"] > 0).all()


def test_a_load_gives_the_contact_fraction_that_it_was_chosen_for(monkeypatch):
    heights = np.random.default_rng(3).standard_normal((48, 48))
    indenter = light_contact.Indenter(heights, 0.5)
    load = light_contact.light_load(0.8, indenter, 0.03, 1e-5, [1])
    contact = contact_at(indenter, force=load.force, tolerance=1e-5)
    assert contact.contact_fraction == pytest.approx(0.03, rel=0.1)
    assert contact.depth == pytest.approx(load.depths[0], rel=0.01)
    outcome = load.outcome(load.solve(1))
    assert 0 < outcome.residual.max() <= 1e-5
    np.testing.assert_allclose(outcome.force, load.exact_forces(), rtol=1e-12)
    monkeypatch.setattr(ranking, "_LEAST", 1)
    assert load.rank().initial_gap.size == np.count_nonzero(indenter.initial_gap <= load.depths[0]) < heights.size
