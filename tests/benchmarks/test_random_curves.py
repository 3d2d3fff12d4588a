"""The campaign of random levels and curves finds errors that a solver does not report."""

import warnings
from dataclasses import replace

import numpy as np
import pytest
from random_curves import (
    GRID_ONLY,
    RandomCurve,
    curve_failure,
    levels_failure,
    random_curve,
    whole_curve_failure,
)

from support.sum_rules import audit
from viscorough.basics.errors import AccuracyWarning, ConvergenceError
from viscorough.contact.loading_path import indent
from viscorough.contact.prescribed_depth import ContactSolver
from viscorough.contact.state import DenseContact
from viscorough.surfaces.self_affine import self_affine_disc
from viscorough_study.run.seeds import random_indenter_key, realization_seed


@pytest.mark.parametrize(("seed", "number"), [(1, 266), (1, 674), (2, 460), (2014, 478), (2014, 10105)])
def test_audit_accepts_a_correct_curve(seed, number):
    """Intervals with one jump are divided so that one part ends at the jump, with almost the whole error.

    In the last two cases one quadrature of the second integral is just within the tolerance, and the audit requires
    both.
    """
    generator = np.random.default_rng(realization_seed(seed, *random_indenter_key(number)))
    case = random_curve(generator)
    assert audit(case.indenter, 10.0 ** -generator.uniform(2, 4), case.arguments["options"]).agrees


DISC = self_affine_disc(0.7, 17, seed=1)
CASE = RandomCurve(DISC, {"tolerance": 1e-4, "until_fraction": 0.8})


def altered(**changes):
    """Make a function that computes a loading curve and changes fields of it."""

    def compute(indenter, **arguments):
        curve = indent(indenter, **arguments)
        return replace(curve, **{name: change(getattr(curve, name)) for name, change in changes.items()})

    return compute


def thinned(indenter, **arguments):
    """Return a curve with only every thirtieth level: the levels are exact but too far apart."""
    curve = indent(indenter, **arguments)
    kept = np.append(np.arange(0, curve.depth.size - 1, 30), curve.depth.size - 1)
    names = ("depth", "force", "stiffness", "contact_count", "residual")
    return replace(curve, **{name: getattr(curve, name)[kept] for name in names})


def test_a_wrong_curve_is_found():
    assert curve_failure(CASE) == ""
    assert "of a level off by 0.001" in curve_failure(CASE, altered(depth=lambda depth: 1.001 * depth))
    assert curve_failure(CASE, thinned).startswith("depth at force")
    short = replace(CASE, arguments=CASE.arguments | {"until_fraction": 1.0})
    assert "stops at" in curve_failure(short, lambda indenter, **_: indent(indenter, until_fraction=0.5))


def test_wrong_end_of_a_whole_curve_is_found():
    whole = replace(CASE, arguments=CASE.arguments | {"until_fraction": 1.0})
    assert whole_curve_failure(whole) == ""
    assert "stops at" in whole_curve_failure(whole, lambda indenter, **_: indent(indenter, until_fraction=0.5))
    beyond = altered(depth=lambda depth: 1.001 * depth)
    assert "ends at 1.001 times the depth of complete contact" in whole_curve_failure(whole, beyond)
    assert "force at the end off by" in whole_curve_failure(whole, altered(force=lambda force: 1.001 * force))


def test_depths_below_the_first_level_are_checked():
    case = RandomCurve(DISC, {"tolerance": 1e-4, "depths": [2.0, 3.0]})
    assert curve_failure(case) == ""
    # This stiffness makes the first tangent pass through the origin.
    straight = altered(stiffness=lambda stiffness: stiffness * 0 + indent(DISC, depths=[2.0]).force[0] / 2.0)
    assert curve_failure(case, straight).startswith("depth before the first level off by")


def test_curve_with_a_warning_is_no_silent_failure():
    def warning(indenter, **arguments):
        warnings.warn("not as accurate", AccuracyWarning, stacklevel=1)
        return thinned(indenter, **arguments)

    assert curve_failure(CASE, warning) == ""


# ---- levels

LEVELS = RandomCurve(DISC, {"depths": np.array([0.5, 1.0]), "tolerance": 1e-6, "options": GRID_ONLY})


def altered_solver(pressure_sum=1.0, pressure=1.0):
    """Make a solver whose sums of pressures, or pressures, are multiplied by a factor."""

    class Altered(ContactSolver):
        def advance(self, contact, depth):
            contact = super().advance(contact, depth)
            loads = contact.member_loads()
            loads = loads._replace(pressure=loads.pressure * pressure)
            return DenseContact(
                units=contact.units,
                reduced_depth=contact.reduced_depth,
                count=contact.count,
                pressure_sum=contact.pressure_sum * pressure_sum,
                tangent_sum=contact.tangent_sum,
                residual=contact.residual,
                loads=loads,
            )

    return Altered


def test_silent_failure_of_a_level_is_found():
    assert levels_failure(LEVELS) == ""
    assert levels_failure(LEVELS, altered_solver(pressure_sum=1.0001)).startswith("force off by 0.0001")
    assert levels_failure(LEVELS, altered_solver(pressure=1.0001)).startswith("overlap ")
    assert levels_failure(LEVELS, altered_solver(pressure=-1.0)).startswith("tension ")
    loose = replace(LEVELS, arguments=LEVELS.arguments | {"tolerance": 1e-3})
    for name in ("pressure_sum", "pressure"):
        assert levels_failure(loose, altered_solver(**{name: 1.0001})) == ""  # within ten times the tolerance


def test_convergence_error_does_not_hide_a_silent_failure():
    class Refusing(altered_solver(pressure_sum=1.0001)):
        refused_above = 0.0

        def advance(self, contact, depth):
            if depth > self.refused_above:
                raise ConvergenceError("no")
            return super().advance(contact, depth)

    assert levels_failure(LEVELS, Refusing) == ""
    Refusing.refused_above = 0.7
    assert levels_failure(LEVELS, Refusing) != ""
