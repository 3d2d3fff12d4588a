"""Test of the calibrated law on fresh discs: the tables of the command, and intervals of given distributions."""

import law_errors
import law_scatter
import numpy as np
import pandas as pd
import pytest
from click.testing import CliRunner
from law_scatter import calibrated_scatter, law_at, quantile
from scipy.stats import norm

from support.documentation import ROOT
from viscorough.law.calibrated_law import SCATTER_COLUMNS, penetration_law, relative_interval

X = np.array([0.01, 0.1, 1.0])


def scattered(hurst, discs, seed, scatter):
    """Return parts of discs whose vt/h and u/h are the law times exp(scatter H z), with normal z."""
    factor = np.exp(scatter * hurst * np.random.default_rng(seed).standard_normal((discs, 2, 1)))
    return law_at(hurst, X) * factor - X


def run(folder, **options):
    files = {"output": folder / "errors.csv", "scatter": folder / "scatter.csv"}
    arguments = [text for name, value in (options | files).items() for text in (f"--{name}", str(value))]
    done = CliRunner().invoke(law_errors.main, arguments)
    assert done.exit_code == 0, done.output
    return [pd.read_csv(file) for file in files.values()]


def test_command_writes_errors_and_intervals(tmp_path, monkeypatch):
    monkeypatch.setattr(law_errors, "ACROSS", (9, 17))
    monkeypatch.setattr(law_errors, "SCATTER", {0.4: (60, 40), 0.9: (60, 40)})
    monkeypatch.setattr(law_errors, "TEST", {0.4: (60, 30), 0.7: (60, 30)})
    errors, scatter = run(tmp_path / "two", discs=10, cores=2)
    assert list(errors) == list(law_errors.COLUMNS)
    assert list(scatter) == list(SCATTER_COLUMNS)
    groups = errors.groupby(["hurst", "across"])
    counts = groups[["discs", "tested"]].first().itertuples(name=None)
    assert [row[1:] for row in counts] == [(12, 6), (7, 3), (6, 6), (3, 3), (6, 0), (4, 0)]
    assert errors["velocity_coverage"].isna().equals(errors["tested"] == 0)
    for (hurst, _), group in groups:
        law = penetration_law(hurst)
        assert group["x"].min() == pytest.approx(law.x_low, rel=1e-3)
        assert group["x"].max() == pytest.approx(10**1.1)
    monkeypatch.setattr(law_errors, "TEST", {0.4: (60, 30)})
    again, same = run(tmp_path / "one", discs=10, cores=1)
    pd.testing.assert_frame_equal(again[again["hurst"] == 0.4], errors[errors["hurst"] == 0.4])
    pd.testing.assert_frame_equal(same, scatter)


def test_help_names_both_files():
    done = CliRunner().invoke(law_errors.main, ["--help"])
    assert done.exit_code == 0
    assert "--output" in done.output
    assert "--scatter" in done.output


def test_quantiles_follow_a_scatter_that_depends_on_hurst():
    hurst = np.repeat([0.1, 0.4, 0.7, 1.0], 1000)
    values = hurst**2 + (1 + hurst) * np.random.default_rng(1).standard_normal(hurst.size)
    at = np.array([0.2, 0.8])
    for probability in (0.025, 0.975):
        expected = at**2 + (1 + at) * norm.ppf(probability)
        found = quantile(hurst, values, np.ones(hurst.size), probability, at)
        assert found == pytest.approx(expected, abs=0.2)


def test_errors_are_the_law_over_the_mean_and_coverage_the_share_in_the_interval(monkeypatch):
    monkeypatch.setattr(law_errors, "TESTED", X)
    scatter = calibrated_scatter({(hurst, 129): scattered(hurst, 600, 1, 0.3) for hurst in (0.4, 0.6, 0.9)}, X)
    parts = scattered(0.5, 600, 2, 0.3) * 1.1 + 0.1 * X
    table = law_errors.errors(0.5, 129, parts, parts, scatter)
    assert table["velocity_error"].to_numpy() == pytest.approx(1 / 1.1 - 1, abs=0.03)
    assert table["velocity_standard_error"].to_numpy() == pytest.approx(0.15 / np.sqrt(600), rel=0.1)
    ends = norm.ppf(list(law_scatter.ENDS.values()))
    low, high = norm.cdf(ends - np.log(1.1) / 0.15)
    for name in ("velocity", "depth"):
        assert table[f"{name}_coverage"].to_numpy() == pytest.approx(high - low, abs=0.04)
        assert relative_interval(scatter, name, 0.5, 1.0) == pytest.approx(np.exp(0.15 * ends), rel=0.04)


# The published table of `make law-errors`, on the grid of the law, from X = 0.003 on.
PUBLISHED = pd.read_csv(ROOT / "docs/results/law_errors.csv").query("x > 0.003")


def test_most_single_discs_lie_in_their_interval():
    """The interval was calibrated on other discs. It should contain 95 % of them."""
    tested = PUBLISHED.query("tested > 0").groupby(["hurst", "across"])[["velocity_coverage", "depth_coverage"]].mean()
    assert set(tested.index.get_level_values("across")) == {129, 257}
    assert tested.stack().between(0.9, 0.98).all()


def test_law_is_within_its_stated_error_on_fresh_discs():
    """The grid is the grid of the law. Errors may exceed the stated ones by two standard errors of their mean."""
    table = pd.read_csv(ROOT / "docs/results/law_errors.csv").query("across == 257")
    for name in ("velocity", "depth"):
        stated = table["hurst"].map(lambda hurst, name=name: getattr(penetration_law(hurst), f"{name}_error"))
        assert (table[f"{name}_error"].abs() <= stated + 2 * table[f"{name}_standard_error"]).mean() >= 0.95
