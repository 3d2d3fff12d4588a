"""The flat disc that a rough one becomes in complete contact: its stiffness on a grid."""

from functools import cache

import numpy as np

from viscorough.contact.one_contact import contact_at
from viscorough.indenter import Indenter
from viscorough.reference import COMPLETE_CONTACT_STIFFNESS
from viscorough.surfaces import cut_disc
from viscorough_study.ensembles.pool import elements_across


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
