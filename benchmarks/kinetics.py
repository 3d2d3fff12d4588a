"""Measure what kinetics under long force histories cost, in one process.

    python benchmarks/kinetics.py --output results/kinetics.json

Keys: `samples` and `branches` of a Prony series and the median `wall_s` of kinetics in it; the same for a springpot,
whose cost grows with the square of the samples.
"""

import argparse
import time
from pathlib import Path

import numpy as np

import viscorough
from viscorough import indent, kinetics, self_affine_disc
from viscorough.viscous.media import Prony, Springpot
from viscorough_study.performance import timing
from viscorough_study.tables import write_json

BRANCHES = 10


def wall_seconds(curve, medium, samples, repeats):
    """Median time of kinetics under a rising force with noise, after one call that loads the compiled code."""
    times = np.linspace(0, 100, samples)
    force = np.cumsum(np.random.default_rng(1).random(samples))
    force *= 0.9 * curve.force[-1] / (force[-1] * medium.creep_compliance(times[-1]))
    walls = []
    for _ in range(repeats + 1):
        start = time.perf_counter()
        kinetics(curve, force, medium, times)
        walls.append(time.perf_counter() - start)
    return float(np.median(walls[1:]))


def measured(samples, samples_of_springpot, repeats):
    """The content of the file."""
    curve = indent(self_affine_disc(0.7, 65, seed=1), until_fraction=0.5)
    series = Prony(0.5, np.ones(BRANCHES), np.geomspace(1e-4, 1e4, BRANCHES))
    springpot = Springpot(2.0, 0.4)
    rows = {
        "prony": {"samples": samples, "branches": BRANCHES, "wall_s": wall_seconds(curve, series, samples, repeats)},
        "springpot": {
            "samples": samples_of_springpot,
            "wall_s": wall_seconds(curve, springpot, samples_of_springpot, repeats),
        },
    }
    return {"machine": timing.machine(), "viscorough": viscorough.__version__} | rows


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--output", type=Path, required=True, help="file to write, JSON")
    parser.add_argument("--repeats", type=int, default=5, help="repeats of which the median is taken")
    arguments = parser.parse_args()
    result = measured(100_000, 2_000, arguments.repeats)
    for name in ("prony", "springpot"):
        print("{name}: {samples} samples in {wall_s:.3f} s".format(name=name, **result[name]))
    write_json(result, arguments.output)


if __name__ == "__main__":
    main()
