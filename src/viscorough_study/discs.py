"""One self-affine disc of an ensemble, and its rms heights by every convention."""

import numpy as np

from viscorough.indenter import Indenter
from viscorough.surfaces import self_affine_disc


def ensemble_disc(elements, surface, seed):
    """The Indenter of one realization, and {convention: its rms height} [m].

    elements : across the disc; surface : arguments of self_affine_disc with rms, diameter and rms_over

    The nominal rms height is met over the disc or over the periodic square that the disc is cut from, as rms_over says.
    The conventions are the rms height over the disc, that over the square, and the height of the highest peak above the
    mean of the disc.
    """
    shape = surface | {"elements_across": elements, "rms_over": "square"}
    heights = self_affine_disc(**shape, seed=seed).heights[None]
    # Sums over the last two axes are those of a stack of discs, to the last digit.
    over_disc, mean = np.nanstd(heights, axis=(1, 2)).item(), np.nanmean(heights, axis=(1, 2)).item()
    factor = surface["rms"] / (over_disc if surface["rms_over"] == "disc" else surface["rms"])
    peak = np.nanmax(heights).item() - mean
    rms = {"disc": over_disc * factor, "peak": peak * factor, "square": surface["rms"] * factor}
    return Indenter(heights[0] * factor, surface["diameter"] / elements, length_unit="m"), rms
