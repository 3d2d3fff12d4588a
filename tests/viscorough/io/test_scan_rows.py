"""Rows of a file of heights in a table of loads: grid errors, failures and warnings."""

from pathlib import Path

import numpy as np
import pytest

from viscorough import Indenter, indent, self_affine_disc
from viscorough.basics.errors import AccuracyWarning
from viscorough.io.load_tables import LoadRows
from viscorough.io.scan_rows import evaluated, rows_at_loads
from viscorough.surfaces.preparation import doubts

GRID_ERRORS = ["grid_error", "force_grid_error", "area_change"]


@pytest.mark.parametrize(("hurst", "seed"), [(0.5, 2), (0.8, 0), (0.8, 3)])
def test_grid_error_of_a_single_load_is_that_of_the_whole_curve(hurst, seed):
    """At a single force the curves of both grids can agree by chance, so that their difference says nothing."""
    disc = self_affine_disc(hurst, 129, rms=0.02, seed=seed)
    curve = indent(disc, until_fraction=0.3, estimate_grid_error=True)
    for share in (0.1, 0.3, 0.6):
        force = share * curve.force[-1]
        (row,), units = rows_at_loads(disc, force=[force], grid_error=True)
        assert [units[name] for name in GRID_ERRORS] == ["1", "1", "1"]
        expected = np.exp(np.interp(np.log(force), np.log(curve.force), np.log(curve.grid_error)))
        assert 0.5 * expected < row["grid_error"] < 2 * expected


def test_grid_errors_change_no_other_number():
    disc = self_affine_disc(0.8, 65, rms=0.02, length_unit="um", seed=1)
    rows, _ = rows_at_loads(disc, depth=[0.01, 0.02, 0.0201])
    more, _ = rows_at_loads(disc, depth=[0.01, 0.02, 0.0201], grid_error=True)
    assert [{name: row[name] for name in row if name not in GRID_ERRORS} for row in more] == rows


def test_progress_of_contacts_and_grid_errors_rises_to_one():
    done = []
    rows_at_loads(self_affine_disc(0.8, 33, seed=1), force=[0.1, 0.2], grid_error=True, progress=done.append)
    assert done == sorted(done)
    assert done[-1] == pytest.approx(1.0)


def test_failures_and_warnings_become_texts_without_the_path():
    def fail():
        raise ValueError("a.csv: it is empty.")

    scan = LoadRows("a.csv", "12")
    result = evaluated(scan, Path("a.csv"), fail, rows_at_loads)
    assert result == scan._replace(error="it is empty")
    result = evaluated(scan, Path("a.csv"), lambda: None, lambda indenter: indenter.heights)
    assert result.error.startswith("AttributeError: ")

    def evaluate(indenter):
        assert doubts(indenter) == []
        import warnings

        for _ in range(2):
            warnings.warn("a.csv: tilted", AccuracyWarning, stacklevel=1)
        return rows_at_loads(indenter, force=[0.1])

    result = evaluated(scan, Path("a.csv"), lambda: Indenter(-np.eye(9), 1.0), evaluate)
    assert (result.error, result.warnings, len(result.rows)) == ("", "tilted", 1)
