"""The comparison with other solvers on one task, with solutions made by stand-ins."""

import sys
from types import SimpleNamespace

import numpy as np
import other_solvers
import pytest
import solver_race

from viscorough import indent, self_affine_disc


@pytest.fixture(scope="module")
def disc():
    return self_affine_disc(0.7, 17, seed=2)


@pytest.fixture(scope="module")
def exact(disc):
    """Return the curve of the disc at three levels."""
    return indent(disc, tolerance=1e-11, depths=[0.5, 1.0, 2.0])


@pytest.fixture
def stand_in(monkeypatch):
    """Make solvers whose residual is `least` plus 0.6 of their tolerance; `in_time` : False if they do not end."""

    def solve(solver, indenter, depths, forces, tolerance, *, time_limit, threads=1):
        _, made = solver
        residual, wall = np.full(len(depths), made["least"] + 0.6 * tolerance), made["seconds"] * threads
        times = {"iterations": -1, "wall_s": wall, "processor_s": 0.25, "memory": 3e6}
        return SimpleNamespace(version="1.2", force=forces, residual=residual, **times) if made["in_time"] else None

    monkeypatch.setattr(other_solvers, "solve", solve)
    return lambda seconds=0.5, least=0.0, in_time=True: {"seconds": seconds, "least": least, "in_time": in_time}


def compared(disc, exact, solvers, pairs=1, **task):
    """Return the table of the solvers and the path, at the three levels to a residual of 1e-4."""
    task = solver_race.Task("three levels", 0.7, disc, exact.depth, exact.force, 1e-4, **task)
    return solver_race.compare_solvers(task, solvers, pairs=pairs, time_limit=20)


def test_failing_and_late_solvers_are_left_out(disc, exact, tmp_path):
    (tmp_path / "broken.py").write_text(
        "import os; raise RuntimeError('OMP_NUM_THREADS=' + os.environ['OMP_NUM_THREADS'])"
    )
    (tmp_path / "late.py").write_text("import signal; signal.raise_signal(signal.SIGALRM)")
    solvers = {name: [sys.executable, str(tmp_path / f"{name}.py")] for name in ("late", "broken")}
    with pytest.warns(UserWarning, match="broken: RuntimeError: OMP_NUM_THREADS=1") as warned:
        table = compared(disc, exact, solvers)
    assert len(warned) == 1
    assert table["solver"].tolist() == ["viscorough"]


def test_comparison_uses_the_loosest_tolerance_that_meets_the_residual(disc, exact, stand_in):
    table = compared(disc, exact, {"stand-in": stand_in()}, pairs=3, threads=(1, 2))
    assert list(table.columns) == list(solver_race.COLUMNS)
    assert table["solver"].tolist() == ["viscorough", "viscorough", "stand-in", "stand-in"]
    np.testing.assert_allclose(table["tolerance"], 1e-4)  # three times this tolerance would leave a residual of 1.8e-4
    assert (table["met"] == 1).all()
    assert table["wall_s"].tolist()[2:] == [0.5, 1.0]
    # The stand-in reports the same time in every pair, so the median ratio is the ratio to the path's median time.
    np.testing.assert_allclose(table["ratio"][2:], table["wall_s"][2:].to_numpy() / table["wall_s"][:2])
    assert (table["ratio"].between(table["ratio_low"], table["ratio_high"])).all()


def test_much_slower_solvers_are_not_repeated(disc, exact, stand_in):
    solvers = {f"{seconds}": stand_in(seconds=seconds) for seconds in (0.5, 1.9, 2.1)}
    table = compared(disc, exact, solvers, pairs=2)
    assert table["wall_s"].tolist()[1:] == [0.5, 1.9, 2.1]
    assert table["ratio_low"].isna().tolist() == [False, False, False, True]
    assert table["ratio"].notna().all()


def test_solver_that_misses_the_residual_is_marked(disc, exact, stand_in):
    assert compared(disc, exact, {"slow": stand_in(in_time=False)})["solver"].tolist() == ["viscorough"]
    table = compared(disc, exact, {"stand-in": stand_in(least=0.01)})
    assert table["met"].tolist() == [1, 0]
    assert table[["wall_s", "ratio"]].isna().all(axis=1).tolist() == [False, True]
    assert table["tolerance"][1] == pytest.approx(min(solver_race.TOLERANCE_RATIOS) * 1e-4)


def test_task_has_the_requested_contact_fractions():
    task = solver_race.disc_task("few", 0.7, 33, [0.05, 0.3], (1, 2), seed=2)
    curve = indent(task.indenter, tolerance=1e-6, depths=task.depths)
    np.testing.assert_allclose(curve.contact_fraction, [0.05, 0.3], rtol=0.1)
