"""Cost and error of every method on a small disc."""

from dataclasses import replace

import numpy as np
import pytest

from viscorough.viscous.integration.events import march_events
from viscorough_study.performance import measurement, methods, problems


@pytest.fixture(scope="module")
def problem():
    return problems.rough_problem(0.7, 17, 6, 1)


@pytest.fixture(scope="module")
def few_values():
    """Every method with a fine value of its parameter; where there are many, not the finest one."""
    place = {method.name: -1 if len(method.values) < 4 else -2 for method in methods.METHODS}
    return [replace(method, values=(method.values[place[method.name]],)) for method in methods.METHODS]


@pytest.fixture(scope="module")
def table(problem, few_values):
    return measurement.measure(problem, 1, few_values)


def test_velocities_to_compare_with_are_those_of_the_direct_integration(problem):
    events = march_events(problem.indenter, until_fraction=0.7)
    here = problem.force < events.impulse[-1]
    last = np.searchsorted(events.impulse, problem.force[here], side="right") - 1
    np.testing.assert_allclose(problem.force[here] / events.resistance[last], problem.velocity[here], rtol=1e-9)
    assert here.sum() >= 4


def test_every_method_has_a_row_for_every_value(table, few_values):
    assert list(table.columns) == list(measurement.COLUMNS)
    assert set(zip(table["method"], table["value"], strict=True)) == {
        (method.name, float(value)) for method in few_values for value in method.values
    }
    assert (table[["wall_s", "processor_s"]] > 0).all(axis=None)
    for method in ("MDR", "Eq. 12 with Γ", "Eq. 12 without Γ"):
        assert table[table["method"] == method]["error"].min() > 0.01
    assert table["error"].between(0, 1).all()


@pytest.mark.parametrize(
    ("methods", "value", "error"),
    [
        (["at the depths", "no preconditioner", "double precision", "no tangent", "each depth alone"], 1e-9, 1e-8),
        (["automatic levels"], 1e-4, 5e-3),
        (["events"], 1.0, 1e-9),
        (["implicit"], 1e-6, 1e-4),
        (["explicit, logarithmic steps", "heun, logarithmic steps"], 256, 0.05),
    ],
)
def test_exact_methods_are_exact_at_their_finest(table, methods, value, error):
    for method in methods:
        row = table[(table["method"].str.removeprefix("path, ") == method) & (table["value"] == value)]
        assert row["error"].item() < error, method


def test_a_missing_velocity_counts_as_an_error_of_one(problem):
    velocity = np.where(np.arange(6) < 3, problem.velocity, np.nan)
    row = measurement.errors_and_costs(problem, methods.METHODS[0], 1, methods.Answer(velocity), 0)
    assert row["error"] == pytest.approx(0.5**0.5)


def test_only_methods_that_apply_and_end_in_time_are_measured():
    sphere = problems.named_problem("sphere", 17, 3)
    small = replace(methods.METHODS[1], values=(1e-3,), largest=16)
    rough = replace(methods.METHODS[1], values=(1e-3,), rough_only=True)
    kept = replace(methods.METHODS[1], name="kept", values=(1e-3,))
    assert measurement.measure(sphere, 1, [small, rough, kept])["method"].tolist() == ["kept"]


def test_what_takes_as_long_as_allowed_is_not_tried_at_finer_values():
    def run(problem, seconds):
        calls.append(seconds)
        return methods.Answer(problem.velocity, seconds=(seconds, seconds))

    calls, sphere = [], problems.named_problem("sphere", 17, 3)
    slow = replace(methods.METHODS[1], values=(0.0, 0.6, 0.7), run=run)
    table = measurement.measure(sphere, 1, [slow], longest=0.6)
    assert table["value"].tolist() == [0.0, 0.6]
    assert calls == [0.0, 0.6, 0.0]  # the slow one is not repeated either
