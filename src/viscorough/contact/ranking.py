"""Rank the elements of an indenter by increasing initial gap, as far as a contact needs them.

Only elements whose initial gap is below the depth can touch. Light contact on a large map therefore needs few of them,
and sorting all would take longer than the contact itself. The map is read a few times instead, and only the elements
up to a depth are sorted.
"""

import numpy as np

from viscorough.contact.parallel import BLOCK, run_blocks
from viscorough.contact.state import Elements, Units
from viscorough.indenter import Indenter
from viscorough.types import Array, Integers

# Sample size for choosing sort ranges, and the largest number of ranges.
_SAMPLE, _MOST_RANGES = 1000, 8
# If no depth is known: rank all elements below the first count; rank all elements for curves, which will need them all,
# below the second count; rank all elements if the share of the map exceeds the third number.
_LEAST, _LEAST_OF_CURVES, _MOST_SHARE = 1 << 12, BLOCK, 0.5
# If no depth is known, rank about this many elements first, and at most this share. A sample determines the depth:
# number of these elements in the sample, and largest size of the sample.
_FIRST, _FIRST_SHARE, _OF_SAMPLE, _LARGEST_SAMPLE = 1 << 12, 0.25, 64, 1 << 14
# If only elements of the largest height are ranked, rank next up to this depth over the largest initial gap.
_SMALLEST_DEPTH = 1e-3


class Ranking:
    """Ranks the elements of an indenter from the highest one on.

    units : Units in which initial gaps are expressed
    highest : the largest height
    is_flat : whether all elements are of this height
    """

    def __init__(self, indenter: Indenter, threads: int = 1) -> None:
        self._heights, self._threads, self._aspect = indenter.heights, threads, indenter.aspect
        self.highest, lowest = np.fmax.reduce(self._heights, axis=None), np.fmin.reduce(self._heights, axis=None)
        span = float(np.subtract(self.highest, lowest, dtype=float))
        self.is_flat = span == 0
        self.units = Units(span or indenter.element_side, indenter.element_side)
        inside = np.isfinite(self._heights)
        self._count, (rows, columns) = int(np.count_nonzero(inside)), self._heights.shape
        self._origin, self._shape = (0, 0), (rows, columns)
        if self._count < inside.size:
            bounds = [np.flatnonzero(inside.any(axis=axis))[[0, -1]] for axis in (1, 0)]
            self._origin = int(bounds[0][0]), int(bounds[1][0])
            rows, columns = (int(last - first) + 1 for first, last in bounds)
            self._shape = rows, columns

    def first(self, depth: float, whole: bool = False) -> Elements:
        """Return the Elements up to a reduced depth; for an infinite depth all of a small map and none of a large map.

        whole : True if all will be needed
        """
        nothing = np.empty(0, np.int32)
        fixed = self._origin, self._shape, self._aspect
        elements = Elements(nothing, nothing, np.empty(0), *fixed, unranked=self._count, ranked_depth=-1.0)
        if self._count <= _LEAST_OF_CURVES if whole else self._count < _LEAST and np.isinf(depth):
            return self.up_to(elements, np.inf)
        return self.up_to(elements, depth) if np.isfinite(depth) else elements

    def small_depth(self) -> float:
        """Return the reduced depth that contains about _FIRST elements, which are ranked quickly."""
        (rows, columns), share = self._heights.shape, min(_FIRST / self._count, _FIRST_SHARE)
        # Sample the map evenly by a quasi-random sequence (R2, Roberts 2018).
        places = np.arange(min(_OF_SAMPLE / share, _LARGEST_SAMPLE))
        row, column = (places * 0.7548776662466927 % 1 * rows, places * 0.5698402909980532 % 1 * columns)
        sample = self._heights[row.astype(int), column.astype(int)]
        gap = np.subtract(self.highest, sample[np.isfinite(sample)], dtype=float) / self.units.length
        rank = int(share * gap.size)
        return float(np.partition(gap, rank)[rank]) if gap.size else np.inf

    def up_to(self, elements: Elements, depth: float) -> Elements:
        """Return the Elements with all initial gaps up to a reduced depth, or a larger depth, ranked."""
        if depth <= elements.ranked_depth:
            return elements
        while True:
            place, gap = self._between(elements.ranked_depth, depth)
            ranked = elements.initial_gap.size + gap.size
            if ranked > _MOST_SHARE * self._count and ranked < self._count:
                place, gap = self._between(elements.ranked_depth, depth := np.inf)
                ranked = self._count
            # The first elements of all, of the same height, have no depth: those beyond them tell it.
            if ranked == self._count or max(gap.max(initial=0), elements.initial_gap.max(initial=0)) > 0:
                break
            depth = max(4 * depth, _SMALLEST_DEPTH)
        added = self._in_order(place, gap)
        before = elements.row, elements.column, elements.initial_gap
        row, column, in_order = (np.concatenate(parts) for parts in zip(before, added, strict=True))
        unranked = self._count - ranked
        longer = Elements(
            row, column, in_order, self._origin, self._shape, self._aspect,
            unranked=unranked, ranked_depth=depth if unranked else np.inf,
        )  # fmt: skip
        longer.__dict__.update({name: value for name, value in elements.__dict__.items() if name == "influence"})
        return longer

    def _between(self, above: float, up_to: float) -> tuple[Integers, Array]:
        """Return places on the map of the elements with reduced initial gaps between two depths, and these gaps."""
        heights, length = self._heights.ravel(), self.units.length

        def find(i: int, j: int) -> tuple[Integers, Array]:
            gap = np.subtract(self.highest, heights[i:j], dtype=float)
            gap /= length
            chosen = np.flatnonzero((gap > above) & (gap <= up_to))
            return i + chosen, gap[chosen]

        places, gaps = zip(*run_blocks(find, heights.size, self._threads), strict=True)
        return np.concatenate(places), np.concatenate(gaps)

    def _in_order(self, place: Integers, gap: Array) -> tuple[Integers, Integers, Array]:
        """Return row, column and initial gap in increasing order of the gaps."""
        order = _increasing_order(gap, self._threads)
        row, column, in_order = (np.empty(gap.size, dtype) for dtype in (np.int32, np.int32, float))

        def arrange(i: int, j: int) -> None:
            row[i:j], column[i:j] = np.divmod(place[order[i:j]], self._heights.shape[1])
            row[i:j] -= self._origin[0]
            column[i:j] -= self._origin[1]
            in_order[i:j] = gap[order[i:j]]

        run_blocks(arrange, gap.size, self._threads)
        return row, column, in_order


def elements_of(indenter: Indenter, threads: int = 1) -> tuple[Elements, Units]:
    """Return all Elements of an indenter, and the Units of their initial gaps."""
    ranking = Ranking(indenter, threads)
    return ranking.first(1.0), ranking.units


def _increasing_order(gap: Array, threads: int) -> Integers:
    """Return indices that sort an array and keep the order of equal values, so that ranks are the same everywhere.

    Sorting is several times as fast if it need not keep this order. Indices of equal values are sorted afterwards.
    """
    order = np.argsort(gap) if threads == 1 or gap.size <= BLOCK else _order_by_ranges(gap, min(threads, _MOST_RANGES))
    is_equal = np.zeros(gap.size, dtype=bool)  # equal to the value before

    def compare(i: int, j: int) -> None:
        in_order = gap[order[max(i - 1, 0) : j]]
        is_equal[max(i, 1) : j] = in_order[1:] == in_order[:-1]

    run_blocks(compare, gap.size, threads)
    if is_equal.any():
        members = np.flatnonzero(is_equal | np.append(is_equal[1:], False))
        # These numbers order the members by groups of equal values, and by their indices within a group.
        group = np.cumsum(~is_equal[members]) * gap.size
        order[members] = np.sort(group + order[members]) - group
    return order


def _order_by_ranges(gap: Array, ranges: int) -> Integers:
    """Return indices that sort an array, in ranges of about equal size on separate threads."""
    inner = np.quantile(gap[:: max(gap.size // _SAMPLE, 1)], np.arange(1, ranges) / ranges)
    limits = [-np.inf, *inner, np.inf]

    def order(i: int, _: int) -> Integers:
        members = np.flatnonzero((gap >= limits[i]) & (gap < limits[i + 1]))
        return members[np.argsort(gap[members])]

    return np.concatenate(run_blocks(order, ranges, ranges, 1))
