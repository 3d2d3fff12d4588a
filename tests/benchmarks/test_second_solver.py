"""Comparison with a second solver: differences of forces that are known."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
import second_solver

from support.documentation import ROOT, read
from viscorough_study.run.readable import readable


def test_power_law_of_discs_is_found():
    force = 4 * np.geomspace(0.01, 0.1, 200)
    depth = (force / 4) ** 0.4  # u/h = X^α, so vt/h = α X^α
    beta, zeta = second_solver.power_law(depth[None], force[None])
    assert (beta, zeta) == pytest.approx((0.4, 1 / 0.4), rel=1e-3)


def test_differences_are_those_of_the_other_forces(monkeypatch):
    """Forces of the other solver are larger by 1 %: at the same depths, ζ is larger by the factor 1.01^β."""

    def solve(solver, disc, depths, forces, tolerance, time_limit):
        return SimpleNamespace(force=1.01 * forces, residual=np.array([3e-7]), processor_s=2.0, version="1.8")

    monkeypatch.setattr(second_solver.other_solvers, "solve", solve)
    monkeypatch.setattr(second_solver, "DISCS", 2)
    monkeypatch.setattr(second_solver, "ELEMENTS", 33)
    row = second_solver.compared(0.6, ("other", ()))
    assert row.keys() == second_solver.COLUMNS.keys()
    assert row["force_difference"] == pytest.approx(0.01)
    assert row["beta_difference"] == pytest.approx(0, abs=1e-12)
    assert row["zeta_difference"] == pytest.approx(1.01 ** row["beta"] - 1)
    assert (row["residual"], row["processor_s"]) == (3e-7, 4.0)


def test_documentation_states_the_published_differences():
    table = pd.read_csv(ROOT / "resources/published/second_solver.csv")
    for name in ("force", "beta", "zeta"):
        assert readable(table[f"{name}_difference"].abs().max()) in read(ROOT / "docs/verification.md")
