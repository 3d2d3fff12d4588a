"""Measurements of the grid error: true errors against their definition, and the table of the command."""

import grid_errors
import numpy as np
import pandas as pd
import pytest
from click.testing import CliRunner

from viscorough import indent


def run(path, **options):
    arguments = [text for name, value in (options | {"output": path}).items() for text in (f"--{name}", str(value))]
    done = CliRunner().invoke(grid_errors.main, arguments)
    assert done.exit_code == 0, done.output
    return pd.read_csv(path)


@pytest.mark.parametrize("kind", grid_errors.KINDS)
def test_every_fourth_point_of_a_fine_disc_has_the_requested_size(kind):
    fine = grid_errors.fine_disc(0.5, 16, kind, seed=np.random.SeedSequence(1))
    coarse = grid_errors.sampled(fine, grid_errors.FINER)
    assert coarse.heights.shape == ((8, 16) if kind == "rectangles" else (16, 16))
    assert coarse.aspect == (2 if kind == "rectangles" else 1)
    assert np.nanstd(fine.heights) == pytest.approx(1, rel=0.05)


def test_coverage_has_all_kinds_and_true_errors(tmp_path, monkeypatch):
    table = run(tmp_path / "coverage.csv", surfaces=12, across=13, cores=1)
    assert set(table["kind"]) == set(grid_errors.KINDS)
    assert table["number"].nunique() == 12
    row = table[(table["number"] == 4) & (table["x"] == 0.3)].iloc[0]
    fine = grid_errors.fine_disc(row["hurst"], 13, row["kind"], grid_errors.seed_of("test", 4))
    coarse = grid_errors.sampled(fine, grid_errors.FINER)
    force = grid_errors.force_scale(coarse) * np.geomspace(0.3 / np.sqrt(10), 0.3 * np.sqrt(10), 301)
    curve, truth = indent(coarse), indent(fine)
    velocity = np.log(truth.at_force(force)[1] / curve.at_force(force)[1])
    assert row["velocity_true"] == pytest.approx(np.sqrt(np.nanmean(velocity**2)), rel=0.05)
    assert row["velocity_stated"] > 0
