"""Warn if the border of a scan carries much of the force.

A map is a body of its own: beyond its border nothing touches. If a scan is cut from a larger surface and its border is
in contact, it acts as a punch with free edges, whose border carries more pressure than the surface would carry there.
"""

import warnings

import numpy as np

from viscorough.basics.errors import AccuracyWarning
from viscorough.basics.summaries import with_unit
from viscorough.contact.prescribed_depth import ContactSolver
from viscorough.contact.state import ContactState

# A warning is given if the elements of the border carry more than this share of the force.
_SHARE_OF_FORCE = 0.05
# No warning is given from this contact fraction on, where all parts of a map touch.
_LARGEST_FRACTION = 0.3
# Contacts of fewer elements are not judged, since a single high point may lie on the border by chance.
_FEWEST_ELEMENTS = 10


class FreeEdges:
    """Search for the depth from which the border of a map carries much of the force.

    The border is the first and the last row and column of the rectangle around all elements. Only maps that were read
    from a file are searched, and only if most points of the border are elements: a round body is no part of a scan.

    solver : ContactSolver of the contacts
    """

    def __init__(self, solver: ContactSolver) -> None:
        self._solver, self._is_scan = solver, solver.indenter.from_file and _has_border(solver)
        self._depth: float | None = None  # smallest depth from which on the border has carried much of the force

    def see(self, contact: ContactState) -> None:
        """Look at a contact; contacts must be given in the order of increasing depth."""
        elements = self._solver.elements
        is_judged = _FEWEST_ELEMENTS <= contact.count < _LARGEST_FRACTION * elements.count
        if not self._is_scan or not is_judged:
            return
        loads, (rows, columns) = contact.member_loads(), elements.shape
        row, column = elements.row[loads.members], elements.column[loads.members]
        on_border = (row == 0) | (row == rows - 1) | (column == 0) | (column == columns - 1)
        if loads.pressure[on_border].sum() <= _SHARE_OF_FORCE * loads.pressure.sum():
            self._depth = None
        elif self._depth is None:
            self._depth = contact.depth

    def warn(self) -> None:
        """Give an AccuracyWarning if the border of the map carries much of the force."""
        if self._depth is not None:
            depth = with_unit(self._depth, self._solver.indenter.length_unit)
            text = f"from the depth u, {depth}, on, the border of the map carries more than "
            text += f"{100 * _SHARE_OF_FORCE:g} % of the force although less than {100 * _LARGEST_FRACTION:g} % of its "
            text += "elements touch; the results hold for a body that ends there, not for a scan of a larger surface"
            warnings.warn(text, AccuracyWarning, stacklevel=3)


def _has_border(solver: ContactSolver) -> bool:
    """Return True if most points on the border of the rectangle around all elements are elements."""
    (top, left), (rows, columns) = solver.elements.grid.origin, solver.elements.shape
    heights = solver.indenter.heights[top : top + rows, left : left + columns]
    border = heights[0], heights[-1], heights[1:-1, 0], heights[1:-1, -1]
    return bool(np.isfinite(np.concatenate(border)).mean() > 0.5)
