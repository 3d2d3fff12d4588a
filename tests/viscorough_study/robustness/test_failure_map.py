"""The atlas of where methods fail, on a reduced set: what must hold holds, what fails is noticed."""

from dataclasses import replace
from types import SimpleNamespace
from unittest.mock import patch

import numpy as np
import psutil
import pytest

from viscorough.contact.loading_path import indent
from viscorough.contact.solver import ContactSolver
from viscorough.errors import AccuracyWarning
from viscorough.indenter import Indenter
from viscorough.surfaces import self_affine_disc, self_affine_line
from viscorough.viscous.stepping import march_steps
from viscorough_study.performance import ablations
from viscorough_study.robustness import failure_map
from viscorough_study.robustness.failure_map import METHODS, VERDICTS, unnoticed
from viscorough_study.robustness.random_indenters import random_case, silent_failure
from viscorough_study.robustness.stress_cases import Difficulty, difficulties

NUMERICAL = ["path, dense", "path, grid, double", "path, grid, single", "events"]
REFUSED = {"negative for a while", "1e-14"}


@pytest.fixture(scope="module")
def atlas():
    return failure_map.table(difficulties(np.random.SeedSequence(3), 13, (9, 17)))


def cells(atlas, **wanted):
    for column, value in wanted.items():
        atlas = atlas[atlas[column] == value]
    return atlas


def test_every_cell_has_a_number_and_a_verdict(atlas):
    rows = atlas[["group", "difficulty"]].drop_duplicates()
    assert len(rows) >= 45
    assert len(atlas) == len(rows) * len(METHODS)
    assert np.isfinite(atlas["error"]).all()
    assert set(atlas["verdict"]) <= set(VERDICTS)
    assert (atlas["reason"] != "")[atlas["verdict"].isin(["refused", "warned", "stated"])].all()


def test_nothing_fails_unnoticed(atlas):
    assert unnoticed(atlas).empty


@pytest.mark.parametrize("method", NUMERICAL)
def test_numerical_methods_hold_or_refuse(atlas, method):
    of_method = cells(atlas, method=method)
    others = of_method[of_method["verdict"] != "holds"]
    assert set(others["difficulty"]) <= REFUSED | {"2 to 20 elements", "up to half of all"}
    assert set(others.loc[others["difficulty"].isin(REFUSED), "verdict"]) == {"refused"}


def test_results_are_invariant_under_rescaling(atlas):
    for method in NUMERICAL:
        usual = cells(atlas, method=method, difficulty="256 steps")["error"].item()
        # A factor of 1e12 changes the last bits. Rounded to single precision, some of them change much more: that must
        # stay far below the tolerance, 1e-6 (of twelve seeds, half exceed 1e-12 there, none 1e-8).
        allowed = 1e-8 if method == "path, grid, single" else 1e-12
        assert np.abs(cells(atlas, method=method, group="scale")["error"] - usual).max() < allowed


def test_powers_of_two_change_no_bit():
    disc = self_affine_disc(0.6, 17, seed=1)
    depths = np.linspace(0.2, 1, 4) * np.nanmax(disc.initial_gap)
    how = {"tolerance": 1e-6, "options": ablations.GRID_ONLY["single"]}
    usual = indent(disc, depths=depths, **how).force
    scaled = indent(Indenter(2.0**40 * disc.heights, 2.0**-30 * disc.spacing), depths=2.0**40 * depths, **how)
    np.testing.assert_array_equal(scaled.force, 2.0**10 * usual)


def test_padding_is_needed(atlas):
    unpadded = cells(atlas, group="no padding", verdict="not offered")
    assert len(unpadded) == 4
    assert unpadded["error"].min() > 1e-3


def test_failures_of_explicit_steps_are_warned_of(atlas):
    steps = cells(atlas, group="step size", method="explicit steps").set_index("difficulty")
    assert steps.loc["one step", "verdict"] == "warned"
    assert steps.loc["one step", "error"] > 0.1
    assert "overlaps the surface" in steps.loc["one step", "reason"]
    assert steps.loc["4096 steps", "error"] < steps.loc["256 steps", "error"] < steps.loc["16 steps", "error"]


def test_reduction_is_exact_for_bodies_of_revolution_and_stated_not_to_be_for_others(atlas):
    reduction = cells(atlas, method="MDR", group="shape").set_index("difficulty")
    assert reduction.loc[["sphere", "cone"], "error"].max() < 0.2  # of so few elements; validation has the order
    assert set(reduction.loc[["ridge", "wedge", "two spheres", "elongated"], "verdict"]) == {"stated"}


def test_forces_that_pull_are_refused_with_the_reason(atlas):
    pulling = cells(atlas, difficulty="negative for a while")
    assert set(pulling["verdict"]) == {"refused"}
    assert pulling["reason"].str.contains("without adhesion a pull opens the contact").all()


def test_curves():
    found = failure_map.curves(np.random.SeedSequence(1))
    steps = found[(found["curve"] == "steps") & (found["method"] == "error of the depth")]
    order = -np.polyfit(np.log(steps["x"][-8:]), np.log(steps["y"][-8:]), 1)[0]
    assert order == pytest.approx(1, abs=0.3)  # forward Euler
    contact = found[found["curve"] == "contact"].set_index("method")["y"]
    assert contact["path, grid, single"].max() < 1e-5
    assert contact["path, grid, no padding"].max() > 1e-2


# ---- generated cases


@pytest.mark.parametrize("block", range(4))
def test_random_cases_do_not_fail_silently(block):
    for case in range(60 * block, 60 * (block + 1)):
        generator = np.random.default_rng(np.random.SeedSequence(11, spawn_key=(case,)))
        assert silent_failure(*random_case(generator)) == "", f"case {case}"


@pytest.mark.parametrize("broken", ["pressure_sum", "reduced_pressure"])
def test_a_silent_failure_is_found(broken):
    disc = self_affine_disc(0.7, 11, seed=1)
    depths = np.array([0.5, 1.0])

    class Wrong(ContactSolver):
        def advance(self, contact, depth):
            contact = super().advance(contact, depth)
            return replace(contact, **{broken: getattr(contact, broken) * (1 + 1e-4)})

    assert silent_failure(disc, depths, 1e-6, True) == ""
    assert silent_failure(disc, depths, 1e-6, True, Wrong) != ""
    assert silent_failure(disc, depths, 1e-3, True, Wrong) == ""  # within ten times the tolerance


# ---- guards


def test_long_steps_warn():
    disc = self_affine_disc(0.7, 17, seed=1)
    force = indent(disc, depths=[1.0]).force
    with pytest.warns(AccuracyWarning, match=r"overlaps the surface by up to 0\.\d+ of its depth"):
        march_steps(disc, force)


def test_rms_slope_of_a_plane():
    x, y = np.mgrid[:5, :7]
    assert Indenter(0.6 * x + 1.6 * y, 2.0).rms_slope == pytest.approx(np.hypot(0.3, 0.8))
    assert Indenter(np.array([[1.0]]), 1.0).rms_slope == 0


@pytest.mark.parametrize(
    ("make", "what"),
    [
        (lambda: self_affine_disc(0.5, 20_001 * 8, seed=1), "a surface of 160008 x 160008 points takes"),
        (lambda: self_affine_line(0.5, 10**14, seed=1), "a line of 100000000000000 points takes"),
    ],
)
def test_what_cannot_fit_is_refused_before_it_is_tried(make, what):
    """Sizes for which no machine has the memory; a 20 001-disc takes 40 GB to make and 160 GB to press."""
    with pytest.raises(MemoryError, match=rf"{what} .* bytes of memory, .* bytes are available"):
        make()


def test_a_map_too_large_to_press_is_refused(monkeypatch):
    monkeypatch.setattr(psutil, "virtual_memory", lambda: SimpleNamespace(available=1_000_000))
    indent(Indenter(np.zeros((20, 20)), 1.0))
    with pytest.raises(MemoryError, match=r"contact of a map of \(60, 60\) heights takes 1\.44e\+06 bytes of memory"):
        indent(Indenter(np.zeros((60, 60)), 1.0))


def test_a_difficulty_that_no_method_meets_is_unnoticed():
    """The verdict itself can fail: with a limit of zero nothing holds, and nobody is told."""
    strict = [failure_map._Method(each.name, each.ask, lambda _: 0.0) for each in METHODS[1:2]]
    disc = self_affine_disc(0.7, 13, seed=1)
    with patch.object(failure_map, "METHODS", strict):
        assert len(unnoticed(failure_map.table([Difficulty("", "", disc)]))) == 1
