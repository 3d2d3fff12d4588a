"""Random loading curves: none is wrong in silence, at its levels or between them, and a wrong one is found."""

import warnings
from dataclasses import replace

import numpy as np
import pytest

from viscorough.contact.loading_path import indent
from viscorough.contact.options import SolverOptions
from viscorough.errors import AccuracyWarning
from viscorough.surfaces import self_affine_disc
from viscorough_study.robustness.random_curves import (
    RandomCurve,
    audit_failure,
    curve_failure,
    random_audit,
    random_curve,
)
from viscorough_study.robustness.random_heights import KINDS
from viscorough_study.run.seeds import random_indenter_key, realization_seed


def generator(number, seed=12):
    return np.random.default_rng(realization_seed(seed, *random_indenter_key(number)))


@pytest.mark.parametrize(("count", "with_start"), [(600, False), (100, True)])
def test_random_curves_do_not_fail_silently(count, with_start):
    for number in range(count):
        case = random_curve(generator(number, seed=12 + with_start), with_start=with_start)
        assert ("start_fraction" in case.arguments) == with_start
        assert curve_failure(case) == "", f"case {number}"


def test_integrals_of_random_curves_are_exact():
    for number in range(20):
        assert audit_failure(random_audit(generator(number))) == "", f"case {number}"


@pytest.mark.parametrize(("seed", "number"), [(1, 266), (1, 674), (2, 460)])
def test_an_interval_with_one_jump_is_no_error(seed, number):
    """Divided, it has the jump at an end of one part, whose error is hardly less than that of the whole."""
    assert audit_failure(random_audit(generator(number, seed))) == ""


def test_wrong_integrals_are_found():
    no_padding = SolverOptions(dense_contacts=0, dense_interactions=0, padding=False)
    case = RandomCurve(DISC, {"tolerance": 1e-3, "options": no_padding})
    assert audit_failure(case).startswith("Audit over ")


@pytest.mark.parametrize("kind", list(KINDS))
def test_every_kind_has_elements_of_finite_height(kind):
    heights = [KINDS[kind](generator(number), 7, 9) for number in range(20)]
    assert np.isfinite(heights).any(axis=(1, 2)).all()
    assert not np.isinf(heights).any()


DISC = self_affine_disc(0.7, 17, seed=1)
CASE = RandomCurve(DISC, {"tolerance": 1e-4, "until_fraction": 0.8})


def altered(**changes):
    """Computes a loading curve of which fields are changed by functions."""

    def compute(indenter, **arguments):
        curve = indent(indenter, **arguments)
        return replace(curve, **{name: change(getattr(curve, name)) for name, change in changes.items()})

    return compute


def thinned(indenter, **arguments):
    """A curve of which only every thirtieth level is left: exact levels, with too much between them."""
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


def test_a_depth_before_the_first_given_one_is_checked():
    case = RandomCurve(DISC, {"tolerance": 1e-4, "depths": [2.0, 3.0]})
    assert curve_failure(case) == ""
    # Of a stiffness that makes the first tangent pass through the origin.
    straight = altered(stiffness=lambda stiffness: stiffness * 0 + indent(DISC, depths=[2.0]).force[0] / 2.0)
    assert curve_failure(case, straight).startswith("depth before the first level off by")


def test_a_warning_is_no_silent_failure():
    def warning(indenter, **arguments):
        warnings.warn("not as accurate", AccuracyWarning, stacklevel=1)
        return thinned(indenter, **arguments)

    assert curve_failure(CASE, warning) == ""
