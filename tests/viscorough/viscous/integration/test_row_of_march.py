"""The theorem of docs/theory.md on a grid: march, and the row of springs of the indenter with the same steps in time.

    ROWS=10 python -m pytest -s tests/viscorough/viscous/integration/test_row_of_march.py

tries ten histories for each kind of map, of 17, 25 or 33 elements across, for both loads and all media of springs and
dashpots, and prints the largest difference.
By default one history on maps of 9 elements across is tried.
"""

import os

import numpy as np
import pytest

from support.media import SPRINGS_AND_DASHPOTS
from support.row_steps import stepped_row
from viscorough import Indenter, Load, indent, kinetics, march, self_affine_disc
from viscorough.viscous.integration.events import newtonian_events

COUNT = int(os.environ.get("ROWS", "0"))
SIZES = (17, 25, 33) if COUNT else (9,)
TOLERANCE = 1e-12  # relative to the largest force or depth


def rough(across, hurst, seed):
    return self_affine_disc(hurst, across, rms=0.1, seed=seed).heights


def holes(heights, random):
    return np.where(random.random(heights.shape) < 0.2, np.nan, heights)


def towers(across):
    heights = np.full((across, across), -0.4)
    heights[across // 4, across // 4], heights[-across // 4, across // 2 : across // 2 + 3] = 0.0, -0.05
    return heights


def heights_of(kind, across, seed):
    """Return heights of one of twelve kinds of maps."""
    random = np.random.default_rng(seed)
    rows, columns = np.indices((across, across)) - across // 2
    if kind.startswith("self-affine"):
        return rough(across, float(kind.split()[1]), seed)
    if kind == "rectangles":
        return rough(across, 0.7, seed)
    if kind == "towers":
        return towers(across)
    return {
        "quantised": lambda: np.round(10 * rough(across, 0.7, seed)) / 10,
        "crater": lambda: -0.5 / across * np.abs(np.hypot(rows, columns) - across / 4),
        "holes": lambda: holes(0.1 * random.standard_normal((across, across)), random),
        "checkerboard": lambda: 0.2 * ((rows + columns) % 2) + 0.01 * random.random((across, across)),
        "sphere": lambda: -(rows**2 + columns**2) / across**2,
        "cone": lambda: -np.hypot(rows, columns) / across,
        "waves": lambda: 0.1 * np.cos(2 * np.pi * rows / 8) * np.cos(2 * np.pi * columns / 6),
    }[kind]()


KINDS = ["self-affine 0.3", "self-affine 0.7", "self-affine 0.9", "rectangles", "quantised", "crater", "holes"]
KINDS += ["checkerboard", "towers", "sphere", "cone", "waves"]


def random_load(random, control, scale, *, rigid):
    """Return a load from 0 to a scale: ramps, holds and rests, and steps unless a dashpot forbids them."""
    corners = np.cumsum(10 ** random.uniform(-1, 0.5, random.integers(4, 9)))
    shape = random.random(corners.size) * random.choice([0.0, 1.0, 1.0, 1.0], corners.size)
    held = np.flatnonzero(random.random(corners.size - 1) < 0.3)
    shape[held + 1] = shape[held]
    corners, shape = np.append(0.0, corners), np.append(0.0, shape)
    steps = 1 + (random.random(corners.size) < (0.0 if rigid and control == "depth" else 0.2))
    times, values = np.repeat(corners, steps), np.repeat(shape, steps)
    second = np.flatnonzero(np.diff(times) == 0) + 1
    values[second] *= random.random(second.size)
    return Load(times, **{control: scale * values})


def with_steps(load, parts):
    inner = [np.linspace(a, b, parts, endpoint=False) for a, b in zip(load.time[:-1], load.time[1:], strict=True)]
    return load.with_times(np.unique(np.concatenate([*inner, load.time])))[0]


def difference(indenter, medium, load):
    """Return the difference of the row from march, over the largest depth or force."""
    events = newtonian_events(indenter)
    row = events.depth, np.diff(events.resistance, prepend=0.0)
    marched = march(indenter, load, medium)
    control = "depth" if load.by_depth else "force"
    steps = stepped_row(*row, medium.relaxation, load.time, **{control: load.values})
    one, other = (each.force if load.by_depth else each.depth for each in (marched, steps))
    return np.abs(one - other).max() / max(np.abs(one).max(), np.finfo(float).tiny)


@pytest.mark.parametrize("control", ["force", "depth"])
@pytest.mark.parametrize("kind", KINDS)
def test_march_equals_the_row_of_springs_with_the_same_steps(kind, control):
    largest = 0.0
    for number in range(max(COUNT, 1)):
        across = SIZES[number % len(SIZES)]
        heights = heights_of(kind, across, number)
        indenter = Indenter(heights, 1.0, 3.0 if kind == "rectangles" else 1.0)
        events = newtonian_events(indenter, until_fraction=0.5)
        for place, (name, medium) in enumerate(SPRINGS_AND_DASHPOTS.items()):
            random = np.random.default_rng([54, number, across, place])
            rigid = name in ("newtonian", "kelvin-voigt")
            scale = events.depth[-1] if control == "depth" else events.impulse[-1]
            load = with_steps(random_load(random, control, scale, rigid=rigid), 5)
            found = difference(indenter, medium, load)
            assert found < TOLERANCE, (across, number, name)
            largest = max(largest, found)
    print(f"{kind}, {control}: largest difference {largest:.2g}")


@pytest.mark.parametrize("control", ["force", "depth"])
@pytest.mark.parametrize("name", ["maxwell", "solid", "prony"])
def test_kinetics_is_the_limit_of_march(name, control):
    """March, as a row with the same steps, is extrapolated to steps of length 0; its error is of second order."""
    across, parts = (17, 4096) if COUNT else (9, 1024)
    indenter, medium = Indenter(heights_of("self-affine 0.7", across, 1), 1.0), SPRINGS_AND_DASHPOTS[name]
    curve, events = indent(indenter, tolerance=1e-11, until_fraction=1.0), newtonian_events(indenter)
    row = events.depth, np.diff(events.resistance, prepend=0.0)
    scale = 0.5 * (curve.depth[-1] if control == "depth" else curve.force[-1])
    load = Load([0, 1, 1.5, 2.5, 3.3, 3.3, 4.0], **{control: scale * np.array([0, 1, 1, 0.2, 0.8, 0.5, 0.1])})
    motions = []
    for n in (parts, 2 * parts):
        fine = with_steps(load, n)
        steps = stepped_row(*row, medium.relaxation, fine.time, **{control: fine.values})
        place = np.searchsorted(fine.time, load.time, side="right") - 1
        motions.append((steps.force if load.by_depth else steps.depth)[place])
    limit = (4 * motions[1] - motions[0]) / 3
    motion = kinetics(curve, load, medium)
    found = motion.force if load.by_depth else motion.depth
    after = np.diff(load.time, append=np.inf) > 0
    error = np.abs(found - limit)[after].max() / np.abs(limit).max()
    print(f"{name}, {control}: kinetics differs by {error:.2g} from march without steps")
    assert error < 1e-6
