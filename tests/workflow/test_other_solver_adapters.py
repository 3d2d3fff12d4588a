"""Adapters of other solvers: the exchange of requests and answers, and the modes of ASPHER with a stand-in for it.

The stand-in (tests/support/other_solvers) has the interface of ASPHER and solves exactly, so that a wrong unit, sign or
factor in the adapter shows in the forces. In the comparison itself it would show in the residual, which is computed
from the pressures of every solver.
"""

import os
import signal
import subprocess
import sys

import numpy as np
import pytest

from support import dense_contact
from support.workflow import HANGS, ROOT
from viscorough.contact.loading_path import indent
from viscorough.indenter import Indenter
from viscorough_study.performance import other_solvers

ADAPTERS, SUPPORT = ROOT / "workflow/peers", ROOT / "tests/support"


@pytest.fixture(scope="module")
def indenter():
    """A rough ellipse of 5 × 6 elements with a spacing other than 1; the highest element is not alone for long."""
    heights = 0.1 * np.random.default_rng(4).random((5, 6)) - 0.2 * np.hypot(*np.mgrid[-2:3, -2.5:3])
    heights[[0, 0, -1, -1], [0, -1, 0, -1]] = np.nan
    return Indenter(heights, 0.7)


@pytest.fixture
def stand_in(tmp_path, monkeypatch):
    """The stand-in on the path of other processes, with its version."""
    metadata = tmp_path / "aspher-4.5.dist-info/METADATA"
    metadata.parent.mkdir()
    metadata.write_text("Metadata-Version: 2.1\nName: aspher\nVersion: 4.5\n")
    paths = (tmp_path, SUPPORT, SUPPORT / "other_solvers")
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join(map(str, paths)))


@pytest.mark.usefixtures("stand_in")
@pytest.mark.parametrize("mode", ["levels", "nested", "active_set"])
def test_adapter_solves_the_problem_of_the_request(mode, indenter):
    exact = indent(indenter, tolerance=1e-11, depths=[0.1, 0.2, 0.4])
    command = [sys.executable, str(ADAPTERS / "aspher_adapter.py"), mode]
    levels = "aspher", command, indenter, exact.depth, exact.force
    fine, coarse = (other_solvers.solve(*levels, tolerance, time_limit=HANGS) for tolerance in (1e-12, 1e-3))
    assert fine.version == "4.5"
    np.testing.assert_allclose(fine.force, exact.force, rtol=1e-10)
    assert fine.residual.max() < 1e-10
    # The stand-in presses one element too deep by the length that its tolerance allows, here 1e-3 of the depth.
    element = dense_contact.displacement(np.ones((1, 1)), 4.0, indenter.spacing).item() / indenter.spacing**2
    np.testing.assert_allclose((coarse.force - exact.force) * element, 1e-3 * exact.depth, rtol=1e-6)
    assert (coarse.residual > 3e-4).all()
    assert (coarse.residual < 1e-3).all()
    assert fine.iterations == 15  # five at each level, as the stand-in reports
    assert 0 < fine.wall_s < HANGS
    assert 1e7 < fine.memory < 1e9


# ---- the exchange, with a solver of a few lines

SOLVER = """
import sys, time
import numpy as np
sys.path.insert(0, {adapters!r})
from exchange import answer_request

class Springs:
    '''Independent springs: the pressure is the overlap.'''

    def __init__(self, problem):
        self.problem, self.last = problem, None
        assert problem.threads == 3

    def solve(self, level, tolerance, start):
        assert start is self.last
        time.sleep(tolerance)
        self.last = np.maximum(self.problem.depths[level] - self.problem.gap, 0)
        return self.last, level + 1

answer_request("numpy", Springs)
"""


def test_answer_has_every_level_in_time(tmp_path):
    """Elements beyond the indenter never touch: the grid is square and padded, so that forces are those on it alone."""

    def exchange(**changed):
        np.savez(tmp_path / "request.npz", **request | changed)
        return subprocess.run([sys.executable, *paths], capture_output=True).returncode

    paths = [tmp_path / name for name in ("springs.py", "request.npz", "answer.npz")]
    paths[0].write_text(SOLVER.format(adapters=str(ADAPTERS)))
    gap, depths = np.array([[0.0, 0.5, np.nan], [0.25, 1.0, 0.75]]), np.array([0.1, 0.6, 500.0])
    request = {"gap": gap, "depths": depths, "forces": [1.0, 2.0, 3.0], "tolerance": 0.02, "padding": 8, "threads": 3}
    assert exchange(tolerance=HANGS, maximum_seconds=0.01) == -signal.SIGALRM
    assert not paths[2].exists()
    assert exchange(maximum_seconds=HANGS) == 0
    answer = np.load(paths[2])
    overlap = np.nan_to_num(np.maximum(depths[:, None, None] - gap, 0))
    np.testing.assert_allclose(answer["pressures"], overlap)
    assert answer["iterations"] == 6
    assert answer["cpu"] < answer["wall"]
    assert answer["wall"] >= 0.06
    assert answer["memory_mb"] > 5
