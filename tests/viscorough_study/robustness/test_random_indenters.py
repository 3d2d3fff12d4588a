"""Random small indenters: none of their solutions is wrong in silence, and a wrong one is found."""

from dataclasses import replace

import numpy as np

from viscorough.contact.solver import ContactSolver
from viscorough.errors import ConvergenceError
from viscorough.surfaces import self_affine_disc
from viscorough_study.robustness.random_indenters import RandomCase, random_case, silent_failure
from viscorough_study.run.seeds import random_indenter_key, realization_seed


def test_random_cases_do_not_fail_silently():
    for number in range(120):
        generator = np.random.default_rng(realization_seed(11, *random_indenter_key(number)))
        assert silent_failure(random_case(generator)) == "", f"case {number}"


CASE = RandomCase(self_affine_disc(0.7, 11, seed=1), np.array([0.5, 1.0]), 1e-6, on_grid=True)


def altered(pressure_sum=1.0, pressure=1.0):
    """A solver whose contacts have the sum of pressures, or the pressures, multiplied by a factor."""

    class Altered(ContactSolver):
        def advance(self, contact, depth):
            contact = super().advance(contact, depth)
            loads = contact.member_loads()
            loads = loads._replace(pressure=loads.pressure * pressure)
            return replace(contact, pressure_sum=contact.pressure_sum * pressure_sum, loads=loads)

    return Altered


def test_a_silent_failure_is_found():
    assert silent_failure(CASE) == ""
    assert silent_failure(CASE, altered(pressure_sum=1.0001)).startswith("force off by 0.0001")
    assert silent_failure(CASE, altered(pressure=1.0001)).startswith("overlap ")
    assert silent_failure(CASE, altered(pressure=-1.0)).startswith("tension ")
    for name in ("pressure_sum", "pressure"):
        assert silent_failure(replace(CASE, tolerance=1e-3), altered(**{name: 1.0001})) == ""  # within ten times that


def test_a_convergence_error_is_no_silent_failure_but_does_not_hide_one():
    class Refusing(altered(pressure_sum=1.0001)):
        refused_above = 0.0

        def advance(self, contact, depth):
            if depth > self.refused_above:
                raise ConvergenceError("no")
            return super().advance(contact, depth)

    assert silent_failure(CASE, Refusing) == ""
    Refusing.refused_above = 0.7
    assert silent_failure(CASE, Refusing) != ""
