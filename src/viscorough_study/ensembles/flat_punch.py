"""Compute the stiffness of a flat disc on a grid; a rough disc in complete contact has this stiffness."""

from functools import cache

import numpy as np

from viscorough.contact.one_contact import contact_at
from viscorough.reference import COMPLETE_CONTACT_STIFFNESS
from viscorough.surfaces.indenter import Indenter
from viscorough.surfaces.self_affine import cut_disc
from viscorough_study.ensembles.pool import elements_across, ensembles

# Compute the punch on grids up to this number of elements across. Beyond, 1 − κ_c is proportional to 1/n to 3 %, so the
# extrapolated κ_c is wrong by less than 2e-5. The computation would need 7 GB on 4097 elements across.
_LARGEST = 1025


@cache
def punch_stiffness(elements_across):
    """Compute κ_c, the reduced stiffness k/(4GL) of a flat disc on a grid, by boundary elements.

    κ_c tends to 1 as the number n of elements across the disc increases. On fine grids it is extrapolated: 1 − κ_c is
    proportional to 1/n.
    """
    if elements_across > _LARGEST:
        return 1 - (1 - punch_stiffness(_LARGEST)) * _LARGEST / elements_across
    disc = cut_disc(np.zeros((elements_across, elements_across)), elements_across)
    return contact_at(Indenter(disc, 1 / elements_across), depth=1.0, tolerance=1e-5).stiffness / 4


def ensembles_on_grids(pool, source):
    """Yield (H, number, κ_c, ensemble) for every Hurst exponent and grid of a pool.

    number : elements across discs, or points of lines
    κ_c : stiffness κ of the flat punch on this grid; 1 for lines
    source : "lines" if the pool contains lines, "discs" if it contains discs, whose h is the rms height of each disc
    """
    convention = "line" if source == "lines" else "disc"
    for (hurst, elements), ensemble in ensembles(pool, "hurst", "elements", rms_convention=convention).items():
        across = elements_across(elements)
        grid = (elements, COMPLETE_CONTACT_STIFFNESS) if source == "lines" else (across, punch_stiffness(across))
        yield hurst, *grid, ensemble
