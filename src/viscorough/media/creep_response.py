"""Creep response Φ(t) = ∫ J(t − s) dF(s) of a medium to a force F that is linear between samples and may have steps.

J is the creep compliance. In a medium of springs and dashpots, Φ is a sum of one state per retardation time. The states
are advanced exactly from sample to sample.
"""

import numpy as np

from viscorough.basics.compilation import njit
from viscorough.basics.types import Array
from viscorough.media.load import Load
from viscorough.media.medium import Medium
from viscorough.media.spectra import Spectrum

# Let x be the length of an interval divided by a retardation time. For x below _SERIES_BELOW, (exp(−x) − 1 + x)/x is
# computed by a series with _SERIES_TERMS terms, because the formula would lose digits.
_SERIES_BELOW, _SERIES_TERMS = 0.3, 12
# For x above _KEPT_FROM, `decay` computes exp(−x) first, otherwise 1 − exp(−x). Below _SLIGHT, six terms of a series
# suffice. From x = _VANISHED on, exp(−x) is less than the smallest floating-point number.
_KEPT_FROM, _SLIGHT, _VANISHED = 1.0, 0.01, 746.0


def creep_response(spectrum: Spectrum, load: Load) -> Array:
    """Return the creep response Φ of a medium to a force history at its samples, shape (samples,).

    The force is 0 before the first sample. The state of each retardation time θ is the delayed response y, with
    θ y' + y = F. It is exact for a force that is linear in time, and is computed without cancellation.
    """
    times = 1 / spectrum.decays
    delayed = _delayed_responses(np.diff(load.time), load.values, times)
    return spectrum.instantaneous * load.values + spectrum.fluidity * load.integral + delayed @ (spectrum.flows * times)


def constant_creep(force: float, medium: Medium, times: Array) -> tuple[Array, Array]:
    """Return the creep response Φ and dΦ/dt at `times` under a force that is constant from time 0 on."""
    with np.errstate(over="ignore"):
        return force * medium.creep_compliance(times), force * medium.creep_rate(times)


@njit(inner=True)
def decay(x):
    """Return exp(−x), and (1 − exp(−x))/x, the mean of exp(−s) for s from 0 to x.

    Exponential functions take most of the time of a motion. So only one of the two results is computed with such a
    function. The other result follows from it, without a loss of digits.
    """
    if x > _KEPT_FROM:
        kept = exponential(x)
        return kept, (1 - kept) / x
    if x < _SLIGHT:
        mean = 1 - x * (1 / 2 - x * (1 / 6 - x * (1 / 24 - x * (1 / 120 - x * (1 / 720)))))
    else:
        mean = -np.expm1(-x) / x
    return 1 - x * mean, mean


@njit(inner=True)
def exponential(x):
    """Return exp(−x). Where the result is 0, the exponential function of the C library takes three times as long."""
    return np.exp(-x) if x < _VANISHED else 0.0


@njit
def _delayed_responses(lengths, force, retardation_times):
    """Return, for each retardation time θ, the state y with θ y' + y = F at every sample, shape (samples, times).

    F is 0 before the first sample.

    lengths : lengths of the intervals between samples; F jumps at an interval of length 0
    force : F at the samples
    """
    samples, count = force.size, retardation_times.size
    delayed = np.zeros((samples, count))
    for k in range(samples - 1):
        for j in range(count):
            x = lengths[k] / retardation_times[j]
            kept, mean = decay(x)
            # For the forces F0 and F1 at the start and end of the interval, y becomes exp(−x) y + a F0 + b F1, with
            # b = 1 − (1 − exp(−x))/x and a = 1 − exp(−x) − b.
            if x < _SERIES_BELOW:
                b = 0.0
                for n in range(_SERIES_TERMS, 0, -1):
                    b = (1 - b) * x / (n + 1)
                a = x * mean - b
            else:
                a, b = mean - kept, 1 - mean
            delayed[k + 1, j] = delayed[k, j] * kept + a * force[k] + b * force[k + 1]
    return delayed
