"""Estimate the memory for the contact of an indenter, before any of it is allocated."""

import numpy as np

from viscorough.basics import memory
from viscorough.basics.types import Array
from viscorough.contact.halfspace.operator import convolution_lengths
from viscorough.contact.parallel import BLOCK
from viscorough.contact.preconditioner.multilevel import REACH
from viscorough.contact.state import Elements

# Bytes of the rank, place, gap and temporary arrays of an element.
_PER_ELEMENT = 60
# Bytes of an entry of a map while its elements are found.
_PER_HEIGHT = 10
# Number of flat fields of the contacts that a loading path holds: four contacts with four fields each.
_CONTACT_FIELDS = 16
# The same number at small tolerances: the path then holds six contacts, since more are solved ahead.
_CONTACT_FIELDS_IF_EXACT = 24
# Number of flat fields of the grid solver and of temporary arrays.
_OTHER_FIELDS = 4
# Bytes of other arrays per place of the grid: contact sets, and the preconditioner with its fourteen entries.
_PER_PLACE = 12 + 25
# Bytes per element of the linear problems of complete contact: vectors of the iteration, and two indices.
_PER_JOINED_ELEMENT = 104
# Bytes per place of the grid of these problems: contact set, residual and preconditioner.
_PER_JOINED_PLACE = 50
# Double-precision arrays of the size of the spectrum of the half-space: kept, and during the set-up of the operator.
_SPECTRA = 2
# Numbers in a row of the two blocks of columns that each thread convolves.
_NUMBERS_PER_ROW = 2 * 152
# Columns of such a block.
_COLUMNS_PER_BLOCK = 64
# For any size: tables, and dense solutions of hundreds of elements.
_CONSTANT = 6e6


def require_for_contact(heights: Array, *, exact: bool, threads: int = 1) -> None:
    """Raise MemoryError, which names the bytes needed and available, unless the contact of a map fits into memory.

    heights : a map, nan outside the indenter
    exact : True if gaps are also computed in double precision
    threads : number of threads; each has its own buffers

    The estimate follows the allocation: it is proportional to the number of points of the padded grid around all
    elements, including its border, which for narrow strips are several times as many as the elements. It exceeds the
    memory taken by up to a factor of two (tests/viscorough/basics/test_memory.py).
    """
    inside = np.isfinite(heights)
    rows, columns = (int(np.ptp(np.flatnonzero(inside.any(axis=axis)))) + 1 for axis in (1, 0))
    needed = _PER_HEIGHT * heights.size + _PER_ELEMENT * np.count_nonzero(inside)
    needed += _grid_bytes(rows, columns, exact=exact, threads=threads)
    memory.require(needed, f"contact of a map of {heights.shape} heights")


def require_for_box(heights: Array, box: tuple[int, ...], *, exact: bool, threads: int = 1) -> None:
    """Raise MemoryError unless the contact in a box fits into memory; the elements exist already.

    box : (first row, first column, rows, columns)
    """
    memory.require(_grid_bytes(*box[2:], exact=exact, threads=threads), f"contact of a map of {heights.shape} heights")


def require_for_complete_contact(elements: Elements, threads: int = 1) -> None:
    """Raise MemoryError unless the linear problems of complete contact fit into the memory that is left."""
    rows, columns = elements.shape
    flat = (rows + 2 * REACH) * (columns + 2 * REACH)
    needed = _PER_JOINED_ELEMENT * elements.count + _PER_JOINED_PLACE * flat + _CONSTANT
    needed += _operator_bytes(rows, columns, (8,), threads)
    memory.require(needed, f"complete contact of a map of {elements.shape} heights")


def _grid_bytes(rows: int, columns: int, *, exact: bool, threads: int) -> float:
    """Return bytes of a grid solver, its operators, and the contacts on its grid."""
    flat = (int(rows) + 2 * REACH) * (int(columns) + 2 * REACH)
    fields = 8 * (_OTHER_FIELDS + _CONTACT_FIELDS_IF_EXACT) if exact else 4 * (_OTHER_FIELDS + _CONTACT_FIELDS)
    operators = _operator_bytes(rows, columns, (4, 8) if exact else (4,), threads)
    return 8 * int(rows) * int(columns) + operators + (fields + _PER_PLACE) * flat + _CONSTANT


def _operator_bytes(rows: int, columns: int, bytes_of_numbers: tuple[int, ...], threads: int) -> float:
    """Return bytes of half-space operators on a grid, one for each precision, and of their common spectrum."""
    rows, columns = sorted((int(rows), int(columns)))
    along_columns, along_rows = convolution_lengths(rows, columns)
    spectrum = (along_columns // 2 + 1) * (along_rows // 2 + 1)
    operators = 8 * _SPECTRA * spectrum
    buffers = min(threads, -(-along_rows // (2 * _COLUMNS_PER_BLOCK))) * _NUMBERS_PER_ROW * along_columns
    if rows * columns > BLOCK:
        # Two blocks of rows; their number of rows is a multiple of 16.
        buffers += min(threads, -(-rows // 16)) * 2 * along_rows * (BLOCK // columns + 16)
    for bytes_of_number in bytes_of_numbers:
        # Load and deflection (padded on small grids only) and transformed rows; the spectrum by blocks of columns.
        width = along_rows if rows * columns <= BLOCK else columns
        operators += bytes_of_number * (rows * (2 * width + along_rows) + 1.2 * spectrum + buffers)
    return operators
