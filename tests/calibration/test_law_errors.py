"""Test of the calibrated law on fresh discs: the table of the command, and errors of given distributions."""

import law_errors
import numpy as np
import pandas as pd
import pytest
from click.testing import CliRunner

from support.documentation import ROOT
from viscorough.law.calibrated_law import interface_depth, interface_velocity, penetration_law

X = np.array([0.01, 0.1, 1.0])


def run(output, **options):
    arguments = [text for name, value in (options | {"output": output}).items() for text in (f"--{name}", str(value))]
    done = CliRunner().invoke(law_errors.main, arguments)
    assert done.exit_code == 0, done.output
    return pd.read_csv(output)


def test_command_writes_errors(tmp_path, monkeypatch):
    monkeypatch.setattr(law_errors, "ACROSS", (9, 17))
    samples = {2000: {0.4: (60, 40), 0.9: (60, 40)}, 3000: {0.4: (60, 30), 0.7: (60, 30)}}
    monkeypatch.setattr(law_errors, "DISCS", samples)
    errors = run(tmp_path / "two.csv", discs=10, cores=2)
    assert list(errors) == list(law_errors.COLUMNS)
    groups = errors.groupby(["hurst", "across"])
    assert groups["discs"].first().tolist() == [12, 7, 6, 3, 6, 4]
    for (hurst, _), group in groups:
        law = penetration_law(hurst)
        assert group["x"].min() == pytest.approx(law.x_low, rel=1e-3)
        assert group["x"].max() == pytest.approx(10**1.1)
    monkeypatch.setattr(law_errors, "DISCS", samples | {3000: {0.4: (60, 30)}})
    again = run(tmp_path / "one.csv", discs=10, cores=1)
    pd.testing.assert_frame_equal(again[again["hurst"] == 0.4], errors[errors["hurst"] == 0.4])


def test_errors_are_the_law_over_the_mean(monkeypatch):
    monkeypatch.setattr(law_errors, "TESTED", X)
    constants = penetration_law(0.5).constants
    law = X + np.array([interface_velocity(X, *constants), interface_depth(X, *constants)])
    factor = np.exp(0.15 * np.random.default_rng(2).standard_normal((600, 2, 1)))
    table = law_errors.errors(0.5, 129, 1.1 * law * factor - X)
    for name in ("velocity", "depth"):
        assert table[f"{name}_error"].to_numpy() == pytest.approx(1 / 1.1 - 1, abs=0.03)
        assert table[f"{name}_standard_error"].to_numpy() == pytest.approx(0.15 / np.sqrt(600), rel=0.1)


def test_law_is_within_its_stated_error_on_fresh_discs():
    """The grid is the grid of the law. Errors may exceed the stated ones by two standard errors of their mean."""
    table = pd.read_csv(ROOT / "docs/results/law_errors.csv").query("across == 257")
    for name in ("velocity", "depth"):
        stated = table["hurst"].map(lambda hurst, name=name: getattr(penetration_law(hurst), f"{name}_error"))
        assert (table[f"{name}_error"].abs() <= stated + 2 * table[f"{name}_standard_error"]).mean() >= 0.95
