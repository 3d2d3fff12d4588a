"""Loading curves of the surfaces of a batch by boundary elements, and the stiffness of a flat disc."""

from functools import cache

import numpy as np

from viscorough.contact.loading_path import indent
from viscorough.contact.one_contact import contact_at
from viscorough.indenter import Indenter
from viscorough.reference import COMPLETE_CONTACT_STIFFNESS
from viscorough.surfaces import cut_disc
from viscorough_study.ensembles.pool import elements_across


def end_of_curve(number, indentation):
    """X at which the curve of a realization ends: `until_x` for the first `whole_curves`, `short_until_x` for others.

    number : of the realization; it is independent of the surface, so longer curves are a random sample of the ensemble
    """
    return indentation["until_x" if number < indentation["whole_curves"] else "short_until_x"]


def indent_surface(indenter, rms, diameter, *, tolerance, until_fraction, until_x):
    """LoadingCurve of a surface up to a contact fraction or X = F/(4GhL).

    rms : {convention: rms height}; diameter : L. In X, h is the rms height over the disc or, if the disc is cut from a
    square, the larger of those over disc and square.
    """
    until_force = 4 * max(rms[name] for name in ("disc", "square") if name in rms) * diameter * until_x
    return indent(indenter, tolerance=tolerance, until_fraction=until_fraction, until_force=until_force)


@cache
def punch_stiffness(elements_across):
    """κ_c of a flat disc of `elements_across` elements, by boundary elements; tends to 1 on finer grids."""
    disc = cut_disc(np.zeros((elements_across, elements_across)), elements_across)
    return contact_at(Indenter(disc, 1 / elements_across), depth=1.0, tolerance=1e-5).stiffness / 4


def grid_and_punch(source, elements):
    """Elements across discs of this number of elements, or points of lines, and κ_c of the flat punch on this grid."""
    if source == "lines":
        return elements, COMPLETE_CONTACT_STIFFNESS
    across = elements_across(elements)
    return across, punch_stiffness(across)
