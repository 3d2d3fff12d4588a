"""A file of a known map of heights, and the random choices that make it; for file_campaign.py."""

from dataclasses import dataclass, field
from functools import partial

import numpy as np

UNITS = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "nm": 1e-9, "µm": 1e-6, "\u03bcm": 1e-6, "micron": 1e-6, "microns": 1e-6}
UNITS |= {"micrometer": 1e-6, "cm": 1e-2, "Å": 1e-10, "pm": 1e-12}
PIXELS = ("px", "pixel", "pixels", "points", "Pixel", "pts", "dots")  # no lengths


def generators(seed, numbers):
    """(number, random generator) of numbered cases; each depends on the seed and its number only."""
    for number in numbers:
        yield number, np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(number,)))


@dataclass
class Case:
    """A file, the arguments with which it is read, and the expected result.

    kind : of file; traits : the variations that were drawn
    heights : the numbers, nan where missing, in `unit`; None if the file must be refused
    unit : of the heights, in metres; None if neither file nor arguments state it
    spacing : (dx, dy) in metres, or plain numbers where the unit is not known
    accuracy : relative, of the spacing that the file states
    unambiguous : whether every competent reader must read the file
    faulty_line : whether the only fault is in a line of text, which a refusal must then name
    """

    kind: str
    name: str
    content: bytes
    heights: np.ndarray | None
    unit: float | None
    spacing: tuple
    options: dict = field(default_factory=dict)
    accuracy: float = 1e-12
    unambiguous: bool = True
    faulty_line: bool = False
    traits: tuple = ()


class Draft:
    """Random choices of a file: their names, and whether they leave it unambiguous, or unreadable."""

    def __init__(self, kind, random):
        self.kind, self.random, self.traits = kind, random, []
        self.clear, self.bad, self.faulty_line, self.oddities = True, False, False, 0

    def chance(self, share):
        return self.random.random() < share

    def one_of(self, choices):
        """One of the choices, without recording it."""
        return choices[self.random.integers(len(choices))]

    def pick(self, clear, unclear=(), bad=(), odd=0.12):
        """A value of tables {name: value}, or of names alone; mostly a clear one. Its name becomes a trait.

        Files with `unclear` ones may be refused, files with `bad` ones must be.
        """
        roll = self.random.random()
        table = bad if bad and roll < odd / 3 else unclear if unclear and roll < odd else clear
        name = self.one_of(list(table))
        self.note(name, clear=table is clear, bad=bool(bad) and table is bad)
        return table[name] if isinstance(table, dict) else name

    def note(self, trait, *, clear=True, bad=False, faulty_line=False):
        """Record a variation."""
        self.traits.append(trait)
        self.clear &= clear and not bad
        self.bad |= bad
        self.faulty_line |= faulty_line
        self.oddities += bad or not clear

    def case(self, name, content, heights, unit, spacing, options=None, accuracy=1e-12):
        make = partial(Case, self.kind, name, content, None if self.bad else heights, unit, spacing, options or {})
        return make(accuracy, self.clear, self.faulty_line and self.oddities == 1, tuple(filter(None, self.traits)))


def distances(draft, square=False):
    """(dx, dy), short decimal numbers of moderate aspect."""
    dx = draft.one_of([0.5, 0.25, 1.5, 2.0, 0.37, 12.5, 0.125, 0.08])
    return dx, dx if square or draft.chance(0.3) else round(dx * draft.one_of([0.8, 1.6, 2.0, 0.5, 3.0]), 6)


def map_shape(draft, least=2):
    """(rows, columns) of a small map."""
    return tuple(int(n) for n in draft.random.integers(least, 13 if draft.chance(0.7) else 5, 2))


def missing_points(draft, shape):
    """Mask of missing points: none, single ones, those outside a disc, or entire rows or columns."""
    mask = np.zeros(shape, bool)
    form = draft.one_of([*["none"] * 5, *["random", "first", "last", "round", "column", "row"] * 2, "first row"])
    row, column = (int(draft.random.integers(n)) for n in shape)
    if form == "random":
        mask = draft.random.random(shape) < 0.25
    elif form == "round":
        y, x = np.mgrid[: shape[0], : shape[1]]
        mask = np.hypot(y / (shape[0] - 1 or 1) - 0.5, x / (shape[1] - 1 or 1) - 0.5) > 0.6
    elif form in ("first", "last"):
        mask[(0, 0) if form == "first" else (-1, -1)] = True
    elif form == "column":
        mask[:, column] = True
    elif form != "none":
        mask[row if form == "row" else 0] = True
    if (~mask).sum() < 2:
        mask[:] = False
    if mask.any():
        draft.note(f"missing: {form}")
    return mask
