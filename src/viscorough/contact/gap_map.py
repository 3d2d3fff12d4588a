"""Compute the map of the gap between indenter and deformed surface, from a solved contact."""

import numpy as np

from viscorough.basics.errors import ConvergenceError
from viscorough.basics.types import Array
from viscorough.contact.halfspace import tiles
from viscorough.contact.halfspace.operator import Convolution, spectrum_of_grid
from viscorough.contact.parallel import BLOCK, run_blocks
from viscorough.contact.prescribed_depth import ContactSolver
from viscorough.contact.state import ContactState, DenseContact, GridContact


def gap_map(solver: ContactSolver, contact: ContactState) -> Array:
    """Return the gap e between indenter and deformed surface [length], in the shape of the heights.

    The gap is nan outside the indenter. A contact that was solved on the grid of a box (a part of the map) contains the
    gap of all elements in this box. At all other elements, the gap follows from the deflection due to all loads.

    solver : ContactSolver that has solved the contact

    Raises ConvergenceError if the overlap of an element, relative to the depth, exceeds the residual of the contact by
    more than the tolerance.
    """
    gap = _undeformed_gap(solver, contact.depth)
    (top, left), (rows, columns) = solver.elements.grid.origin, solver.elements.shape
    on_grid = slice(top, top + rows), slice(left, left + columns)
    part, box, box_gap = gap[on_grid], (0, 0, 0, 0), None
    grid = solver.grid_of(contact)
    # Take the gap in the box from the contact, unless the grid is restricted: on a restricted grid, the gap is known
    # only in tiles (parts of the box) with elements that can touch.
    if grid and isinstance(contact, GridContact) and not grid.is_restricted:
        box, box_gap = grid.box, grid.in_box(contact.fields.gap_change.values)
    if box != (0, 0, rows, columns):
        _add_deflection(solver, contact, part, box)
    if box_gap is not None:
        row, column, rows, columns = box
        in_box = slice(row, row + rows), slice(column, column + columns)
        np.subtract(solver.ranking.highest, solver.indenter.heights[on_grid][in_box], out=part[in_box], dtype=float)
        part[in_box] += box_gap * solver.units.length
    overlap = -np.fmin.reduce(gap, axis=None) / contact.depth
    if overlap > contact.residual + solver.tolerance:
        raise ConvergenceError(
            f"contact at depth {contact.depth:g}: elements overlap the surface by {overlap:.1e} of the depth"
        )
    return gap


def _undeformed_gap(solver: ContactSolver, depth: float) -> Array:
    """Return the gap g − u between all elements and the undeformed surface [length], in the shape of the heights."""
    heights, highest = solver.indenter.heights, solver.ranking.highest
    gap = np.empty(heights.shape)

    def subtract(i: int, j: int) -> None:
        np.subtract(highest, heights[i:j], out=gap[i:j], dtype=float)
        gap[i:j] -= depth

    run_blocks(subtract, len(gap), solver.threads, -(-BLOCK // heights.shape[1]))
    return gap


def _add_deflection(solver: ContactSolver, contact: ContactState, gap: Array, box: tuple[int, ...]) -> None:
    """Add the deflection of the surface due to the loads of a contact to the gap, in place.

    gap : gap on the grid of the elements, shape (rows, columns) [length]
    box : (first row, first column, rows, columns) of a box whose gap need not be updated
    """
    loads, elements, options = contact.member_loads(), solver.elements, solver.options
    rows, columns = elements.shape
    place, load = (elements.row[loads.members], elements.column[loads.members]), loads.pressure
    suits = tiles.is_suitable(elements.shape, elements.aspect, solver.tolerance, options)
    if options.padding and suits:
        loaded = tiles.tiles_with(*place, elements.shape)
        restricted = tiles.TiledHalfspace(rows, columns, loaded, aspect=elements.aspect, threads=solver.threads)
        restricted.load[place] = load * solver.units.length
        restricted.add_to(gap, tiles.tiles_beyond(box, elements.shape))
    else:
        # Compute the deflection in double precision for small tolerances, and for contacts that were solved with a
        # dense matrix, which are exact within rounding.
        is_exact = isinstance(contact, DenseContact) or solver.tolerance < options.exact_gap_below
        precision, threads = np.float64 if is_exact else np.float32, solver.threads
        spectrum = spectrum_of_grid(rows, columns, aspect=elements.aspect, padding=options.padding, threads=threads)
        halfspace = Convolution((rows, columns), spectrum, precision, threads=threads, once=True)
        halfspace.load[place] = load * solver.units.length
        gap += halfspace.apply()[:, :columns]
    if isinstance(contact, DenseContact):
        gap[place] = 0.0
