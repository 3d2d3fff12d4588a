"""Cost and error of every method on a small disc."""

from dataclasses import replace

import numpy as np
import pytest

from viscorough.viscous.integration.events import newtonian_events
from viscorough_study.performance import measurement, methods, problems


@pytest.fixture(scope="module")
def problem():
    return problems.named_problem("rough disc", 17, 6, root=1, hurst=0.7)


@pytest.fixture(scope="module")
def few_values():
    """Return every method with a fine value of its parameter, but not the finest if it has many values."""
    place = {method.name: -1 if len(method.values) < 4 else -2 for method in methods.METHODS}
    return [replace(method, values=(method.values[place[method.name]],)) for method in methods.METHODS]


@pytest.fixture(scope="module")
def table(problem, few_values):
    return measurement.measure(problem, 1, longest=np.inf, methods=few_values)


def test_reference_velocities_agree_with_direct_integration(problem):
    events = newtonian_events(problem.indenter, until_fraction=0.7)
    here = problem.force < events.impulse[-1]
    last = np.searchsorted(events.impulse, problem.force[here], side="right") - 1
    np.testing.assert_allclose(problem.force[here] / events.resistance[last], problem.velocity[here], rtol=1e-9)
    assert here.sum() >= 4


def test_every_method_has_a_row_and_a_small_error_at_a_fine_value(table, few_values):
    assert list(table.columns) == list(measurement.COLUMNS)
    assert table["value"].tolist() == [method.values[0] for method in few_values]
    assert (table[["wall_s", "processor_s"]] > 0).all(axis=None)
    limits = {"path, at the depths": 1e-8, "path, automatic levels": 5e-3, "events": 1e-9}
    limits["explicit, logarithmic steps"] = 0.05
    for row in table.itertuples():
        assert row.error < limits[row.method] if row.group != "model" else 0.01 < row.error < 1, row.method
