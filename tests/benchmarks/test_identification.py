"""Coverage of the intervals of fitted media: one row for each medium, number of rows and noise level."""

import dataclasses

import identification
import pandas as pd
import pytest
from click.testing import CliRunner

from viscorough import Newtonian

pytestmark = pytest.mark.long


def test_coverage_has_a_row_for_every_case_whatever_the_number_of_processes(tmp_path, monkeypatch):
    monkeypatch.setattr(identification, "MEDIA", {"newtonian": Newtonian(3.0), "solid": identification.MEDIA["solid"]})
    tables = []
    for cores in (2, 1):
        output = tmp_path / f"tables/{cores}.csv"
        options = ["--trials", "6", "--rows", "20", "--load", "ramp", "--noise", "1e-3", "--noise", "1e-2"]
        done = CliRunner().invoke(identification.main, [*options, "--cores", str(cores), "--output", str(output)])
        assert done.exit_code == 0, done.output
        tables.append(pd.read_csv(output))
    table, again = tables
    pd.testing.assert_frame_equal(table, again)
    assert list(table) == list(identification.COLUMNS)
    cases = [("newtonian", 1e-3), ("newtonian", 1e-2), ("solid", 1e-3), ("solid", 1e-2)]
    assert list(zip(table["medium"], table["noise"], strict=True)) == cases
    assert (table["coverage"] > 0.8).all()
    assert table["scatter"].between(0.3, 3).all(), "the scatter found is that of the noise"


def test_intervals_that_miss_are_counted(monkeypatch):
    """Intervals of a hundredth of their true width contain few of the compliances."""
    identify = identification.identify_medium

    def narrow(*record, **options):
        found = identify(*record, **options)
        middle, half = (found.low + found.high) / 2, (found.high - found.low) / 200
        return dataclasses.replace(found, low=middle - half, high=middle + half)

    monkeypatch.setattr(identification, "identify_medium", narrow)
    row = identification.coverage(("solid", "step", 20, 1e-2), trials=3)
    assert row["coverage"] < 0.5
