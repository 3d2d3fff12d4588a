"""Discs of an ensemble: one realization with its rms heights by every convention, its curve, and the flat disc."""

from functools import cache

import numpy as np

from viscorough.contact.loading_path import indent
from viscorough.contact.one_contact import contact_at
from viscorough.indenter import Indenter
from viscorough.surfaces import cut_disc, square_of_disc


def ensemble_disc(elements, surface, seed):
    """The Indenter of one realization, and {convention: its rms height} [m].

    elements : across the disc; surface : arguments of self_affine_disc with rms, diameter and rms_over

    The nominal rms height is met over the disc or over the periodic square that the disc is cut from, as rms_over says.
    The conventions are the rms height over the disc, that over the square, the height of the highest peak above the
    mean of the disc, and the rms height of the ensemble: with it as unit, realizations are not normalised one by one
    but have the same spectrum, and it is the rms height that this spectrum gives the square on average.
    """
    shape = {name: value for name, value in surface.items() if name not in ("rms", "diameter", "rms_over")}
    square = square_of_disc(**shape, elements_across=elements, normalised=False, seed=seed)
    disc = cut_disc(square, elements)
    peak = np.nanmax(disc) - np.nanmean(disc)
    rms = {"disc": np.nanstd(disc), "square": np.sqrt(np.mean(square**2)), "peak": peak, "ensemble": 1.0}
    factor = surface["rms"] / rms[surface["rms_over"]]
    indenter = Indenter(disc * factor, surface["diameter"] / elements, length_unit="m")
    return indenter, {name: float(height * factor) for name, height in rms.items()}


def end_of_curve(number, indentation):
    """X at which the curve of a realization ends: `until_x` for the first `whole_curves`, `short_until_x` for others.

    number : of the realization, which is known before the surface is: longer curves are a random sample of the ensemble
    """
    return indentation["until_x" if number < indentation["whole_curves"] else "short_until_x"]


def indent_disc(disc, rms, diameter, *, tolerance, until_fraction, until_x):
    """LoadingCurve of a disc until a contact fraction or X = F/(4GhL) is reached.

    disc, rms : of `ensemble_disc`; diameter : L [m]; h in X is the larger of the rms heights over disc and square
    """
    until_force = 4 * max(rms["disc"], rms["square"]) * diameter * until_x
    return indent(disc, tolerance=tolerance, until_fraction=until_fraction, until_force=until_force)


@cache
def punch_stiffness(elements_across):
    """κ_c of a flat disc of so many elements across, by boundary elements; 1 for ever finer grids."""
    disc = cut_disc(np.zeros((elements_across, elements_across)), elements_across)
    return contact_at(Indenter(disc, 1 / elements_across), depth=1.0, tolerance=1e-5).stiffness / 4
