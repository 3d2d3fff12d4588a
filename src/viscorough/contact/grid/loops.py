"""Run the kernels over large arrays, block by block on several threads."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

from viscorough.basics.types import Array, Integers, Mask
from viscorough.contact.grid import kernels
from viscorough.contact.parallel import BLOCK, run_blocks
from viscorough.contact.preconditioner.multilevel import REACH
from viscorough.contact.state import GridFields


def field_to_fill(size: int, dtype: DTypeLike, inner: slice) -> NDArray[Any]:
    """Return a flat field for a loop to fill on its threads, except for the rows of its border, which are zero.

    inner : slice of the field without these rows
    """
    field = np.empty(size, dtype)
    field[: inner.start] = field[inner.stop :] = 0
    return field


def joined(parts: Sequence[Integers]) -> Integers:
    """Join arrays of all blocks, one after the other."""
    return parts[0] if len(parts) == 1 else np.concatenate(parts)


class GridLoops:
    """Loops over the fields of a grid and its contact sets on so many `threads`."""

    def __init__(self, threads: int) -> None:
        self.threads = threads

    def each(self, kernel: Callable[..., Any], fixed: Sequence[Any], *arrays: Any) -> list[Any]:
        """Return results of kernel(*fixed, *blocks) for the blocks of arrays of one length, in order."""
        return self.over(arrays[0], lambda i, j: kernel(*fixed, *(array[i:j] for array in arrays)))

    # Over the places of a set.

    def inner_product(self, left: Array, right: Array, slots: Integers) -> float:
        """Return Σ left·right over the set."""
        return sum(self.each(kernels.inner_product, (left, right), slots))

    def total(self, field: Array, places: Integers) -> float:
        """Return the sum of a field over the set."""
        return sum(self.each(kernels.total, (field,), places))

    def largest_gap(self, gap_change: Array, initial_gap: Array, gap: Array, places: Integers) -> float:
        """Return the largest |e| on the set, and store e in the flat field `gap`."""
        return max(self.each(kernels.gap_on_set, (gap_change, initial_gap, gap), places))

    # Over the elements by rank, or over flat fields if these have the same places.

    def new_places(self, after: GridFields, before: GridFields) -> tuple[Integers, Integers]:
        """Return places of elements in contact in one GridFields but not in another, on the grids of both.

        Elements without a place on the earlier grid have the place 0 there, which is outside the grid.
        """
        if after.initial_gap is before.initial_gap:
            places = self.difference(after.inside, before.inside)
            return places, places

        def new(i: int, j: int) -> Integers:
            is_new = after.inside[after.place[i:j]]
            place = before.place[i:j]  # shorter if fewer elements were ranked
            is_new[: place.size] &= ~before.inside[place]
            return i + np.flatnonzero(is_new)

        ranks = joined(self.over(after.place, new))
        return after.place[ranks], np.append(before.place, 0)[np.minimum(ranks, before.place.size)]

    # Over flat fields.

    def contact_places(self, inside: Mask, width: int, stride: int) -> tuple[Integers, Integers]:
        """Return places in contact, and their indices in the load array, as uint32, or int64 for large arrays.

        Loops are faster with unsigned indices: a negative index would count from the end of an array.
        """
        whole_number = np.uint32 if inside.size // width * max(width, stride) < 2**32 else np.int64

        def in_block(i: int, j: int) -> tuple[Integers, Integers]:
            places: Integers = np.flatnonzero(inside[i:j]).astype(whole_number)
            places += i
            row: Integers = places // width
            return places, (row - REACH) * stride + (places - row * width - REACH)

        places, slots = zip(*self.over(inside, in_block), strict=True)
        return joined(places), joined(slots)

    def difference(self, inside: Mask, other: Mask) -> Integers:
        """Return places of a set that are not in another set."""
        return joined(self.over(inside, lambda i, j: i + np.flatnonzero(inside[i:j] > other[i:j])))

    def largest_overlap(self, gap_change: Array, initial_gap: Array) -> float:
        """Return the largest −e of a flat field, or 0."""
        return -min(0.0, *self.over(gap_change, lambda i, j: float(np.add(gap_change[i:j], initial_gap[i:j]).min())))

    def lowest(self, field: Array) -> float:
        """Return the lowest value of a field."""
        return min(self.over(field, lambda i, j: field[i:j].min()))

    def fill(self, field: Array, value: float) -> None:
        """Set a field to a value everywhere, in place."""
        self.over(field, lambda i, j: field[i:j].fill(value))

    def shifted(self, field: Array, shift: float, out: Array) -> None:
        """Store a field minus a number; both fields are in rows and columns."""
        rows, columns = field.shape
        number = out.dtype.type(shift)
        run_blocks(lambda i, j: np.subtract(field[i:j], number, out=out[i:j]), rows, self.threads, -(-BLOCK // columns))

    def update_gap(self, length: float | np.floating[Any], deflection: Array, gap: Array) -> None:
        """Add α K d to e − g, or to e_q, everywhere, in place."""
        rows, columns = deflection.shape
        width = gap.size // (rows + 2 * REACH)

        def update(i: int, j: int) -> None:
            kernels.update_gap(length, deflection[i:j], gap[i * width :])

        run_blocks(update, rows, self.threads, -(-BLOCK // columns))

    def over(self, array: NDArray[Any], function: Callable[[int, int], Any]) -> list[Any]:
        """Return results of function(start, stop) for the blocks of an array, in order."""
        return run_blocks(function, array.size, self.threads)
