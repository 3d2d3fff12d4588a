"""Cost of one disc on grids from coarse to fine, each from a separate process."""

import large_discs
import pytest
from click.testing import CliRunner

from viscorough_study.run.tables import read_table

pytestmark = pytest.mark.long


def test_discs_from_coarse_to_fine_are_in_the_table(tmp_path, monkeypatch):
    monkeypatch.setattr(large_discs, "ELEMENTS", (17, 33, 513))
    table = tmp_path / "tables/large.csv"
    done = CliRunner().invoke(large_discs.main, ["--output", str(table), "--largest", "257", "--until-fraction", "0.1"])
    assert done.exit_code == 0, done.output
    costs = read_table(table)
    assert list(costs.columns) == list(large_discs.COLUMNS)
    assert costs["across"].tolist() == [17, 33]
    assert costs["threads"].tolist() == [2, 2]
    assert (costs[["wall", "wall_threads"]] > 0).all(axis=None)
    assert (costs["memory"] > 1e7).all()
