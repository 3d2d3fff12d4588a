"""Other solvers by a stand-in: requests, answers, residuals, and the comparison on one task."""

import sys

import numpy as np
import pytest

from support import dense_contact
from viscorough.contact.loading_path import indent
from viscorough.surfaces import self_affine_disc
from viscorough_study.performance import other_solvers, solver_comparison

ADAPTER = '''
"""A stand-in for another solver: the pressures that a file holds, times 1 + tolerance; none in time for large ones."""
import os, signal, sys
import numpy as np

request = np.load(sys.argv[-2])
pressures = np.load({pressures!r})
tolerance, threads = request["tolerance"], int(request["threads"])
assert os.environ["OMP_NUM_THREADS"] == str(threads)
assert request["padding"] == 24 and np.isfinite(request["gap"]).any()
assert request["maximum_seconds"] == 20
if tolerance > {too_slow}:
    signal.raise_signal(signal.SIGALRM)
about = dict(version="1.2", iterations=-1, cpu=0.25, memory_mb=3.0)
np.savez(sys.argv[-1], pressures=pressures * (1 + tolerance), wall={seconds} * threads, **about)
'''


@pytest.fixture(scope="module")
def disc():
    return self_affine_disc(0.7, 17, seed=2)


@pytest.fixture(scope="module")
def exact(disc):
    """The disc's curve at three levels."""
    return indent(disc, tolerance=1e-11, depths=[0.5, 1.0, 2.0])


@pytest.fixture
def stand_in(tmp_path, disc, exact):
    """Makes commands of solvers whose answers are the exact pressures at the three levels, times 1 + tolerance."""
    gap = np.nan_to_num(disc.initial_gap / disc.spacing, nan=1e3)
    pressures = np.array([dense_contact.pressure_at_depth(gap, depth / disc.spacing, 4.0) for depth in exact.depth])

    def make(too_slow=1e300, seconds=0.5, factor=1.0):
        np.save(tmp_path / f"{factor}.npy", factor * pressures)
        adapter = tmp_path / f"adapter_{seconds}.py"
        values = {"pressures": str(tmp_path / f"{factor}.npy"), "too_slow": too_slow, "seconds": seconds}
        adapter.write_text(ADAPTER.format(**values))
        return [sys.executable, str(adapter)]

    return make


def compared(disc, exact, solvers, pairs=1, **task):
    """Table of the solvers and the path, at the three levels to a residual of 1e-4."""
    task = solver_comparison.Task("three levels", 0.7, disc, exact.depth, 1e-4, **task)
    return solver_comparison.compare_solvers(task, solvers, pairs=pairs, time_limit=20)


def test_pressure_outside_the_indenter_is_no_solution(disc):
    pressure = np.zeros(disc.heights.shape)
    pressure[0, 0] = 1.0
    assert other_solvers.contact_residual(disc.initial_gap / disc.spacing, pressure) == np.inf


def test_a_solver_that_fails_is_reported_and_left_out(disc, exact, tmp_path):
    adapter = tmp_path / "broken.py"
    adapter.write_text("raise RuntimeError('no licence')")
    broken = [sys.executable, str(adapter)]
    with pytest.warns(UserWarning, match="broken: RuntimeError: no licence"):
        table = compared(disc, exact, {"broken": broken})
    assert table["solver"].tolist() == ["viscorough"]
    installed = solver_comparison.installed_solvers({"absent": [str(tmp_path / "python")], "broken": broken})
    assert installed == {"broken": broken}


def test_comparison_uses_the_loosest_tolerance_that_meets_the_residual(disc, exact, stand_in):
    table = compared(disc, exact, {"stand-in": stand_in()}, pairs=3, threads=(1, 2))
    assert list(table.columns) == list(solver_comparison.COLUMNS)
    assert table["solver"].tolist() == ["viscorough", "viscorough", "stand-in", "stand-in"]
    residuals = [
        other_solvers.solve("", stand_in(), disc, exact.depth, exact.force, ratio * 1e-4, time_limit=20).residual.max()
        for ratio in (1 / 3, 1, 3)
    ]
    loosest = max(ratio for ratio, left in zip((1 / 3, 1, 3), residuals, strict=True) if left <= 1e-4)
    np.testing.assert_allclose(table["tolerance"], [1e-4, 1e-4, loosest * 1e-4, loosest * 1e-4])
    assert loosest < 3
    assert (table["met"] == 1).all()
    assert table["wall_s"].tolist()[2:] == [0.5, 1.0]
    # The stand-in reports the same time in every pair, so that the median ratio is that to the median time of the path.
    np.testing.assert_allclose(table["ratio"][2:], table["wall_s"][2:].to_numpy() / table["wall_s"][:2])
    assert (table["ratio"].between(table["ratio_low"], table["ratio_high"])).all()


def test_far_slower_solvers_are_not_repeated(disc, exact, stand_in):
    solvers = {f"{seconds}": stand_in(seconds=seconds) for seconds in (0.5, 1.9, 2.1)}
    table = compared(disc, exact, solvers, pairs=2)
    assert table["wall_s"].tolist()[1:] == [0.5, 1.9, 2.1]
    assert table["ratio_low"].isna().tolist() == [False, False, False, True]
    assert table["ratio"].notna().all()


def test_a_residual_out_of_reach_is_not_met(disc, exact, stand_in):
    assert compared(disc, exact, {"slow": stand_in(too_slow=0)})["solver"].tolist() == ["viscorough"]
    table = compared(disc, exact, {"stand-in": stand_in(factor=1.01)})
    assert table["met"].tolist() == [1, 0]
    assert table[["wall_s", "ratio"]].isna().all(axis=1).tolist() == [False, True]
    assert table["tolerance"][1] == pytest.approx(min(solver_comparison.TOLERANCE_RATIOS) * 1e-4)


def test_a_task_is_at_the_contact_fractions_asked_for():
    task = solver_comparison.disc_task("few", 0.7, 33, [0.05, 0.3], 1e-4, seed=2, threads=[1, 2])
    curve = indent(task.indenter, tolerance=1e-6, depths=task.depths)
    np.testing.assert_allclose(curve.contact_fraction, [0.05, 0.3], rtol=0.1)
