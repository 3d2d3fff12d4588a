"""Speed against accuracy: every method on a small indenter, other solvers by a stand-in, scenes, timing."""

import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from viscorough.contact.loading_path import indent
from viscorough.loading_curve import ConvergenceError
from viscorough.surfaces import self_affine_disc
from viscorough.viscous.events import march_events
from viscorough_study.performance import level_placement, methods, other_solvers, timing
from viscorough_study.performance.pareto import pareto_front

ADAPTER = '''
"""A stand-in for a peer: answers with pressures that a file holds, off by its tolerance."""
import sys
import numpy as np

request = np.load(sys.argv[1])
pressures = np.load({pressures!r})
tolerances, levels = request["tolerances"], request["depths"].size
assert request["padding"] == 40 and np.isfinite(request["gap"]).any()
np.savez(
    sys.argv[2],
    version="1.2",
    pressures=[pressures * (1 + t) for t in tolerances],
    wall=np.full((len(tolerances), 1), 0.5 * int(request["threads"])),
    cpu=np.full((len(tolerances), 1), 0.25),
    setup_wall=9.0,
    iterations=np.full((len(tolerances), levels), 7),
    depth=np.tile(request["depths"], (len(tolerances), 1)),
    memory_mb=3.0,
    converged=np.ones((len(tolerances), levels), dtype=bool),
)
'''


@pytest.fixture(scope="module")
def problem():
    return methods.rough_problem(0.7, 33, 6, 1)


@pytest.fixture(scope="module")
def table(problem):
    return methods.measure(problem, 1)


def test_velocities_to_compare_with_are_those_of_the_direct_integration(problem):
    events = march_events(problem.indenter, until_fraction=0.95)
    here = problem.force < events.impulse[-1]
    last = np.searchsorted(events.impulse, problem.force[here], side="right") - 1
    np.testing.assert_allclose(problem.force[here] / events.resistance[last], problem.velocity[here], rtol=1e-9)
    assert here.sum() >= 4


def test_every_method_has_a_row_for_every_value(table):
    assert list(table.columns) == list(methods.COLUMNS)
    expected = {(m.name, float(v)) for m in methods.METHODS for v in m.values}
    assert set(zip(table["method"], table["value"], strict=True)) == expected
    assert (table["wall_s"] > 0).all()
    assert table["error"].between(0, 10).all()


@pytest.mark.parametrize(
    ("method", "value", "error"),
    [
        ("path, at the depths", 1e-10, 1e-9),
        ("path, no preconditioner", 1e-9, 1e-8),
        ("path, double precision", 1e-9, 1e-8),
        ("path, no tangent", 1e-9, 1e-8),
        ("path, each depth alone", 1e-9, 1e-8),
        ("events", 1.0, 1e-9),
        ("implicit", 1e-8, 1e-6),
        ("explicit, logarithmic steps", 1024, 0.05),
        ("heun, logarithmic steps", 1024, 0.03),
        ("path, automatic levels", 1e-4, 5e-3),
    ],
)
def test_exact_methods_are_exact_at_their_finest(table, method, value, error):
    row = table[(table["method"] == method) & (table["value"] == value)]
    assert row["error"].item() < error


def test_models_are_not_exact(table):
    for method in ("MDR", "Eq. 12 with Γ", "Eq. 12 without Γ"):
        assert table[table["method"] == method]["error"].min() > 0.01


def test_switching_a_part_off_leaves_it_on_afterwards(problem):
    before = indent(problem.indenter, tolerance=1e-6, depths=problem.depth)
    for part in methods.PARTS.values():
        methods._without(part, problem, 1e-3)
    after = indent(problem.indenter, tolerance=1e-6, depths=problem.depth)
    assert before.operator_applications == after.operator_applications
    np.testing.assert_array_equal(before.force, after.force)


def test_silence_counts_as_an_error_of_one(problem):
    method = methods.METHODS[0]
    velocity = np.where(np.arange(6) < 3, problem.velocity, np.nan)
    row = methods.row(problem, method, 1, methods.Answer(velocity), 0)
    assert row["error"] == pytest.approx(np.sqrt(0.5))
    assert row["largest_error"] == 1


def test_sphere_has_the_exact_velocity():
    sphere = methods.named_problem("sphere", 65, 5, 1)
    curve = indent(sphere.indenter, tolerance=1e-6, depths=sphere.depth)
    np.testing.assert_allclose(curve.force / curve.stiffness, sphere.velocity, rtol=0.05)


def test_pareto_front():
    table = pd.DataFrame({"wall_s": [3.0, 1.0, 2.0, 2.5, 4.0], "error": [0.1, 0.5, 0.6, 0.2, 0.1]})
    assert pareto_front(table)["wall_s"].tolist() == [1.0, 2.5, 3.0]


# ---- other solvers


@pytest.fixture
def peer(tmp_path):
    """A peer that has the pressures of three levels of a disc to 1e-8, times 1 + tolerance."""
    disc = self_affine_disc(0.7, 33, seed=2)
    depths = np.array([0.5, 1.0, 2.0])
    pressures = []
    from viscorough.contact.solver import ContactSolver

    solver = ContactSolver(disc, 1e-10)
    contact = solver.touch()
    for depth in depths:
        contact = solver.advance(contact, depth / solver.unit)
        pressure = np.zeros(disc.heights.shape)
        pressure[solver.place[0][contact.members], solver.place[1][contact.members]] = contact.pressure * solver.unit
        pressures.append(4 * np.pi * pressure / disc.spacing)
    stored = tmp_path / "pressures.npy"
    np.save(stored, pressures)
    adapter = tmp_path / "adapter.py"
    adapter.write_text(ADAPTER.format(pressures=str(stored)))
    return disc, depths, other_solvers.Peer("stand-in", Path(sys.executable), adapter)


def test_a_peers_residual_and_force_are_computed_from_its_pressures(peer):
    disc, depths, stand_in = peer
    exact = indent(disc, tolerance=1e-10, depths=depths)
    fine, coarse = other_solvers.ask(stand_in, disc, depths, exact.force, [1e-9, 1e-3])
    np.testing.assert_allclose(fine.force, exact.force, rtol=1e-8)
    assert fine.residual.max() < 1e-8
    assert 1e-4 < coarse.residual.max() < 3e-3
    assert (fine.version, fine.wall_s, fine.memory) == ("1.2", 0.5, 3e6)


def test_pressure_outside_the_indenter_is_no_solution(peer):
    disc, _, _ = peer
    pressure = np.zeros(disc.heights.shape)
    pressure[0, 0] = 1.0
    assert other_solvers.residual_of(disc.initial_gap / disc.spacing, pressure, 1.0) == np.inf


def test_race_takes_the_loosest_tolerance_that_meets_the_residual(peer, monkeypatch):
    disc, depths, stand_in = peer
    fractions = indent(disc, tolerance=1e-6, depths=depths).contact_fraction
    monkeypatch.setattr(other_solvers, "self_affine_disc", lambda *_, **__: disc)
    monkeypatch.setattr(other_solvers.np, "interp", lambda *_: depths)
    table = other_solvers.race(
        "three levels", 0.7, 33, fractions, 1e-4, [stand_in], threads=(1, 2), repeats=1, seed=2, longest=20
    )
    assert table["solver"].tolist() == ["viscorough", "stand-in", "stand-in"]
    assert table["tolerance"].tolist()[1] == table["tolerance"].tolist()[2] in (3e-4, 1e-4, 1e-4 / 3)
    assert (table["met"] == 1).all()
    assert table["wall_s"].tolist()[1:] == [0.5, 1.0]
    np.testing.assert_allclose(table["ratio"], table["wall_s"] / table["wall_s"][0])


def test_a_peer_that_fails_is_told_and_left_out(peer, tmp_path):
    disc, depths, _ = peer
    broken = tmp_path / "broken.py"
    broken.write_text("raise RuntimeError('no licence')")
    with pytest.warns(UserWarning, match="broken: RuntimeError: no licence"):
        assert other_solvers.ask(
            other_solvers.Peer("broken", Path(sys.executable), broken), disc, depths, depths, [1e-3]
        ) == [None]
    assert not other_solvers.Peer("absent", tmp_path / "python", broken).present


@pytest.mark.parametrize(("elements", "size"), [(257, 264), (1025, 1056), (8, 8), (33, 40)])
def test_padding_has_small_factors(elements, size):
    assert other_solvers.padded_size(elements) == size


# ---- scenes and timing


def test_scenes_are_answered_to_their_accuracy(monkeypatch):
    monkeypatch.setattr(level_placement, "NAIVE", (8, 16))
    monkeypatch.setattr(level_placement, "NUMBERS", (6, 32, 128))
    for scene in level_placement.scenes(33, 0.7, 1):
        table = level_placement.compare(scene, 1)
        assert list(table.columns) == list(level_placement.COLUMNS)
        automatic = table[table["choice"] == "automatic"]
        assert automatic["reached"].item() == 1
        assert automatic["ratio"].item() == 1
        assert (table[table["choice"] == "best by hand"]["error"] <= scene.accuracy).all()


def test_a_curve_from_a_start_is_as_good_from_there_on():
    disc = self_affine_disc(0.7, 65, seed=1)
    whole, later = (indent(disc, tolerance=1e-3, start_fraction=start, until_fraction=0.5) for start in (0.0, 0.1))
    assert later.depth.size < whole.depth.size / 2
    force = np.geomspace(*np.interp([0.1, 0.5], whole.contact_fraction, whole.force), 50)[:-1]
    np.testing.assert_allclose(later.at_force(force)[0], whole.at_force(force)[0], rtol=2e-3)
    # Where many elements touch at once there is no level close to the start.
    assert (
        indent(
            level_placement.scenes(17, 0.7, 1)[0].indenter, start_fraction=0.01, until_fraction=0.5
        ).contact_fraction[-1]
        >= 0.5
    )
    with pytest.raises(ValueError, match=r"start_fraction must be from 0 to below until_fraction, not 0\.9"):
        indent(disc, start_fraction=0.9, until_fraction=0.5)


def test_repeats_are_interleaved_and_the_median_is_taken():
    calls = []
    result = timing.interleaved({name: lambda n=name: calls.append(n) for name in "ab"}, 3)
    assert calls == list("ababab")
    assert set(result) == {"a", "b"}
    assert min(result["a"]) >= 0


def test_memory_is_that_of_arrays():
    array, memory = timing.with_memory(lambda: np.ones(1_000_000))
    assert array.size == 1_000_000
    assert 8e6 <= memory < 9e6


def test_convergence_error_passes_through(problem, monkeypatch):
    monkeypatch.setattr("viscorough.contact.solver._DENSE_MEMBERS", 0)
    monkeypatch.setattr("viscorough.contact.grid_solver._ITERATIONS", 1)
    with pytest.raises(ConvergenceError):
        methods._at_levels(problem, 1e-10)
