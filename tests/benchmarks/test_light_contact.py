"""Light loads on square maps: the load for a contact fraction, its solution, the table, and its figure."""

import re
from unittest.mock import patch

import light_contact
import numpy as np
import other_solvers
import pandas as pd
import pytest
from click.testing import CliRunner

from support.figures import published, whole_on_page
from viscorough import Indenter, contact_at


def test_table_has_the_maps_of_the_cost_exponents_and_of_the_race(tmp_path):
    """The test is small: two loads on a map of 64 x 64 elements, one load on a smaller map, and no other solver."""
    table, figure = tmp_path / "tables/light.csv", tmp_path / "figures/light.png"
    small = {"ELEMENTS": (32, 64), "FRACTIONS": (0.02,), "RACE_ELEMENTS": (64,), "RACE_FRACTIONS": (0.02, 0.1)}
    with (
        patch.multiple(light_contact, **small, THREADS=(1,), PAIRS=1),
        patch.object(other_solvers, "ROOT", tmp_path),
    ):
        done = CliRunner().invoke(light_contact.main, ["--output", str(table), "--figure", str(figure)])
    assert done.exit_code == 0, done.output
    assert "Tamaas is not installed and is omitted" in done.output
    table = pd.read_csv(table)
    assert list(table.columns) == list(light_contact.COLUMNS)
    rows = [tuple(row) for row in table[["elements", "fraction"]].to_numpy()]
    assert rows == [(32, 0.02), (64, 0.02), (64, 0.1)]
    assert (table["met"] == 1).all()
    assert (table[["residual", "wall_s", "over_depth", "ranking_s"]] > 0).all(axis=None)
    assert all(figure.with_suffix(kind).stat().st_size > 5000 for kind in (".png", ".pdf")), "more than axes"


def test_load_gives_the_requested_contact_fraction(monkeypatch):
    monkeypatch.setattr(light_contact, "RESIDUAL", 1e-5)
    heights = np.random.default_rng(3).standard_normal((48, 48))
    indenter = Indenter(heights, 0.5)
    load = light_contact.light_load(indenter, 0.03)
    contact = contact_at(indenter, force=load.forces[0], tolerance=1e-5)
    assert contact.contact_fraction == pytest.approx(0.03, rel=0.1)
    assert contact.depth == pytest.approx(load.depths[0], rel=0.01)
    residual, force, _ = load.outcome(load.solve(1))
    assert 0 < residual.max() <= 1e-5
    np.testing.assert_allclose(force, load.forces, rtol=1e-12)
    assert load.rank().initial_gap.size == np.count_nonzero(indenter.initial_gap <= load.depths[0]) < heights.size


@pytest.mark.filterwarnings("error")
def test_figure_shows_the_exponents_of_its_lines():
    """The exponents are fitted to the larger half of the maps."""
    figure = light_contact.plot_light_contact(published("light_contact"))
    assert whole_on_page(figure)
    for line in figure.axes[0].lines[:-1]:
        x, y = np.split(np.log(line.get_data()), 2, axis=1)[1]
        stated = re.search(r"N\^\{([\d.]+)", line.get_label())[1]
        assert np.polyfit(x, y, 1)[0] == pytest.approx(float(stated), abs=0.006)
    with pytest.raises(ValueError, match="plot_light_contact: the table has no rows"):
        light_contact.plot_light_contact(published("light_contact")[:0])
