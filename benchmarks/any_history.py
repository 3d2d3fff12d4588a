"""Measure cost and accuracy of motions that load, unload and reload.

    python benchmarks/any_history.py --output results/any_history.json

1. Cost: 1000 times on the default curve of a disc in a Prony series of five branches. The same number of steps of
   direct integration with about 2000 elements in contact is extrapolated from a few steps.
2. Levels: the difference between the forces on the default curve and on a curve of many levels, over the largest force,
   for peaks at shares of the last depth.
"""

from pathlib import Path
from time import process_time

import click
import numpy as np
from measuring import save

from viscorough import Load, Prony, indent, kinetics, march, self_affine_disc

MEDIUM = Prony(0.5, [4.0, 3.0, 2.0, 1.0, 1.0], [0.01, 0.1, 0.5, 2.0, 20.0])
SHAPE = Load([0.0, 1.0, 1.4, 2.2, 3.0], depth=[0.0, 1.0, 1.0, 0.2, 0.9])
TIMES, PEAKS = 1000, (0.9, 0.3, 0.1, 0.03)
REPEATS, DIRECT_STEPS = 7, 6
HURST = 0.7


def history(peak):
    return Load(SHAPE.time, depth=peak * SHAPE.values)


def cost(across, direct_across, contact):
    """Return the processor time of 1000 times, levels of its curve, and the time ratio of direct integration."""
    curve = indent(self_affine_disc(HURST, across, rms=0.01, seed=5))
    load, times = history(0.9 * curve.depth[-1]), np.linspace(0, SHAPE.time[-1], TIMES)
    kinetics(curve, load, MEDIUM, times)  # compiles the functions
    seconds = []
    for _ in range(REPEATS):
        start = process_time()
        kinetics(curve, load, MEDIUM, times)
        seconds.append(process_time() - start)
    disc = self_affine_disc(HURST, direct_across, rms=0.01, seed=5)
    touched = indent(disc, until_fraction=min(1.0, 1.1 * contact / disc.elements))
    depth = np.interp(contact, touched.contact_count, touched.depth)
    # The steps are at the turn, where contact is largest.
    steps = np.append(0.0, np.linspace(1.0, 1.02, DIRECT_STEPS))
    loads = depth * np.append(0.0, np.linspace(1.0, 0.98, DIRECT_STEPS))
    start = process_time()
    motion = march(disc, Load(steps, depth=loads), MEDIUM)
    per_step = (process_time() - start) / steps.size
    return {
        "levels": int(curve.depth.size),
        "kinetics_s": min(seconds),
        "direct_elements": round(motion.contact_fraction.max() * disc.elements),
        "direct_s_per_step": per_step,
        "ratio": TIMES * per_step / min(seconds),
    }


def levels(across, number):
    """Return, for each peak, the largest difference of forces between the default curve and one of many levels."""
    disc = self_affine_disc(HURST, across, rms=0.01, seed=5)
    curve = indent(disc)
    fine = indent(disc, tolerance=1e-7, depths=np.geomspace(curve.depth[0], curve.depth[-1], number))
    times, errors = np.linspace(0, SHAPE.time[-1], 201), {}
    for peak in PEAKS:
        load = history(peak * curve.depth[-1])
        found, expected = (kinetics(each, load, MEDIUM, times).force for each in (curve, fine))
        errors[str(peak)] = float(np.abs(found - expected).max() / expected.max())
    return errors


@click.command()
@click.option("--across", type=click.IntRange(9), default=257, show_default=True, help="Elements across, for the cost.")
@click.option("--direct-across", type=click.IntRange(9), default=65, show_default=True, help="In direct integration.")
@click.option("--contact", type=click.IntRange(1), default=2000, show_default=True, help="Elements in contact there.")
@click.option("--levels-across", type=click.IntRange(9), default=129, show_default=True, help="For the levels.")
@click.option("--levels", "number", type=click.IntRange(10), default=4000, show_default=True, help="Of the fine curve.")
@click.option("--output", type=click.Path(path_type=Path), help="File to write, JSON.")
def main(across, direct_across, contact, levels_across, number, output):
    """Measure cost and accuracy of motions that unload."""
    result = {"cost": cost(across, direct_across, contact)}
    click.echo(result["cost"])
    result["levels"] = levels(levels_across, number)
    click.echo(result["levels"])
    if output:
        save(result, output)


if __name__ == "__main__":
    main()
