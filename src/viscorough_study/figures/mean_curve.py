"""Mean velocity of an ensemble in the conventions of the figures, for the kinetics and the master curve."""

from types import SimpleNamespace

import numpy as np

from viscorough_study.figures.style import count_text


def mean_curve(ensemble, conventions, fraction_min):
    """Return means over the defined realizations of an ensemble dataset, arrays of shape (abscissae,).

    conventions : {column of the scaling table: value}
    fraction_min : smallest fraction of defined realizations for which a mean is drawn

    x : X; velocity : vt/h, nan if too few realizations are defined for an unbiased mean
    error : two standard errors of ln(vt/h)
    several : True if the mean is drawn and several elements are in contact, beyond region (a)
    """
    available = ensemble["rms_convention"].values.tolist()  # lines have a single convention
    mean = ensemble.sel(rms_convention=conventions["rms_convention"] if len(available) > 1 else available[0])
    defined = mean["fraction_defined"].values >= fraction_min
    return SimpleNamespace(
        x=mean["x"].values,
        velocity=np.where(defined, mean[f"velocity_{conventions['average']}"].values, np.nan),
        error=2 * mean["velocity_spread"].values / np.sqrt(np.maximum(mean["realizations_defined"].values, 1)),
        several=defined & (mean["contact_count_median"].values > 1),
    )


def realizations_text(ensembles):
    """Return the number of averaged realizations as text; the smallest number applies at the largest X."""
    counts = []
    for ensemble in ensembles:
        until_x = np.broadcast_to(ensemble["until_x"].values, ensemble.sizes["realization"])
        counts += [until_x.size, int((until_x == until_x.max()).sum())]
    return count_text(counts)
