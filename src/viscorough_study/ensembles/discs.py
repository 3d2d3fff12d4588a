"""Discs of an ensemble: one realization with its rms heights by every convention."""

import numpy as np

from viscorough.surfaces.indenter import Indenter
from viscorough.surfaces.self_affine import cut_disc, square_of_disc

_LENGTHS = ("rms", "diameter", "rms_over", "length_unit")  # settings of a surface that do not change its shape


def ensemble_disc(elements, surface, seed):
    """Return the Indenter of one realization, and {convention: its rms height} in its unit of length.

    elements : number across the disc; surface : arguments of self_affine_disc with rms, diameter, rms_over and
        length_unit

    The nominal rms height is taken over the disc, or over the periodic square that the disc is cut from, by rms_over.
    The conventions are the rms height over the disc, over the square, and over the ensemble. The last is the mean over
    squares with the common spectrum; with it, realizations are not normalised individually.
    """
    shape = {name: value for name, value in surface.items() if name not in _LENGTHS}
    square = square_of_disc(**shape, elements_across=elements, normalised=False, seed=seed)
    disc = cut_disc(square, elements)
    rms = {"disc": np.nanstd(disc), "square": np.sqrt(np.mean(square**2)), "ensemble": 1.0}
    factor = surface["rms"] / rms[surface["rms_over"]]
    indenter = Indenter(disc * factor, surface["diameter"] / elements, length_unit=surface["length_unit"])
    return indenter, {name: float(height * factor) for name, height in rms.items()}
