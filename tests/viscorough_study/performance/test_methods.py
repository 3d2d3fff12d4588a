"""Ablations of the elastic loading path leave it as it was."""

import numpy as np
import pytest

from viscorough.contact.loading_path import indent
from viscorough.errors import ConvergenceError
from viscorough_study.performance import methods, problems


@pytest.fixture(scope="module")
def problem():
    return problems.rough_problem(0.7, 33, 6, 1)


def test_switching_a_part_off_leaves_it_on_afterwards(problem):
    before = indent(problem.indenter, tolerance=1e-6, depths=problem.depth)
    for part in methods.PARTS.values():
        methods._without(part, problem, 1e-3)
    after = indent(problem.indenter, tolerance=1e-6, depths=problem.depth)
    assert before.operator_applications == after.operator_applications
    np.testing.assert_array_equal(before.force, after.force)


def test_convergence_error_passes_through(problem, monkeypatch):
    monkeypatch.setattr("viscorough.contact.solver._DENSE_MEMBERS", 0)
    monkeypatch.setattr("viscorough.contact.grid_solver._ITERATIONS", 1)
    with pytest.raises(ConvergenceError):
        methods._at_levels(problem, 1e-10)
