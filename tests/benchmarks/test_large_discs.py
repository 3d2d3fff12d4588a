"""Cost of one disc on grids from coarse to fine: the table, each row from a separate process, and its figure."""

import re

import large_discs
import numpy as np
import pandas as pd
import pytest
from click.testing import CliRunner

from support.figures import drawn_points, published, whole_on_page

pytestmark = pytest.mark.long


def test_discs_from_coarse_to_fine_are_in_the_table(tmp_path, monkeypatch):
    monkeypatch.setattr(large_discs, "ELEMENTS", (17, 33, 513))
    table, figure = tmp_path / "tables/large.csv", tmp_path / "figures/large.png"
    paths = ["--output", str(table), "--figure", str(figure)]
    done = CliRunner().invoke(large_discs.main, [*paths, "--largest", "257", "--until-fraction", "0.1"])
    assert done.exit_code == 0, done.output
    costs = pd.read_csv(table)
    assert list(costs.columns) == list(large_discs.COLUMNS)
    assert costs["across"].tolist() == [17, 33]
    assert costs["threads"].tolist() == [2, 2]
    assert (costs[["wall", "wall_threads"]] > 0).all(axis=None)
    assert (costs["memory"] > 1e7).all()
    assert all(figure.with_suffix(kind).stat().st_size > 5000 for kind in (".png", ".pdf")), "more than axes"


@pytest.mark.filterwarnings("error")
def test_figure_shows_the_numbers_of_its_table_and_the_exponents_of_its_lines():
    table = published("large")
    figure = large_discs.plot_large(table)
    assert whole_on_page(figure)
    for axes, columns in zip(figure.axes, ({"processor": 1, "wall_threads": 1}, {"memory": 1e-9}), strict=True):
        shown = drawn_points(axes)
        for name, unit in columns.items():
            expected = np.column_stack([table["elements"], unit * table[name]])[:, None]
            assert np.isclose(shown, expected, rtol=1e-9).all(axis=2).any(axis=1).all()
        for line in axes.lines:
            if stated := re.search(r"exponent ([\d.]+)", line.get_label()):
                assert np.polyfit(*np.log(line.get_data()), 1)[0] == pytest.approx(float(stated[1]), abs=0.006)
