"""Run the kernels of the grid solver over large arrays, block by block on several threads."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

from viscorough.basics.types import Array, Integers, Mask
from viscorough.contact.border import BORDER
from viscorough.contact.grid import kernels
from viscorough.contact.parallel import BLOCK, run_blocks
from viscorough.contact.state import GridFields


def field_to_fill(size: int, dtype: DTypeLike, inner: slice) -> NDArray[Any]:
    """Return a flat field whose border rows at both ends are zero; the other entries are not initialised.

    Fill the other entries in a loop on several threads. These threads then allocate the memory of the field.

    inner : slice of the field that leaves out the border rows at both ends
    """
    field = np.empty(size, dtype)
    field[: inner.start] = field[inner.stop :] = 0
    return field


def joined(parts: Sequence[Integers]) -> Integers:
    """Concatenate the arrays that a loop has returned, one for each block."""
    return parts[0] if len(parts) == 1 else np.concatenate(parts)


class GridLoops:
    """Loops over the fields and the contact sets of a grid, run on `threads` threads.

    A loop divides an array into blocks and calls a kernel for every block. Kernels are called by keyword only, because
    most of their arguments are arrays of the same type and length, and swapped arrays would raise no error.
    """

    def __init__(self, threads: int) -> None:
        self.threads = threads

    # Loops over the elements of a contact set.

    def inner_product(self, left: Array, right: Array, slots: Integers) -> float:
        """Return Σ left·right over a contact set; `slots` are the indices of its elements in both arrays."""
        return sum(self.over(slots, lambda i, j: kernels.inner_product(left=left, right=right, slots=slots[i:j])))

    def total(self, field: Array, places: Integers) -> float:
        """Return the sum of a flat field over the elements at `places`."""
        return sum(self.over(places, lambda i, j: kernels.total(field=field, places=places[i:j])))

    def largest_gap(self, gap_change: Array, initial_gap: Array, gap: Array, places: Integers) -> float:
        """Compute the gap e at `places` and store it in the flat field `gap`; return the largest |e|."""

        def largest(i: int, j: int) -> float:
            return kernels.gap_on_set(gap_change=gap_change, initial_gap=initial_gap, gap=gap, places=places[i:j])

        return max(self.over(places, largest))

    # Comparison of two contacts: a loop over flat fields if both are on the same grid, else over all ranked elements.

    def new_places(self, after: GridFields, before: GridFields) -> tuple[Integers, Integers]:
        """Find the elements that are in contact in `after` but not in `before`, which may be on different grids.

        Returns two arrays of equal length: indices of these elements in the flat fields of `after`, and in the flat
        fields of `before`. An element that does not exist in the fields of `before` gets the index 0 in the second
        array; index 0 belongs to the border of the grid.
        """
        if after.initial_gap is before.initial_gap:
            places = self.difference(after.inside, before.inside)
            return places, places

        def new(i: int, j: int) -> Integers:
            is_new = after.inside[after.place[i:j]]
            place = before.place[i:j]  # shorter than `is_new` if fewer elements are ranked in `before`
            is_new[: place.size] &= ~before.inside[place]
            return i + np.flatnonzero(is_new)

        ranks = joined(self.over(after.place, new))
        return after.place[ranks], np.append(before.place, 0)[np.minimum(ranks, before.place.size)]

    # Loops over flat fields.

    def contact_places(self, inside: Mask, width: int, stride: int) -> tuple[Integers, Integers]:
        """Return the indices of the elements in contact, in flat fields and in the flattened load array.

        The indices are uint32, or int64 for large arrays. Unsigned indices make loops faster, because they need no
        check for negative values, which count from the end of an array.

        inside : True for elements in contact, flat field
        width : length of a row of flat fields
        stride : length of a row of the load array of the half-space operator
        """
        whole_number = np.uint32 if inside.size // width * max(width, stride) < 2**32 else np.int64

        def in_block(i: int, j: int) -> tuple[Integers, Integers]:
            places: Integers = np.flatnonzero(inside[i:j]).astype(whole_number)
            places += i
            row: Integers = places // width
            return places, (row - BORDER) * stride + (places - row * width - BORDER)

        places, slots = zip(*self.over(inside, in_block), strict=True)
        return joined(places), joined(slots)

    def difference(self, inside: Mask, other: Mask) -> Integers:
        """Return the indices in flat fields of the elements that are in contact in `inside` but not in `other`.

        inside, other : True for elements in contact, flat fields
        """
        return joined(self.over(inside, lambda i, j: i + np.flatnonzero(inside[i:j] > other[i:j])))

    def largest_overlap(self, gap_change: Array, initial_gap: Array) -> float:
        """Return the largest overlap −e of indenter and surface, or 0; the gap is e = gap_change + initial_gap."""
        return -min(0.0, *self.over(gap_change, lambda i, j: float(np.add(gap_change[i:j], initial_gap[i:j]).min())))

    def lowest(self, field: Array) -> float:
        """Return the lowest value of a field."""
        return min(self.over(field, lambda i, j: field[i:j].min()))

    def fill(self, field: Array, value: float) -> None:
        """Set all entries of a field to a value, in place."""
        self.over(field, lambda i, j: field[i:j].fill(value))

    def shifted(self, field: Array, shift: float, out: Array) -> None:
        """Store field − shift in `out`; both arrays are in rows and columns."""
        rows, columns = field.shape
        number = out.dtype.type(shift)
        run_blocks(lambda i, j: np.subtract(field[i:j], number, out=out[i:j]), rows, self.threads, -(-BLOCK // columns))

    def update_gap(self, length: float | np.floating[Any], deflection: Array, gap: Array) -> None:
        """Add length · deflection to the flat field `gap` at all elements of the grid, in place.

        length : length of a step along the search direction d
        deflection : K d, in rows and columns
        gap : gap change e − g, or tangent gap e_q = de/du, flat field
        """
        rows, columns = deflection.shape
        width = gap.size // (rows + 2 * BORDER)

        def update(i: int, j: int) -> None:
            kernels.update_gap(length=length, deflection=deflection[i:j], gap=gap[i * width :])

        run_blocks(update, rows, self.threads, -(-BLOCK // columns))

    def over(self, array: NDArray[Any], function: Callable[[int, int], Any]) -> list[Any]:
        """Call function(start, stop) for every block of an array; return all results, in the order of the blocks."""
        return run_blocks(function, array.size, self.threads)
