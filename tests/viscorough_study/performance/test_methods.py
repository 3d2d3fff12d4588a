"""Ablations of the elastic loading path leave it as it was."""

import pytest

from support.study import LIMITS
from viscorough.contact.options import SolverOptions
from viscorough.errors import ConvergenceError
from viscorough_study.performance import methods, problems


@pytest.fixture(scope="module")
def problem():
    return problems.rough_problem(0.7, 33, 6, 1, LIMITS)


def test_convergence_error_passes_through(problem):
    with pytest.raises(ConvergenceError):
        methods._at_levels(problem, 1e-10, SolverOptions(dense_contacts=0, max_iterations=1))
