"""Measure what a large measured-like map costs on one thread and on several: its curve, and the contact at a force.

    python benchmarks/large_map.py --output results/large_map.json

The map is a self-affine square with H = 0.8 and no roll-off, of 2049 points across. Two processes of their own compute
the curve from first touch to a contact fraction of 50 %, and the contact at one force with about 10 % in contact. Each
has compiled everything before, on a small map. The file has the wall and processor seconds and the peak of the
process's memory, the map, the interpreter and libraries included; medians, if there are repeats.
"""

import numpy as np
import pandas as pd
from measuring import command, in_a_process, peak_bytes

from viscorough import Indenter, contact_at, indent, self_affine_disc
from viscorough.surfaces import self_affine_square
from viscorough_study.performance import timing

HURST, SEED, TOLERANCE, POINTS, THREADS = 0.8, 1, 1e-3, 2049, 2
# F/G over rms height and side of the map, at which about 10 % are in contact.
FORCE = 9.0
UNTIL_FRACTION = 0.5


def curve(surface, threads):
    """The loading curve to the contact fraction."""
    result = indent(surface, tolerance=TOLERANCE, until_fraction=UNTIL_FRACTION, threads=threads)
    return {
        "levels": len(result.depth),
        "operator_applications": result.operator_applications,
        "contact_fraction": float(result.contact_fraction[-1]),
    }


def contact(surface, threads):
    """The contact at the force."""
    result = contact_at(surface, force=FORCE, tolerance=TOLERANCE, threads=threads)
    balance = np.nansum(result.pressure) * result.spacing * result.row_spacing / result.force - 1
    return {
        "contact_fraction": result.contact_fraction,
        "patches": len(result.patches().areas),
        "residual": result.residual,
        "force_balance": float(balance),
    }


QUESTIONS = {"curve": curve, "contact": contact}


def cost(question, points, threads):
    """Cost of the answer to one question, in this process."""
    QUESTIONS[question](self_affine_disc(HURST, 129, seed=SEED), threads)
    surface = Indenter(self_affine_square(HURST, points, seed=SEED), 1 / points)
    result, wall, processor = timing.timed(lambda: QUESTIONS[question](surface, threads))
    return {"wall_s": wall, "processor_s": processor, "peak_bytes": peak_bytes(), **result}


def measured(repeats):
    """{question, on one thread or on several: cost}"""
    result = {"points": POINTS, "tolerance": TOLERANCE, "threads": THREADS}
    for question in QUESTIONS:
        for threads, name in ((1, question), (THREADS, f"{question}_threads")):
            runs = [in_a_process("large_map", "cost", question, POINTS, threads) for _ in range(repeats)]
            result[name] = pd.DataFrame(runs).median().to_dict()
    return result


main = command(measured, repeats=1)

if __name__ == "__main__":
    main()
