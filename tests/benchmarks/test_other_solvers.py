"""Adapters of other solvers: the exchange of requests and answers by all modes of ASPHER, with a stand-in for it.

The stand-in (tests/support/other_solvers) has the interface of ASPHER and solves exactly, so that a wrong unit, sign or
factor in the adapter shows in the forces. In the comparison itself it would show in the residual, which is computed
from the pressures of every solver.
"""

import os
import sys
from unittest.mock import patch

import numpy as np
import other_solvers
import pytest
import solver_race
from click.testing import CliRunner

from support import dense_contact
from support.workflow import HANGS, ROOT
from viscorough import Indenter, indent
from viscorough_study.run.tables import read_table, split_table

pytestmark = pytest.mark.long


@pytest.fixture(scope="module")
def indenter():
    """Return a rough ellipse of 5 × 6 elements with a spacing other than 1; a second element touches soon."""
    heights = 0.1 * np.random.default_rng(4).random((5, 6)) - 0.2 * np.hypot(*np.mgrid[-2:3, -2.5:3])
    heights[[0, 0, -1, -1], [0, -1, 0, -1]] = np.nan
    return Indenter(heights, 0.7)


@pytest.fixture
def aspher(tmp_path, monkeypatch):
    """Put the stand-in and its version on the import path of other processes."""
    metadata = tmp_path / "aspher-4.5.dist-info/METADATA"
    metadata.parent.mkdir()
    metadata.write_text("Metadata-Version: 2.1\nName: aspher\nVersion: 4.5\n")
    paths = (tmp_path, ROOT / "tests/support", ROOT / "tests/support/other_solvers")
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join(map(str, paths)))


@pytest.mark.usefixtures("aspher")
@pytest.mark.parametrize("mode", ["levels", "nested"])
def test_adapter_solves_the_problem_of_the_request(mode, indenter):
    exact = indent(indenter, tolerance=1e-11, depths=[0.1, 0.2, 1.0])
    command = [sys.executable, "peers/aspher_adapter.py", mode]
    levels = ("aspher", command), indenter, exact.depth, exact.force
    fine, coarse = (other_solvers.solve(*levels, tolerance, time_limit=HANGS) for tolerance in (1e-12, 1e-3))
    assert fine.version == "4.5"
    np.testing.assert_allclose(fine.force, exact.force, rtol=1e-10)
    assert fine.residual.max() < 1e-10
    # The stand-in moves one element too deep by the length that its tolerance allows, here 1e-3 of the depth.
    element = dense_contact.displacement(np.ones((1, 1)), 4.0, indenter.spacing).item() / indenter.spacing**2
    np.testing.assert_allclose((coarse.force - exact.force) * element, 1e-3 * exact.depth, rtol=1e-6)
    assert (coarse.residual > 3e-4).all()
    assert (coarse.residual < 1e-3).all()
    assert fine.iterations == 15  # five at each level, as the stand-in reports
    assert 0 < fine.wall_s < HANGS
    assert 1e7 < fine.memory < 1e9


@pytest.mark.usefixtures("aspher")
def test_solver_beyond_the_time_limit_has_no_answer(indenter):
    command = [sys.executable, "peers/aspher_adapter.py", "levels"]
    depth, force = np.array([0.1]), np.array([0.1])
    assert other_solvers.solve(("aspher", command), indenter, depth, force, 1e-12, time_limit=1e-6) is None


def test_pressure_outside_the_indenter_is_refused(indenter):
    pressure = np.zeros(indenter.heights.shape)
    pressure[0, 0] = 1.0
    assert other_solvers.contact_residual(indenter.initial_gap / indenter.spacing, pressure) == np.inf
    assert other_solvers.padded_size(17) == 24


@pytest.mark.usefixtures("aspher")
def test_race_compares_installed_solvers_and_skips_missing_ones(tmp_path):
    """The race has the stand-in, whose adapter answers as in the full race, and a solver that is not installed."""
    adapters = {"ASPHER": (sys.executable, "peers/aspher_adapter.py", "levels"), "Tamaas": ("absent/python", "")}
    tasks = {"two levels": (9, 2, (0.1, 0.5), (1,))}
    output = tmp_path / "tables/other_solvers.csv"
    with (
        patch.multiple(solver_race, TASKS=tasks, HURST=(0.4,), PAIRS=1, SOLVERS=tuple(adapters)),
        patch.object(other_solvers, "ADAPTERS", adapters),
    ):
        done = CliRunner().invoke(solver_race.main, ["--output", str(output)])
    assert done.exit_code == 0, done.output
    assert "Tamaas is not installed and is omitted" in done.output
    table = read_table(output)
    assert table["solver"].tolist() == ["viscorough", "ASPHER"]
    assert (table[["levels", "met"]] == [2, 1]).all(axis=None)
    assert (table[["wall_s", "ratio", "memory"]] > 0).all(axis=None)
    assert list(table) == list(solver_race.COLUMNS)
    assert split_table(output)[0]["machine"]["cores"] >= 1
    assert split_table(output)[0]["settings"]["pairs"] == 1
