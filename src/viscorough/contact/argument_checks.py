"""Check the arguments that the computations of loading curves and of single contacts have in common."""

import sys
import warnings

from viscorough.basics.arrays import real_number, whole_number
from viscorough.basics.errors import AccuracyWarning
from viscorough.basics.summaries import with_unit
from viscorough.contact.options import SolverOptions
from viscorough.surfaces.indenter import Indenter, check_indenter

# Largest number of threads that a user can request.
_MOST_THREADS = 1024


def check_solvable(name: str, indenter: Indenter, tolerance: float, threads: int, options: SolverOptions) -> float:
    """Check the arguments of a function of the contact solver, and return the tolerance as a float.

    name : name of the function; error messages start with it

    Raises ValueError if the indenter is not a map, its spacing is too small, or tolerance or threads are out of range.
    Raises TypeError if the options are not SolverOptions.
    """
    check_indenter(name, indenter, 2)
    if indenter.spacing * indenter.row_spacing < sys.float_info.min:
        text = f"a spacing of {indenter.spacing:g} is too small to represent areas"
        raise ValueError(f"{text}; a smaller unit of length is needed")
    tolerance = real_number("argument tolerance", tolerance)
    if not 1e-12 <= tolerance <= 0.1:
        raise ValueError(f"argument tolerance must be between 1e-12 and 0.1, not {tolerance!r}")
    whole_number("argument threads", threads, 1, _MOST_THREADS)
    if not isinstance(options, SolverOptions):
        raise TypeError(f"{name}: options: {type(options).__name__}; viscorough.SolverOptions(...) is needed")
    return tolerance


def warn_beyond_theory(indenter: Indenter, depth: float) -> None:
    """Give an AccuracyWarning if the depth is larger than the longer side of the map.

    No warning is given if the unit of length is unknown. The theory is linear in the heights, so the user may then have
    given the heights in a different unit than the spacing.
    """
    rows, columns = indenter.heights.shape
    extent = max(rows * indenter.row_spacing, columns * indenter.spacing)
    if indenter.length_unit == "m" and depth > extent * (1 + 1e-9):
        reached, width = (with_unit(length, indenter.length_unit) for length in (depth, extent))
        text = f"the depth u, {reached}, is larger than the map is wide, {width}"
        warnings.warn(f"{text}; the theory ends far below: check the units of force and heights", AccuracyWarning, 3)
