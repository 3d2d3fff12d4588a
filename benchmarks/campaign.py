"""Count silent failures: random small indenters whose loading curve is reported as converged but is wrong.

    python benchmarks/campaign.py --output results/campaign.json

Every curve is compared with direct integration in time, at its levels and between them: whole curves, curves with a
start fraction, and levels at given forces, also with the methods for large maps. `make stability` runs it. A failure is
printed with the command that repeats it.
"""

import warnings
from dataclasses import dataclass, replace
from functools import partial
from multiprocessing import Pool
from pathlib import Path
from unittest.mock import patch

import click
import numpy as np
from measuring import save
from random_heights import random_heights, with_random_aspect
from tqdm import tqdm

from viscorough.basics.errors import AccuracyWarning
from viscorough.contact.halfspace import tiles
from viscorough.contact.loading_path import indent
from viscorough.contact.options import DEFAULT, SolverOptions
from viscorough.contact.step_control import FINEST_ACCURACY
from viscorough.surfaces.indenter import Indenter
from viscorough.viscous.integration.events import newtonian_events
from viscorough.viscous.kinetics import kinetics
from viscorough_study.run.seeds import random_indenter_key, realization_seed

_LARGEST = 32  # largest number of elements across
# Share of the height differences below which the rounding of the heights dominates depths.
_HEIGHT_ROUNDING = 1e-13
# Solver options to draw from: the dense solver up to different sizes, and the grid from the first level on.
_OPTIONS = (DEFAULT, SolverOptions(dense_contacts=30, dense_interactions=300), SolverOptions(dense_interactions=0))


@dataclass(frozen=True)
class RandomCurve:
    """An indenter and the arguments of `indent` for it."""

    indenter: Indenter
    arguments: dict


def random_curve(generator, with_start=None, at_forces=False):
    """Draw a RandomCurve from a numpy Generator.

    with_start : give `start_fraction` or not; random by default
    at_forces : give levels by forces only
    """
    heights = random_heights(generator, int(generator.integers(2, _LARGEST + 1)))
    height, length = 10.0 ** generator.uniform(-9, 9, 2) if generator.random() < 0.2 else (1.0, 1.0)
    indenter = Indenter(height * heights, length)
    arguments = {"tolerance": 10.0 ** -generator.uniform(1, 6), "options": _OPTIONS[generator.integers(len(_OPTIONS))]}
    arguments["until_fraction"] = generator.uniform(0.01, 1.0) if generator.random() < 0.7 else 1.0
    if generator.random() < 0.3 if with_start is None else with_start:
        arguments["start_fraction"] = arguments["until_fraction"] * generator.uniform(0.01, 0.99)
    span = np.nanmax(indenter.initial_gap) or length
    if generator.random() < 0.2:
        arguments["until_force"] = span * length * indenter.elements**0.5 * 10.0 ** generator.uniform(-3, 1)
    if generator.random() < 0.2:
        arguments["depths"] = np.sort(span * 10.0 ** generator.uniform(-3, 1, generator.integers(1, 5)))
    if at_forces:
        forces = span * length * indenter.elements**0.5 * 10.0 ** generator.uniform(-5, 1.5, generator.integers(1, 5))
        arguments = {name: arguments[name] for name in ("tolerance", "options")} | {"forces": np.sort(forces)}
    return RandomCurve(with_random_aspect(indenter, generator), arguments)


def curve_failure(drawn, compute=indent):
    """Return an error message on the loading curve of a RandomCurve; "" if it is right.

    The reference is the direct integration in time, exact from event to event, which shares only the influence
    coefficients with the loading path. The error of the depth at the force of every level must be below the tolerance.
    So must the error of depths interpolated between levels (not below FINEST_ACCURACY), from the start fraction on,
    unless a warning was given. The kinetics under a force history must have the depths of the reference.
    """
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", AccuracyWarning)
        curve = compute(drawn.indenter, **drawn.arguments)
    events = newtonian_events(drawn.indenter)
    tolerance, rounding = drawn.arguments["tolerance"], _HEIGHT_ROUNDING * max(np.nanmax(drawn.indenter.initial_gap), 0)
    exact = events.depth_at(curve.force)
    if wrong := _error("depth {:.3g} of a level", curve.depth, curve.depth, exact, tolerance, rounding):
        return wrong
    if "depths" in drawn.arguments or "forces" in drawn.arguments:
        return _error_before(curve, events, max(tolerance, FINEST_ACCURACY), rounding)
    return "" if caught else _error_between(curve, events, drawn, max(tolerance, FINEST_ACCURACY), rounding)


def _error(name, places, depth, exact, tolerance, rounding):
    """Return a message on the largest error of depths if it exceeds the tolerance, or ""; name : template of a place"""
    error = np.nan_to_num(np.abs(depth / exact - 1) - rounding / exact, nan=np.inf)
    worst = error.argmax()
    if error[worst] <= tolerance:
        return ""
    return f"{name.format(places[worst])} off by {error[worst]:.2g}, tolerance {tolerance:.2g}"


def _error_between(curve, events, drawn, tolerance, rounding):
    """Return an error message on depths between the levels, or ""."""
    arguments, last = drawn.arguments, curve.force[-1]
    if curve.contact_fraction[-1] < arguments["until_fraction"] and last < arguments.get("until_force", np.inf):
        return f"stops at a contact fraction of {curve.contact_fraction[-1]:.3g}"
    before_start = curve.contact_fraction < arguments.get("start_fraction", 0.0)
    first = max(curve.force[before_start], default=0.0)
    force = events.impulse[(events.impulse > first) & (events.impulse < last)]
    force = np.unique(np.concatenate([force, (force[1:] + force[:-1]) / 2, [first + 0.5 * (last - first), last]]))
    exact = events.depth_at(force)
    if wrong := _error("depth at force {:.3g}", force, curve.at_force(force)[0], exact, tolerance, rounding):
        return wrong
    times = np.unique(np.append(0.0, force) / last)
    moved = kinetics(curve, np.full(times.shape, last), 1.0, times).depth[1:]
    return _error("depth at time {:.3g}", times[1:], moved, events.depth_at(last * times[1:]), tolerance, rounding)


def _error_before(curve, events, tolerance, rounding):
    """Return an error message on depths before the first given depth, which are returned only if exact; or ""."""
    force = curve.force[0] * np.array([1e-3, 0.3, 0.9])
    exact, depth = events.depth_at(force), curve.at_force(force)[0]
    depth = np.where(np.isnan(depth), exact, depth)
    return _error("depth before the first level", force, depth, exact, tolerance, rounding)


def as_on_large_maps(drawn):
    """Check a RandomCurve with tiled operators, estimates from blocks and few ranked elements."""
    options = replace(
        drawn.arguments["options"],
        rank_first=50,
        rank_all_for_curves=50,
        blocks_from=1,
        blocks_in_contact=1,
        tiles_from=0,
        tiles_share=1.0,
    )
    with patch.object(tiles, "SIDE", 8):
        return curve_failure(replace(drawn, arguments=drawn.arguments | {"options": options}))


# {family: (function that draws a curve, function that checks it, fraction of the number of curves)}
FAMILIES = {
    "curves": (random_curve, curve_failure, 1.0),
    "starts": (partial(random_curve, with_start=True), curve_failure, 0.1),
    "forces": (partial(random_curve, at_forces=True), curve_failure, 1.0),
    "large_maps": (partial(random_curve, at_forces=True), as_on_large_maps, 1.0),
}


def failure(family, seed, number):
    """Return the failure of one curve of a family, "" if there is none. Any exception counts as a failure."""
    draw, check, _ = FAMILIES[family]
    generator = np.random.default_rng(realization_seed(seed, *random_indenter_key(number)))
    try:
        return check(draw(generator))
    except Exception as error:
        return f"{type(error).__name__}: {error}"


@click.command()
@click.option(
    "--curves",
    type=click.IntRange(1),
    default=12_000,
    show_default=True,
    help="Curves.",
)
@click.option("--seed", type=click.IntRange(0), default=2013, show_default=True, help="Root seed.")
@click.option("--family", type=click.Choice(list(FAMILIES)), help="Only this family.")
@click.option("--number", type=click.IntRange(0), help="Only the curve of this number.")
@click.option("--cores", type=click.IntRange(1), default=1, show_default=True, help="Processes.")
@click.option("--output", type=click.Path(path_type=Path), help="File to write, JSON.")
def main(curves, seed, family, number, cores, output):
    """Count silent failures; the exit code is 1 if there is any."""
    counts, failures = {}, []
    for name in [family] if family else FAMILIES:
        numbers = [number] if number is not None else range(max(1, round(FAMILIES[name][2] * curves)))
        counts[name] = len(numbers)
        with Pool(cores) as pool:
            wrongs = pool.imap(partial(failure, name, seed), numbers)
            for tested, wrong in tqdm(zip(numbers, wrongs, strict=True), name, len(numbers), mininterval=2):
                if wrong:
                    failures.append({"family": name, "number": tested, "wrong": wrong})
                    repeat = f"python benchmarks/campaign.py --family {name} --number {tested} --seed {seed}"
                    tqdm.write(f"{wrong}\n    {repeat}")
    click.echo(f"{len(failures)} silent failures among {sum(counts.values())} curves")
    if output:
        save({"seed": seed, "curves": counts, "silent_failures": failures}, output)
    raise SystemExit(bool(failures))


if __name__ == "__main__":
    main()
