"""Measure the cost of a large map, similar to measured ones: its curve, and the contact at a force.

    python benchmarks/large_map.py --output results/large_map.json

The map is a self-affine square with H = 0.8 and no roll-off, of 2049 points across. The curve is computed from first
touch to a contact fraction of 50 %, and the contact at one force with about 10 % in contact, on one thread. The file
has the medians of wall and processor seconds, and the contact fractions.
"""

from measuring import command, medians

from viscorough import Indenter, contact_at, indent
from viscorough.surfaces import self_affine_square

HURST, SEED, TOLERANCE, POINTS = 0.8, 1, 1e-3, 2049
# F/G over rms height and side of the map, at which about 10 % are in contact.
FORCE = 9.0
UNTIL_FRACTION = 0.5


def measured(repeats, points=POINTS):
    """{"curve", "contact": cost}"""
    surface = Indenter(self_affine_square(HURST, points, seed=SEED), 1 / points)
    questions = {
        "curve": lambda: indent(surface, tolerance=TOLERANCE, until_fraction=UNTIL_FRACTION).contact_fraction[-1],
        "contact": lambda: contact_at(surface, force=FORCE, tolerance=TOLERANCE).contact_fraction,
    }
    cost = {
        question: {"wall_s": wall, "processor_s": processor, "contact_fraction": float(questions[question]())}
        for question, (wall, processor) in medians(questions, repeats).items()
    }
    return {"points": points, "tolerance": TOLERANCE, **cost}


main = command(measured, repeats=1)

if __name__ == "__main__":
    main()
