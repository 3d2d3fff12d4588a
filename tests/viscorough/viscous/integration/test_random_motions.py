"""Random motions of a few elements in media of springs and dashpots, against two independent solvers.

    MOTIONS=2000 python -m pytest -s tests/viscorough/viscous/integration/test_random_motions.py

runs 2000 motions and prints the largest deviation. Contact recedes and returns, and there are rests and steps of force
and depth. One solver integrates all elements of the half-space, the other a row of independent springs with the same
loading curve. In exact arithmetic both give the same motion as march.
"""

import os
from dataclasses import dataclass

import numpy as np
import pytest

from support.marching import stepped
from support.small_motion import SpringsAndDashpots, half_space, row_of_springs, small_motion
from viscorough import Indenter
from viscorough.media.kinds import KelvinVoigt, Maxwell, Newtonian, Prony, StandardLinearSolid
from viscorough.media.medium import Medium
from viscorough.viscous.integration.events import newtonian_events

COUNT = int(os.environ.get("MOTIONS", "40"))
TOLERANCE = 1e-9


@dataclass(frozen=True)
class Case:
    """An indenter, a medium in the form of both solvers, and `force` or `depth` over time, by its name."""

    indenter: Indenter
    medium: Medium
    same_medium: SpringsAndDashpots
    times: np.ndarray
    load: dict


def random_case(number):
    random = np.random.default_rng([2013, number])
    heights = random_heights(random)
    height, length = 10.0 ** random.uniform(-6, 6, 2) if random.random() < 0.3 else (1.0, 1.0)
    indenter = Indenter(height * heights, *(length * random.uniform(0.5, 2, 2)))
    medium, same_medium, own_time = random_medium(random)
    times = random_times(random, own_time)
    shape = random_shape(random, times)
    if random.random() < 0.5:
        if same_medium.viscosity:
            shape = without_steps_up(shape, times)
        return Case(indenter, medium, same_medium, times, {"depth": random.choice([height, length]) * shape})
    modulus = same_medium.viscosity / own_time or same_medium.mean_modulus(0.0, own_time)
    force = modulus * height * length * np.sqrt(heights.size) * 10.0 ** random.uniform(-1, 1)
    return Case(indenter, medium, same_medium, times, {"force": force * shape})


def random_heights(random):
    """Return up to 3 x 4 heights: rough, on terraces, all equal, or with missing elements."""
    heights = random.standard_normal((random.integers(1, 4), random.integers(1, 5)))
    kind = random.choice(["rough", "terraces", "flat", "holes"])
    if kind == "terraces":
        return np.round(heights)
    if kind == "flat":
        return np.zeros_like(heights)
    if kind == "holes" and heights.size > 2:
        heights.flat[random.choice(heights.size, random.integers(1, heights.size - 1), replace=False)] = np.nan
    return heights


def random_medium(random):
    """Return a medium of the package, the same medium as SpringsAndDashpots, and one of its relaxation times."""
    kind = random.choice(["newtonian", "maxwell", "kelvin-voigt", "solid", "prony"])
    decades = random.choice([1.0, 6.0])
    modulus, time = 10.0 ** random.uniform(-decades, decades, 2)
    viscosity = modulus * time
    if kind == "newtonian":
        return Newtonian(viscosity), SpringsAndDashpots(viscosity, 0.0), time
    if kind == "kelvin-voigt":
        return KelvinVoigt(modulus, viscosity), SpringsAndDashpots(viscosity, modulus), time
    if kind == "maxwell":
        return Maxwell(modulus, viscosity), SpringsAndDashpots(0.0, 0.0, (modulus,), (time,)), time
    if kind == "solid":
        relaxed = modulus * 10.0 ** random.uniform(-4, -0.01)
        branches = SpringsAndDashpots(0.0, relaxed, (modulus - relaxed,), (time,))
        return StandardLinearSolid(modulus, relaxed, time), branches, time
    count = random.integers(1, 5)
    moduli = tuple(modulus * 10.0 ** random.uniform(-2, 2, count))
    relaxation_times = tuple(time * 10.0 ** random.uniform(-decades / 2, decades / 2, count))
    relaxed = random.choice([0.0, modulus * 10.0 ** random.uniform(-2, 1)])
    return Prony(relaxed, moduli, relaxation_times), SpringsAndDashpots(0.0, relaxed, moduli, relaxation_times), time


def random_times(random, own_time):
    """Return times at equal distances or at distances many decades apart; some of them occur twice."""
    count = random.integers(3, 30)
    equal = np.full(count, 10.0 ** random.uniform(-1.5, 0.5))
    times = own_time * np.cumsum(equal if random.random() < 0.5 else 10.0 ** random.uniform(-5, 3, count))
    times -= random.choice([0.0, times[0]])
    return np.repeat(times, 1 + (random.random(times.size) < random.choice([0.0, 0.2])))


def random_shape(random, times):
    """Return a load from 0 to about 1, with ramps, cycles, holds and rests; a repeated time has a step."""
    number = np.arange(times.size)
    kind = random.choice(["random", "ramps", "cycles", "pulses"])
    if kind == "random":
        shape = random.random(times.size)
    elif kind == "ramps":
        turns = np.sort(random.choice(times.size, min(times.size, random.integers(2, 6)), replace=False))
        shape = np.interp(number, turns, random.random(turns.size) * random.integers(0, 2, turns.size))
    elif kind == "cycles":
        shape = abs(np.sin(number * random.uniform(0.1, 1.5))) * np.exp(-0.2 * random.random() * number)
    else:
        shape = np.repeat(random.random(times.size) * random.integers(0, 2, times.size), 3)[: times.size]
    if random.random() < 0.3:
        shape = np.round(4 * shape) / 4  # so that values repeat
    if random.random() < 0.5:
        shape[0] = 0.0
    return shape


def without_steps_up(shape, times):
    """Return the load with a start at 0 and without steps up, as a dashpot requires."""
    shape = np.append(0.0, shape[1:])
    for n in np.flatnonzero(np.diff(times) == 0) + 1:
        shape[n] = min(shape[n], shape[n - 1])
    return shape


def deviation(case, *, by_springs):
    """Return the largest deviation of depths, forces and loads; require equal contact and equal times of receding.

    The deviation is relative to the value itself plus a thousandth of the largest value.

    by_springs : compare with the row of springs
    """
    indenter = case.indenter
    result = stepped(indenter, case.medium, case.times, **case.load)
    exists = np.isfinite(indenter.heights)
    loads = result.pressure[exists] * indenter.spacing * indenter.row_spacing
    assert (loads >= 0).all()
    if by_springs:
        events = newtonian_events(indenter)
        problem = row_of_springs(events.depth, np.diff(events.resistance, prepend=0.0))
    else:
        problem = half_space(indenter.heights, (indenter.spacing, indenter.row_spacing))
    exact = small_motion(*problem, case.same_medium, case.times, **case.load)
    np.testing.assert_array_equal(result.contact_count, exact.contact_count)
    np.testing.assert_equal(result.receding_from, exact.receding_from)
    pairs = [(result.depth, exact.depth, exact.depth.max()), (result.force, exact.force, exact.force.max())]
    if not by_springs:
        pairs.append((loads, exact.loads, exact.force.max()))
    return max(
        (abs(one - other) / (abs(other) + 1e-3 * largest + np.finfo(float).tiny)).max() for one, other, largest in pairs
    )


def outcome(number, *, by_springs):
    """Return the deviation of a case and its fault, "" if there is none; any exception is a fault."""
    try:
        found = deviation(random_case(number), by_springs=by_springs)
    except Exception as error:
        return np.inf, f"{type(error).__name__}: {error}"
    return found, "" if found < TOLERANCE else f"deviation {found:.2g}"


@pytest.mark.parametrize("by_springs", [False, True], ids=["half-space", "row of springs"])
def test_random_motions_agree_with_independent_solvers(by_springs):
    outcomes = {number: outcome(number, by_springs=by_springs) for number in range(COUNT)}
    wrong = {number: text for number, (_, text) in outcomes.items() if text}
    print(f"{COUNT} motions, {len(wrong)} wrong, largest deviation {max(found for found, _ in outcomes.values()):.2g}")
    assert wrong == {}


def test_cases_cover_receding_returning_and_steps():
    """Contact recedes in most cases and returns in many. Every kind of medium and load has steps."""
    cases = [random_case(number) for number in range(60)]
    receded = returned = 0
    for case in cases:
        motion = stepped(case.indenter, case.medium, case.times, **case.load)
        later = motion.contact_count[motion.time >= motion.receding_from]
        receded += np.isfinite(motion.receding_from)
        returned += (np.diff(later) > 0).any()
    assert receded > 30
    assert returned > 20
    kinds = {(type(case.medium), *case.load) for case in cases if (np.diff(case.times) == 0).any()}
    assert len(kinds) == 10
