"""Mean velocity of an ensemble under the conventions of the figures, as the kinetics and the master curve draw it."""

from dataclasses import dataclass

import numpy as np

from viscorough_study.figures.style import count_text
from viscorough_study.fits.conventions import LENGTH


@dataclass(frozen=True)
class MeanCurve:
    """Mean over the realizations that are defined, arrays of shape (abscissae,).

    x : X; velocity : vt/h, nan where so few realizations are defined that their mean would be biased
    error : two standard errors of ln(vt/h)
    several : whether the mean is drawn and more than one element is in contact, which is beyond region (a)
    """

    x: np.ndarray
    velocity: np.ndarray
    error: np.ndarray
    several: np.ndarray


def mean_curve(ensemble, conventions, fraction_min):
    """MeanCurve of an ensemble dataset.

    conventions : {column of the scaling table: value}
    fraction_min : smallest share of the realizations defined, for a mean to be drawn
    """
    available = ensemble["rms_convention"].values.tolist()  # lines have one, their own
    mean = ensemble.sel(rms_convention=conventions["rms_convention"] if len(available) > 1 else available[0])
    defined = mean["fraction_defined"].values >= fraction_min
    return MeanCurve(
        mean["x"].values / LENGTH[conventions["diameter_convention"]],
        np.where(defined, mean[f"velocity_{conventions['average']}"].values, np.nan),
        2 * mean["velocity_spread"].values / np.sqrt(np.maximum(mean["realizations_defined"].values, 1)),
        defined & (mean["contact_count_median"].values > 1),
    )


def realizations_text(ensembles):
    """Number of realizations behind the means of ensembles, as text; the least is that at the largest X."""
    counts = []
    for ensemble in ensembles:
        until_x = np.broadcast_to(ensemble["until_x"].values, ensemble.sizes["realization"])
        counts += [until_x.size, int((until_x == until_x.max()).sum())]
    return count_text(counts)
