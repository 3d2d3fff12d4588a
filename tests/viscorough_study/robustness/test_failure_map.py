"""The failure map on a reduced set of tests: exact methods hold or refuse, and every failure is noticed."""

import numpy as np
import pytest

from viscorough.surfaces.self_affine import self_affine_disc
from viscorough_study.robustness.failure_map import COLUMNS, failure_map
from viscorough_study.robustness.outcomes import VERDICTS, wrong_without_warning
from viscorough_study.robustness.stress_solutions import METHODS
from viscorough_study.robustness.stress_tests import StressTest, stress_tests

NUMERICAL = ["boundary elements", "direct integration"]
REFUSED = {"negative for a while", "1e-14"}


@pytest.fixture(scope="module")
def table():
    tests = stress_tests(np.random.SeedSequence(3), 9, (9,), hurst_min=0.4)
    return failure_map(tests)


def test_every_cell_has_a_number_and_a_verdict_and_nothing_fails_unnoticed(table):
    assert len(table) == len(table[["group", "test"]].drop_duplicates()) * len(METHODS)
    assert np.isfinite(table["error"]).all()
    assert set(table["verdict"]) <= set(VERDICTS) - {"unnoticed"}
    assert (table["reason"] != "")[table["verdict"].isin(["refused", "warned", "stated"])].all()


@pytest.mark.parametrize("method", NUMERICAL)
def test_numerical_methods_hold_or_refuse(table, method):
    rows = table.query("method == @method")
    others = rows[rows["verdict"] != "holds"]
    assert set(others["test"]) <= REFUSED
    assert set(others["verdict"]) == {"refused"}


def test_failures_of_explicit_steps_are_warned_of(table):
    steps = table.query("group == 'step size' and method == 'explicit steps'").set_index("test")
    assert steps.loc["one step", "verdict"] == "warned"
    assert steps.loc["one step", "error"] > 0.1
    assert "overlaps the surface" in steps.loc["one step", "reason"]
    assert steps.loc["256 steps", "error"] < steps.loc["16 steps", "error"]


def test_reduction_is_exact_for_a_body_of_revolution_and_stated_not_to_be_for_others(table):
    reduction = table.query("method == 'MDR' and group == 'shape'").set_index("test")
    assert reduction.loc["sphere", "error"] < 0.2  # of so few elements; validation has the order
    assert set(reduction.loc[["ridge", "tilted plane"], "verdict"]) == {"stated"}


def test_forces_that_pull_are_refused_with_the_reason(table):
    pulling = table.query("test == 'negative for a while'")
    assert set(pulling["verdict"]) == {"refused"}
    assert pulling["reason"].str.contains("without adhesion a pull opens the contact").all()


def test_a_failure_that_users_are_not_told_of_is_unnoticed():
    """With a limit below zero no result holds, and nothing is said."""
    strict = {"boundary elements": (METHODS["boundary elements"][0], lambda test: -1.0, ())}
    table = failure_map([StressTest("", "", self_affine_disc(0.7, 13, seed=1))], strict)
    assert list(table.columns) == list(COLUMNS)
    assert table["verdict"].tolist() == ["unnoticed"]
    assert wrong_without_warning(table) == (0, 1)
