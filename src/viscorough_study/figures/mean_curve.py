"""Mean velocity of an ensemble under the conventions of the figures, as the kinetics and the master curve draw it."""

from dataclasses import dataclass

import numpy as np

FRACTION_MIN = 0.95  # of the realizations, for a mean to be drawn; as in viscorough_study.power_law.find_region


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


def mean_curve(ensemble, conventions):
    """MeanCurve of an ensemble dataset; conventions : {column of the scaling table: value}."""
    available = ensemble["rms_convention"].values.tolist()  # lines have one, their own
    mean = ensemble.sel(rms_convention=conventions["rms_convention"] if len(available) > 1 else available[0])
    defined = mean["fraction_defined"].values >= FRACTION_MIN
    return MeanCurve(
        mean["x"].values / length_over_diameter(conventions),
        np.where(defined, mean[f"velocity_{conventions['average']}"].values, np.nan),
        2 * mean["velocity_spread"].values / np.sqrt(np.maximum(mean["realizations_defined"].values, 1)),
        defined & (mean["contact_count_median"].values > 1),
    )


def length_over_diameter(conventions):
    """L over the diameter of the indenter."""
    return 0.5 if conventions["diameter_convention"] == "radius" else 1.0
