"""Generate the rough discs of an ensemble, and compute the rms height of each disc by several definitions."""

import numpy as np

from viscorough.surfaces.indenter import Indenter
from viscorough.surfaces.self_affine import cut_disc, square_of_disc
from viscorough_study.ensembles.realization import Realization

_LENGTHS = ("rms", "diameter", "rms_over", "length_unit")  # settings that scale a surface, but keep its shape


def ensemble_discs(name, spawn_key, surface, elements, numbers, *, seed):
    """Yield (Realization, Indenter) of the discs of an ensemble, with lengths in the unit of each disc.

    name, spawn_key, surface, elements, numbers : description of the ensemble (run.samples.batch_ensembles)
    seed : root seed of the seeds of all discs
    """
    for number in range(*numbers):
        disc, rms = ensemble_disc(elements, surface, np.random.SeedSequence(seed, spawn_key=(*spawn_key, number)))
        yield Realization(name, number, surface["hurst"], surface["diameter"], disc.spacing, rms), disc


def ensemble_disc(elements, surface, seed):
    """Generate one disc of an ensemble; return it as an Indenter, and its rms heights as {rms convention: height}.

    The rms heights are in the unit of length of the indenter.

    elements : number of elements across the disc
    surface : arguments of self_affine_disc, with rms, diameter, rms_over and length_unit
    seed : int or SeedSequence

    The disc is cut from a periodic square. The heights are scaled so that the rms height over the disc, or over the
    square (`rms_over`), equals `rms`. The result contains the rms heights by three definitions: over the disc, over the
    square, and over the ensemble. The rms height over the ensemble is the root mean square over all squares with the
    same spectrum. By this definition, realizations are not normalised one by one.
    """
    shape = {name: value for name, value in surface.items() if name not in _LENGTHS}
    square = square_of_disc(**shape, elements_across=elements, normalised=False, seed=seed)
    disc = cut_disc(square, elements)
    rms = {"disc": np.nanstd(disc), "square": np.sqrt(np.mean(square**2)), "ensemble": 1.0}
    factor = surface["rms"] / rms[surface["rms_over"]]
    indenter = Indenter(disc * factor, surface["diameter"] / elements, length_unit=surface["length_unit"])
    return indenter, {name: float(height * factor) for name, height in rms.items()}
