"""Compute the rows of a table of contacts (io.load_tables) that belong to one file of heights, or report an error."""

import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from viscorough.basics.errors import REPORTED, AccuracyWarning, message
from viscorough.basics.types import Array, Progress
from viscorough.contact.loading_path import indent
from viscorough.contact.one_contact import contact_at
from viscorough.contact.sampling import part_of
from viscorough.io.curves import ABOUT_GRID
from viscorough.io.load_tables import LoadRows, Rows, rows_of_contacts
from viscorough.results.contact_maps import Contact
from viscorough.results.loading_curve import LoadingCurve
from viscorough.surfaces.indenter import Indenter

# If grid errors are computed as well, the computation of the contacts counts as this share of the progress.
_SHARE_OF_CONTACTS = 0.3
# For grid errors, contacts at these multiples of the force of each load are computed as well. A grid error is a mean
# over half a decade of forces, since the difference of two curves at a single force can be zero by chance.
_FORCES_BELOW = (10**-0.5, 10**-0.25)
# A contact for grid errors is left out if its force differs from the force of another contact by less than this share:
# the results of both contacts would differ by less than the tolerance.
_LEAST_DIFFERENCE = 0.02


def rows_at_loads(
    indenter: Indenter,
    *,
    force: Any = None,
    depth: Any = None,
    shear_modulus: float | None = None,
    grid_error: bool = False,
    progress: Progress | None = None,
    **how: Any,
) -> Rows:
    """Compute the contact at each load. Return (rows of a table, {column: unit}), with one row for each load.

    Raises the errors of `contact_at`.

    force, depth : increasing forces [N, or length² without a modulus] or depths [length]; give one of the two
    shear_modulus : G [Pa], or in consistent units if the unit of length is not known
    grid_error : True for the columns grid_error, force_grid_error and area_change
    progress : function called with the finished share of the computation
    how : further arguments of `contact_at` and `indent`: tolerance and threads
    """
    loads: dict[str, Any] = {"force": force, "depth": depth, "shear_modulus": shear_modulus}
    if not grid_error:
        return rows_of_contacts(contact_at(indenter, **loads, **how, progress=progress))
    progress = progress or (lambda done: None)
    contacts: list[Contact] = contact_at(indenter, **loads, **how, progress=part_of(progress, 0.0, _SHARE_OF_CONTACTS))
    curve = _curve_with_grid_errors(indenter, contacts, progress=part_of(progress, _SHARE_OF_CONTACTS, 1.0), **how)
    places = [int(np.argmin(np.abs(curve.force - contact.force))) for contact in contacts]
    return rows_of_contacts(contacts, {name: getattr(curve, name)[places] for name in ABOUT_GRID})


def _curve_with_grid_errors(indenter: Indenter, contacts: list[Contact], **how: Any) -> LoadingCurve:
    """Return the loading curve with grid errors, at the forces of the contacts and at lower forces (_FORCES_BELOW)."""
    forces = _with_forces_below(np.array([contact.force for contact in contacts]))
    # The computation of the contacts has already given the same warnings.
    with warnings.catch_warnings(action="ignore", category=AccuracyWarning):
        return indent(indenter, forces=forces, estimate_grid_error=True, **how)


def _with_forces_below(forces: Array) -> Array:
    """Return the given forces and the lower forces for grid errors (_FORCES_BELOW), in increasing order."""
    levels = list(forces)
    for candidate in np.multiply.outer(forces, _FORCES_BELOW).ravel():
        if all(abs(candidate - level) > _LEAST_DIFFERENCE * level for level in levels):
            levels.append(candidate)
    return np.sort(levels)


def evaluated(
    scan: LoadRows, path: Path, read: Callable[[], Indenter], evaluate: Callable[[Indenter], Rows]
) -> LoadRows:
    """Read and evaluate a file of heights. Return `scan` with the rows and warnings, or with the error that occurred.

    scan : LoadRows with the name and the digest of the file
    path : path of the file. It is removed from messages, since the table has a column with the name of the file
    read : function that reads the file and returns the indenter
    evaluate : function of the indenter that returns the rows and {column: unit}
    """
    with warnings.catch_warnings(record=True) as caught:
        try:
            rows, units = evaluate(read())
            scan = scan._replace(rows=rows, units=units)
        except REPORTED as error:
            scan = scan._replace(error=_without_path(message(error), path))
        # Any other error is a fault of viscorough. It is reported, too, so that the evaluation of other files goes on.
        except Exception as error:
            scan = scan._replace(error=f"{type(error).__name__}: {_without_path(message(error), path)}")
    texts = dict.fromkeys(_without_path(str(warning.message), path) for warning in caught)
    return scan._replace(warnings="; ".join(texts))


def _without_path(text: str, path: Path) -> str:
    """Return the text of an error or warning on one line, without the path at its start."""
    return " ".join(text.split()).removeprefix(f"{path}: ")
