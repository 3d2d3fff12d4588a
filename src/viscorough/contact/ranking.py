"""Rank the elements of an indenter: sort them by increasing initial gap, as far as a contact needs them.

Only elements whose initial gap is below the depth can touch. Light contact on a large map therefore needs few elements,
and sorting all elements would take longer than solving the contact. Instead, the map is searched for the elements up to
a depth, and only these elements are sorted. If larger depths are needed, the map is searched again.
"""

from dataclasses import replace

import numpy as np

from viscorough.basics.types import Array, Integers
from viscorough.contact.options import DEFAULT, SolverOptions
from viscorough.contact.parallel import BLOCK, run_blocks
from viscorough.contact.state import ElementGrid, Elements, Units
from viscorough.surfaces.indenter import Indenter

# To sort gaps on several threads, they are divided into ranges of about equal size. The limits of the ranges are
# estimated from a sample of about this number of gaps.
_SAMPLE = 1000
# To sort gaps on several threads, they are divided into at most this number of ranges.
_MOST_RANGES = 8
# The first ranking (sorting by height) contains at most this share of all elements.
_FIRST_SHARE = 0.25
# The first ranking contains all elements up to a depth, which is estimated from a sample of the map. The sample is so
# large that about this number of its elements lie within the depth.
_FIRST_IN_SAMPLE = 64
# Largest number of points in the sample of the map from which the depth of the first ranking is estimated.
_LARGEST_SAMPLE = 1 << 14
# If all elements sorted so far have the largest height, elements are ranked (sorted by height) at least up to this
# reduced depth.
_SMALLEST_DEPTH = 1e-3


class Ranking:
    """Elements of an indenter, ranked (sorted by height) from the highest element on, as far as they are needed.

    Arguments:

    indenter : Indenter with two-dimensional heights
    threads : number of threads
    options : SolverOptions with the numbers of elements to rank first
    largest_depth : all elements up to this depth are ranked at the start [length]. If the depth is infinite, all
        elements of a small map are ranked at the start, and no elements of a large map
    whole : True if all elements will be needed

    Attributes:

    elements : Elements object with all elements ranked so far. Only the methods `rank_highest`, `rank_up_to`, `require`
        and `free_influence` replace this object. The ContactSolver and the ForceSearch call these methods
    highest : largest height
    is_flat : True if all elements have the same height
    """

    def __init__(
        self,
        indenter: Indenter,
        threads: int = 1,
        options: SolverOptions = DEFAULT,
        *,
        largest_depth: float = np.inf,
        whole: bool = False,
    ) -> None:
        self._heights, self._threads, self._options = indenter.heights, threads, options
        self.highest, lowest = np.fmax.reduce(self._heights, axis=None), np.fmin.reduce(self._heights, axis=None)
        span = float(np.subtract(self.highest, lowest, dtype=float))
        self.is_flat = span == 0
        units = Units(span or indenter.element_side, indenter.element_side)
        inside = np.isfinite(self._heights)
        count, (rows, columns), origin = int(np.count_nonzero(inside)), self._heights.shape, (0, 0)
        if count < inside.size:
            bounds = [np.flatnonzero(inside.any(axis=axis))[[0, -1]] for axis in (1, 0)]
            origin = int(bounds[0][0]), int(bounds[1][0])
            rows, columns = (int(last - first) + 1 for first, last in bounds)
        grid, nothing = ElementGrid(origin, (rows, columns), indenter.aspect), np.empty(0, np.int32)
        self.elements = Elements(nothing, nothing, np.empty(0), grid, units, unranked=count, ranked_depth=-1.0)
        is_small = count <= options.rank_all_for_curves if whole else count < options.rank_first
        if is_small and (whole or np.isinf(largest_depth)):
            self.rank_up_to(np.inf)
        elif np.isfinite(largest_depth):
            self.rank_up_to(largest_depth / units.length)

    def rank_highest(self) -> None:
        """Rank about the `rank_first` highest elements (see SolverOptions), unless elements are ranked already.

        The necessary depth is estimated from a sample of the map, which takes little time.
        """
        if self.elements.initial_gap.size:
            return
        (rows, columns), share = self._heights.shape, min(self._options.rank_first / self.elements.count, _FIRST_SHARE)
        # Choose places that cover the map evenly by a quasi-random sequence (R2, Roberts 2018).
        places = np.arange(min(_FIRST_IN_SAMPLE / share, _LARGEST_SAMPLE))
        row, column = (places * 0.7548776662466927 % 1 * rows, places * 0.5698402909980532 % 1 * columns)
        sample = self._heights[row.astype(int), column.astype(int)]
        gap = np.subtract(self.highest, sample[np.isfinite(sample)], dtype=float) / self.elements.units.length
        rank = int(share * gap.size)
        self.rank_up_to(float(np.partition(gap, rank)[rank]) if gap.size else np.inf)

    def rank_up_to(self, depth: float) -> None:
        """Rank (sort by height) all elements whose initial gap is at most `depth`, and possibly more elements.

        depth : reduced depth, in units of the largest initial gap
        """
        elements = self.elements
        if depth <= elements.ranked_depth:
            return
        while True:
            place, gap = self._between(elements.ranked_depth, depth)
            ranked = elements.initial_gap.size + gap.size
            if ranked > self._options.rank_all_share * elements.count and ranked < elements.count:
                place, gap = self._between(elements.ranked_depth, depth := np.inf)
                ranked = elements.count
            # Increase the depth until an element that is lower than the highest elements is ranked, too.
            if ranked == elements.count or max(gap.max(initial=0), elements.initial_gap.max(initial=0)) > 0:
                break
            depth = max(4 * depth, _SMALLEST_DEPTH)
        added = self._in_order(place, gap)
        before = elements.row, elements.column, elements.initial_gap
        row, column, in_order = (np.concatenate(parts) for parts in zip(before, added, strict=True))
        unranked = elements.count - ranked
        ranked_depth = depth if unranked else np.inf
        self.elements = Elements(
            row, column, in_order, elements.grid, elements.units, unranked=unranked, ranked_depth=ranked_depth
        )

    def require(self, depth: float, *, up_to: float) -> None:
        """Rank all elements up to the depth `up_to`, unless all elements up to `depth` are ranked already.

        Both depths are reduced, in units of the largest initial gap.
        """
        if depth > self.elements.ranked_depth:
            self.rank_up_to(up_to)

    def free_influence(self) -> None:
        """Free the memory of the influence coefficients; they are computed again if they are needed later."""
        self.elements = replace(self.elements, grid=replace(self.elements.grid))

    def _between(self, above: float, up_to: float) -> tuple[Integers, Array]:
        """Return the elements whose reduced initial gap lies between two depths, as indices and gaps.

        The indices refer to the flattened map.
        """
        heights, length = self._heights.ravel(), self.elements.units.length

        def find(i: int, j: int) -> tuple[Integers, Array]:
            gap = np.subtract(self.highest, heights[i:j], dtype=float)
            gap /= length
            chosen = np.flatnonzero((gap > above) & (gap <= up_to))
            return i + chosen, gap[chosen]

        places, gaps = zip(*run_blocks(find, heights.size, self._threads), strict=True)
        return np.concatenate(places), np.concatenate(gaps)

    def _in_order(self, place: Integers, gap: Array) -> tuple[Integers, Integers, Array]:
        """Return rows, columns and initial gaps of elements in the order of increasing gap.

        place, gap : indices of the elements in the flattened map, and their initial gaps
        """
        order = _increasing_order(gap, self._threads)
        row, column, in_order = (np.empty(gap.size, dtype) for dtype in (np.int32, np.int32, float))
        top, left = self.elements.grid.origin

        def arrange(i: int, j: int) -> None:
            row[i:j], column[i:j] = np.divmod(place[order[i:j]], self._heights.shape[1])
            row[i:j] -= top
            column[i:j] -= left
            in_order[i:j] = gap[order[i:j]]

        run_blocks(arrange, gap.size, self._threads)
        return row, column, in_order


def all_elements(indenter: Indenter, threads: int = 1) -> Elements:
    """Return the Elements object of an indenter with all elements ranked (sorted by height)."""
    ranking = Ranking(indenter, threads)
    ranking.rank_up_to(1.0)
    return ranking.elements


def _increasing_order(gap: Array, threads: int) -> Integers:
    """Return indices that sort an array; indices of equal values are in increasing order.

    The ranks of elements with equal gaps are therefore the same on every machine and for any number of threads. First
    the array is sorted by a fast method that may exchange equal values. The indices of equal values are sorted
    afterwards. This is several times as fast as a method that keeps the order of equal values.
    """
    order = np.argsort(gap) if threads == 1 or gap.size <= BLOCK else _order_by_ranges(gap, min(threads, _MOST_RANGES))
    is_equal = np.zeros(gap.size, dtype=bool)  # True if a value equals the previous value in sorted order

    def compare(i: int, j: int) -> None:
        in_order = gap[order[max(i - 1, 0) : j]]
        is_equal[max(i, 1) : j] = in_order[1:] == in_order[:-1]

    run_blocks(compare, gap.size, threads)
    if is_equal.any():
        members = np.flatnonzero(is_equal | np.append(is_equal[1:], False))
        # Sort the indices within each group of equal values, all groups at once. A multiple of the array size is added
        # to the indices of each group, so that sorting does not mix the groups.
        group = np.cumsum(~is_equal[members]) * gap.size
        order[members] = np.sort(group + order[members]) - group
    return order


def _order_by_ranges(gap: Array, ranges: int) -> Integers:
    """Return indices that sort an array. The values are divided into ranges, which are sorted on separate threads.

    ranges : number of ranges, which contain about equal numbers of values
    """
    inner = np.quantile(gap[:: max(gap.size // _SAMPLE, 1)], np.arange(1, ranges) / ranges)
    limits = [-np.inf, *inner, np.inf]

    def order(i: int, _: int) -> Integers:
        members = np.flatnonzero((gap >= limits[i]) & (gap < limits[i + 1]))
        return members[np.argsort(gap[members])]

    return np.concatenate(run_blocks(order, ranges, ranges, 1))
