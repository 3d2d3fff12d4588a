"""Estimate the memory that the contact of an indenter needs, before the memory is allocated."""

import numpy as np

from viscorough.basics import memory
from viscorough.basics.types import Array
from viscorough.contact.border import BORDER
from viscorough.contact.halfspace.operator import convolution_lengths
from viscorough.contact.parallel import BLOCK
from viscorough.contact.preconditioner import BYTES_PER_PLACE
from viscorough.contact.state import Elements

# Number of bytes per element for its rank, position and initial gap, and for temporary arrays.
_PER_ELEMENT = 60
# Number of bytes per point of a map of heights, for temporary arrays that exist while the elements are found.
_PER_HEIGHT = 10
# Number of flat fields in memory for the contacts of a loading path: four contacts with four fields each.
_CONTACT_FIELDS = 16
# Number of flat fields in memory for the contacts of a loading path if the tolerance is so small that gaps need double
# precision: six contacts with four fields each, since more contacts are then solved ahead.
_CONTACT_FIELDS_IF_EXACT = 24
# Number of flat fields in memory in addition to the fields of contacts: those of the grid solver, and temporary fields.
_OTHER_FIELDS = 4
# Number of bytes per entry of a flat field for other arrays: contact sets and the preconditioner.
_PER_PLACE = 12 + BYTES_PER_PLACE
# Number of bytes per element for the linear problems of complete contact: vectors of the iteration, and two indices.
_PER_JOINED_ELEMENT = 104
# Number of bytes per entry of a flat field for the linear problems of complete contact: contact set, residual and
# preconditioner.
_PER_JOINED_PLACE = 25 + BYTES_PER_PLACE
# Number of double-precision arrays as large as the spectrum of the influence coefficients: the spectrum, and a second
# array while the operator is set up.
_SPECTRA = 2
# Each thread needs two blocks of columns for convolutions (module column_fft). This is the number of array entries in a
# row of the first block and a row of the second block together.
_NUMBERS_PER_ROW = 2 * 152
# Number of columns in a block of columns (module column_fft).
_COLUMNS_PER_BLOCK = 64
# Number of bytes that are needed for a map of any size: for tables, and for the dense matrices of contacts of up to
# hundreds of elements.
_CONSTANT = 6e6


def require_for_contact(heights: Array, *, exact: bool, threads: int = 1) -> None:
    """Raise MemoryError unless the contact of a map of heights fits into memory.

    The message of the error names the bytes needed and the bytes available.

    heights : map of heights, nan outside the indenter
    exact : True if gaps are also computed in double precision
    threads : number of threads; each has its own buffers

    The estimate is proportional to the number of points of the grid, which is the rectangle around all elements with a
    border of a few points, because the arrays of the contact have this size. For an indenter that is a narrow strip,
    the grid has several times as many points as the indenter has elements. The estimate is up to twice as large as the
    memory that is used (tests/viscorough/basics/test_memory.py).
    """
    inside = np.isfinite(heights)
    rows, columns = (int(np.ptp(np.flatnonzero(inside.any(axis=axis)))) + 1 for axis in (1, 0))
    needed = _PER_HEIGHT * heights.size + _PER_ELEMENT * np.count_nonzero(inside)
    needed += _grid_bytes(rows, columns, exact=exact, threads=threads)
    memory.require(needed, f"contact of a map of {heights.shape} heights")


def require_for_box(heights: Array, box: tuple[int, ...], *, exact: bool, threads: int = 1) -> None:
    """Raise MemoryError unless the contact in a box of the grid fits into memory.

    The arrays of the elements are not counted, since they exist already.

    heights : map of heights; the message of the error states its shape
    box : (first row, first column, rows, columns)
    exact, threads : see `require_for_contact`
    """
    memory.require(_grid_bytes(*box[2:], exact=exact, threads=threads), f"contact of a map of {heights.shape} heights")


def require_for_complete_contact(elements: Elements, threads: int = 1) -> None:
    """Raise MemoryError unless the linear problems of complete contact fit into the available memory."""
    rows, columns = elements.shape
    flat = (rows + 2 * BORDER) * (columns + 2 * BORDER)
    needed = _PER_JOINED_ELEMENT * elements.count + _PER_JOINED_PLACE * flat + _CONSTANT
    needed += _operator_bytes(rows, columns, (8,), threads)
    memory.require(needed, f"complete contact of a map of {elements.shape} heights")


def _grid_bytes(rows: int, columns: int, *, exact: bool, threads: int) -> float:
    """Return the number of bytes of a grid solver, including its operators and the contacts on its grid."""
    flat = (int(rows) + 2 * BORDER) * (int(columns) + 2 * BORDER)
    fields = 8 * (_OTHER_FIELDS + _CONTACT_FIELDS_IF_EXACT) if exact else 4 * (_OTHER_FIELDS + _CONTACT_FIELDS)
    operators = _operator_bytes(rows, columns, (4, 8) if exact else (4,), threads)
    return 8 * int(rows) * int(columns) + operators + (fields + _PER_PLACE) * flat + _CONSTANT


def _operator_bytes(rows: int, columns: int, bytes_of_numbers: tuple[int, ...], threads: int) -> float:
    """Return the number of bytes of the half-space operators on a grid, and of the spectrum that they share.

    bytes_of_numbers : for each operator, the bytes of a number in its precision: 4 for single, 8 for double precision
    """
    rows, columns = sorted((int(rows), int(columns)))
    along_columns, along_rows = convolution_lengths(rows, columns)
    spectrum = (along_columns // 2 + 1) * (along_rows // 2 + 1)
    operators = 8 * _SPECTRA * spectrum
    buffers = min(threads, -(-along_rows // (2 * _COLUMNS_PER_BLOCK))) * _NUMBERS_PER_ROW * along_columns
    if rows * columns > BLOCK:
        # Each thread has two blocks of rows. The number of rows in a block is a multiple of 16.
        buffers += min(threads, -(-rows // 16)) * 2 * along_rows * (BLOCK // columns + 16)
    for bytes_of_number in bytes_of_numbers:
        # An operator stores the load, the deflection, the transformed rows, and the spectrum in blocks of columns. Load
        # and deflection have rows of this width, because they are padded on small grids only.
        width = along_rows if rows * columns <= BLOCK else columns
        operators += bytes_of_number * (rows * (2 * width + along_rows) + 1.2 * spectrum + buffers)
    return operators
