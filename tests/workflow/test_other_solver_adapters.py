"""The adapters of other solvers: the exchange of requests and answers, and each adapter with a stand-in for its solver.

The stand-ins (tests/support/other_solvers) have the interfaces of the solvers and solve exactly, so that a wrong unit,
sign or factor in an adapter shows in the forces.
"""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from support import dense_contact
from support.workflow import HANGS, ROOT
from viscorough.contact.loading_path import indent
from viscorough.indenter import Indenter
from viscorough_study.performance import other_solvers

ADAPTERS, SUPPORT = ROOT / "workflow/peers", ROOT / "tests/support"
DISTRIBUTIONS = {
    "aspher_adapter": "aspher",
    "aspher_active_set_adapter": "aspher",
    "aspher_nested_adapter": "aspher",
    "contactmechanics_adapter": "ContactMechanics",
    "slippy_adapter": "slippy",
    "tamaas_adapter": "tamaas",
}


@pytest.fixture(scope="module")
def indenter():
    """A rough ellipse of 5 × 6 elements with a spacing other than 1; the highest element is not alone for long."""
    heights = 0.1 * np.random.default_rng(4).random((5, 6)) - 0.2 * np.hypot(*np.mgrid[-2:3, -2.5:3])
    heights[[0, 0, -1, -1], [0, -1, 0, -1]] = np.nan
    return Indenter(heights, 0.7)


@pytest.fixture
def stand_ins(tmp_path, monkeypatch):
    """The stand-ins on the path of other processes, with their versions."""
    for distribution in set(DISTRIBUTIONS.values()):
        metadata = tmp_path / f"{distribution}-4.5.dist-info/METADATA"
        metadata.parent.mkdir()
        metadata.write_text(f"Metadata-Version: 2.1\nName: {distribution}\nVersion: 4.5\n")
    paths = (tmp_path, SUPPORT, SUPPORT / "other_solvers")
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join(map(str, paths)))


def solver(name):
    return other_solvers.OtherSolver(name, Path(sys.executable), ADAPTERS / f"{name}.py")


@pytest.mark.usefixtures("stand_ins")
@pytest.mark.parametrize("name", DISTRIBUTIONS)
def test_adapter_solves_the_problem_of_the_request(name, indenter):
    exact = indent(indenter, tolerance=1e-11, depths=[0.1, 0.2, 0.4])
    levels = solver(name), indenter, exact.depth, exact.force
    fine, coarse = (other_solvers.solve(*levels, tolerance, time_limit=HANGS) for tolerance in (1e-12, 1e-3))
    assert fine.version == "4.5"
    np.testing.assert_allclose(fine.force, exact.force, rtol=1e-10)
    np.testing.assert_allclose(fine.depth, exact.depth, rtol=1e-10)
    assert fine.residual.max() < 1e-10
    # The stand-ins press one element too deep by the length that their tolerance allows, here 1e-3 of the depth.
    element = dense_contact.displacement(np.ones((1, 1)), 4.0, indenter.spacing).item() / indenter.spacing**2
    np.testing.assert_allclose((coarse.force - exact.force) * element, 1e-3 * exact.depth, rtol=1e-6)
    assert (coarse.residual > 3e-4).all()
    assert (coarse.residual < 1e-3).all()
    assert fine.total_iterations == {
        "aspher_adapter": 15,
        "aspher_active_set_adapter": 15,
        "aspher_nested_adapter": 15,
        "contactmechanics_adapter": 21,
    }.get(name, -1)
    assert 0 < fine.wall_s < HANGS
    assert 1e7 < fine.memory < 1e9


# ---- the exchange, with a solver of a few lines

SOLVER = """
import os, signal, sys, time
import numpy as np
sys.path.insert(0, {adapters!r})
from exchange import answer_request

class Springs:
    '''Independent springs: the pressure is the overlap, and the gap closes by it.'''

    def __init__(self, problem):
        self.problem = problem
        self.last = None
        assert os.environ["OMP_NUM_THREADS"] == os.environ["OPENBLAS_NUM_THREADS"] == str(problem.threads)

    def solve(self, level, tolerance, start):
        assert start is None if level == 0 else start is self.last
        if tolerance == {slow}:
            signal.raise_signal(signal.SIGALRM)  # as if the time were over
        time.sleep({pause})
        self.last = np.maximum(self.problem.depths[level] - self.problem.gap, 0)
        return self.last, level + 1

    def displacement(self, pressure):
        return pressure

answer_request("numpy", Springs)
"""


def exchange(folder, **changed):
    """The answer to a request with three levels, as a dictionary."""
    gap = np.array([[0.0, 0.5, np.nan], [0.25, 1.0, 0.75]])
    request = {"gap": gap, "depths": [0.1, 0.6, 2.0], "forces": [1.0, 2.0, 3.0], "tolerance": 1e-3}
    request |= {"padding": 8, "threads": 3, "maximum_seconds": HANGS} | changed
    np.savez(folder / "request.npz", **request)
    (folder / "springs.py").write_text(SOLVER.format(adapters=str(ADAPTERS), slow=1e-6, pause=0.02))
    command = [sys.executable, folder / "springs.py", folder / "request.npz", folder / "answer.npz"]
    subprocess.run(command, check=True, capture_output=True, text=True)
    with np.load(folder / "answer.npz") as answer:
        return request, dict(answer)


def test_answer_has_every_level_in_time(tmp_path):
    request, answer = exchange(tmp_path)
    overlap = np.nan_to_num(np.maximum(np.array(request["depths"])[:, None, None] - request["gap"], 0))
    np.testing.assert_allclose(answer["pressures"], overlap)
    assert answer["iterations"].tolist() == [1, 2, 3]
    np.testing.assert_allclose(answer["depth"], request["depths"])
    assert answer["cpu"] < answer["wall"]
    assert answer["wall"] >= 0.06
    assert answer["memory_mb"] > 5
    _, late = exchange(tmp_path, tolerance=1e-6)
    assert np.isnan(late["pressures"]).all()
    assert np.isnan(late["wall"])


def test_elements_beyond_the_indenter_never_touch(tmp_path):
    """The grid is square and padded, so that forces are those on the indenter alone."""
    _, answer = exchange(tmp_path, depths=[5.0, 50.0, 500.0])
    assert (answer["pressures"][:, 0, 2] == 0).all()
    np.testing.assert_allclose(answer["depth"], [5.0, 50.0, 500.0])
