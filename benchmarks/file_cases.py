"""Random choices for a file of a given map of heights; for file_campaign.py."""

from dataclasses import dataclass

import numpy as np

UNITS = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "nm": 1e-9, "µm": 1e-6, "\u03bcm": 1e-6, "micron": 1e-6, "microns": 1e-6}
UNITS |= {"micrometer": 1e-6, "cm": 1e-2, "Å": 1e-10, "pm": 1e-12}


def generators(seed, numbers):
    """Yield (number, random generator) of numbered cases; each depends on the seed and its number only."""
    for number in numbers:
        yield number, np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(number,)))


class Draft:
    """Random choices of a file.

    traits : names of the choices
    clear : whether every competent reader must read the file
    bad : whether the file must be refused
    """

    def __init__(self, random):
        self.random, self.traits, self.clear, self.bad = random, [], True, False

    def chance(self, share):
        return self.random.random() < share

    def one_of(self, choices):
        """Return one of the choices without recording it."""
        return choices[self.random.integers(len(choices))]

    def pick(self, clear, unclear=(), bad=(), odd=0.12):
        """Draw a value from tables {name: value} or from names, mostly a clear one, and record its name as a trait.

        A file with an `unclear` value may be refused; a file with a `bad` value must be refused.
        """
        roll = self.random.random()
        table = bad if bad and roll < odd / 3 else unclear if unclear and roll < odd else clear
        name = self.one_of(list(table))
        self.note(name, clear=table is clear, bad=bool(bad) and table is bad)
        return table[name] if isinstance(table, dict) else name

    def note(self, trait, *, clear=True, bad=False):
        """Record a variation."""
        self.traits += [trait] if trait else []
        self.clear &= clear and not bad
        self.bad |= bad


@dataclass
class Case:
    """A file, the arguments with which it is read, and the expected result.

    draft : the variations that were drawn
    kind : of file
    heights : the numbers, nan where missing, in `unit`
    unit : of the heights, in metres; None if neither file nor arguments state it
    spacing : (dx, dy) in metres, or plain numbers if the unit is unknown
    accuracy : relative, of the spacing that the file states
    is_line : True for a profile, which read_line reads and read_heights must refuse
    """

    draft: Draft
    kind: str
    name: str
    content: bytes
    heights: np.ndarray
    unit: float | None
    spacing: tuple
    options: dict
    accuracy: float = 1e-12
    is_line: bool = False


def distances(draft, square=False):
    """Draw (dx, dy): short decimal numbers of moderate aspect."""
    dx = draft.one_of([0.5, 0.25, 1.5, 2.0, 0.37, 12.5, 0.125, 0.08])
    return dx, dx if square or draft.chance(0.3) else round(dx * draft.one_of([0.8, 1.6, 2.0, 0.5, 3.0]), 6)


def map_shape(draft):
    """Draw (rows, columns) of a small map."""
    return tuple(int(n) for n in draft.random.integers(2, 13 if draft.chance(0.7) else 5, 2))


def missing_points(draft, shape):
    """Draw a mask of missing points: none, single points, all outside a disc, or entire rows or columns."""
    y, x = (np.indices(shape).T / (np.array(shape) - 1) - 0.5).T
    row, column = (int(draft.random.integers(n)) for n in shape)
    masks = {
        "random": draft.random.random(shape) < 0.25,
        "corner": (x == -0.5) & (y == draft.one_of([-0.5, 0.5])),
        "round": np.hypot(x, y) > 0.6,
        "column": np.indices(shape)[1] == column,
        "row": np.indices(shape)[0] == draft.one_of([0, row]),
    }
    form = draft.one_of([None, *masks])
    if form is None or not masks[form].any() or (~masks[form]).sum() < 2:
        return np.zeros(shape, bool)
    draft.note(f"missing: {form}")
    return masks[form]
