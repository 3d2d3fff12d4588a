"""Make the table of contacts of measured surfaces with an elastic half-space, with estimated grid errors.

The table has one row for each force of each scan. A scan that could not be evaluated has one row with the error and
without numbers.
"""

import logging
import warnings
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from viscorough import AccuracyWarning, contact_at, indent
from viscorough.basics.elasticity import young_over_shear
from viscorough.basics.errors import REPORTED, message
from viscorough.io.contact_files import NAMES_WITH_MODULUS
from viscorough.io.contact_tables import MEANINGS, MEASURES, result_units, table_of_contacts
from viscorough.io.curves import ABOUT_GRID
from viscorough_study.ensembles.measured import measured_indenter

_TEXTS = {
    "error": "why the scan has no numbers; empty if it has",
    "warnings": "doubts about the numbers; empty if there are none",
}
_COLUMNS = {NAMES_WITH_MODULUS.get(name, name): measure for name, measure in MEASURES.items()}
CONTACTS = {
    "scan": ("name of the scan", None),
    "group": ("group of scans", None),
    "file": ("file of heights", None),
    **{
        name: (MEANINGS[name], "1" if measure is None else result_units("m", 1.0)[measure].name)
        for name, measure in _COLUMNS.items()
    },
    **{name: (text, None) for name, text in _TEXTS.items()},
}
# Settings for reading the file of a scan.
_READING = ("spacing", "unit", "preparation")
# For grid errors, contacts at these multiples of the force of each load are computed as well. A grid error is a mean
# over half a decade of forces, since the difference of two curves at a single force can be zero by chance.
_FORCES_BELOW = (10**-0.5, 10**-0.25)
# A contact for grid errors is left out if its force differs from the force of another contact by less than this share:
# the results of both contacts would differ by less than the tolerance.
_LEAST_DIFFERENCE = 0.02


class ScanRows(NamedTuple):
    """Rows of one scan, one {column: number} for each force, or the error instead, and the warnings."""

    rows: list[dict[str, float | int]]
    error: str
    warnings: str


def measured_contacts(scans):
    """Return the table of contacts of measured surfaces with an elastic half-space; its columns are `CONTACTS`.

    For each scan the table has the numbers that the command `viscorough contact` gives for the same modulus and forces,
    and their estimated grid errors. A scan that cannot be evaluated has one row, with the reason in the column `error`.

    scans : mappings with name, group, file, spacing, unit, preparation, forces [N], young_modulus [Pa] and
        poisson_ratio. A scan without forces, or with the modulus None, has no rows
    """
    lines = []
    for scan in scans:
        if scan["young_modulus"] is None or not scan["forces"]:
            continue
        result = _evaluated_scan(scan)
        if result.error:
            logging.warning("%s: %s", scan["file"], result.error)
        labels = {"scan": scan["name"], "group": scan["group"], "file": str(scan["file"])}
        labels |= {"error": result.error, "warnings": result.warnings}
        lines += [labels | row for row in result.rows or [{}]]
    return pd.DataFrame(lines, columns=list(CONTACTS))


def _evaluated_scan(scan):
    """Read a scan, and solve its elastic contact under all its forces; return its ScanRows."""
    rows, error = [], ""
    modulus = scan["young_modulus"] / young_over_shear(scan["poisson_ratio"])
    with warnings.catch_warnings(record=True) as caught:
        try:
            indenter = measured_indenter(scan["file"], **{name: scan[name] for name in _READING})
            rows = rows_with_grid_errors(indenter, sorted(scan["forces"]), modulus)
        except REPORTED as fault:
            error = _without_path(message(fault), scan["file"])
        # Any other error is a fault of viscorough. It is reported, too, so that the evaluation of other scans goes on.
        except Exception as fault:
            error = f"{type(fault).__name__}: {_without_path(message(fault), scan['file'])}"
    texts = dict.fromkeys(_without_path(str(warning.message), scan["file"]) for warning in caught)
    return ScanRows(rows, error, "; ".join(texts))


def _without_path(text, path):
    """Return the text of an error or warning on one line, without the path at its start."""
    return " ".join(text.split()).removeprefix(f"{path}: ")


def rows_with_grid_errors(indenter, forces, shear_modulus) -> list[dict[str, Any]]:
    """Compute the contact at each force. Return one row {column: number} of a table for each force.

    forces : increasing forces [N]; shear_modulus : G [Pa]
    """
    contacts = contact_at(indenter, force=np.divide(forces, shear_modulus))
    levels = _with_forces_below(np.array([contact.force for contact in contacts]))
    # The computation of the contacts has already given the same warnings.
    with warnings.catch_warnings(action="ignore", category=AccuracyWarning):
        curve = indent(indenter, forces=levels, estimate_grid_error=True)
    places = [int(np.argmin(np.abs(curve.force - contact.force))) for contact in contacts]
    errors = {name: getattr(curve, name)[places] for name in ABOUT_GRID}
    table = table_of_contacts(contacts, shear_modulus, errors)
    columns = [values.tolist() for values, _ in table.values()]
    return [dict(zip(table, row, strict=True)) for row in zip(*columns, strict=True)]


def _with_forces_below(forces):
    """Return the given forces and the lower forces for grid errors (_FORCES_BELOW), in increasing order."""
    levels = list(forces)
    for candidate in np.multiply.outer(forces, _FORCES_BELOW).ravel():
        if all(abs(candidate - level) > _LEAST_DIFFERENCE * level for level in levels):
            levels.append(candidate)
    return np.sort(levels)
