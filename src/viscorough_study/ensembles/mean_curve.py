"""Select the mean velocity of an ensemble that figures and page show, by the kind of mean and the definition of h."""

from types import SimpleNamespace

import numpy as np


def mean_curve(ensemble, conventions, fraction_min):
    """Return the mean curve of an ensemble dataset: a namespace of arrays of shape (abscissae,).

    conventions : {"average": kind of mean, "rms_convention": where the rms height h is measured}
    fraction_min : a mean is taken as unbiased if at least this fraction of the realizations has a value

    The namespace has these arrays:
    x : abscissae X
    velocity : mean of vt/h over the realizations that have a value, nan if the mean is biased
    error : two standard errors of ln(vt/h)
    elements : median number of elements in contact
    several : True if the mean is unbiased and several elements are in contact, that is, beyond region (a)
    """
    # For lines, h is measured in only one way, so `rms_convention` has a single value.
    available = ensemble["rms_convention"].values.tolist()
    mean = ensemble.sel(rms_convention=conventions["rms_convention"] if len(available) > 1 else available[0])
    defined = mean["fraction_defined"].values >= fraction_min
    return SimpleNamespace(
        x=mean["x"].values,
        velocity=np.where(defined, mean[f"velocity_{conventions['average']}"].values, np.nan),
        error=2 * mean["velocity_spread"].values / np.sqrt(np.maximum(mean["realizations_defined"].values, 1)),
        elements=mean["contact_count_median"].values,
        several=defined & (mean["contact_count_median"].values > 1),
    )
