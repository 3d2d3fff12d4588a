"""Base class of linear viscoelastic media."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from viscorough.basics.arrays import real_numbers
from viscorough.basics.types import Array
from viscorough.media.free_form import Fit, fit_creep
from viscorough.media.spectra import (
    RelaxationSpectrum,
    RetardationSpectrum,
    Spectrum,
    relaxation_spectrum,
    solvable,
    spectrum_of,
)

if TYPE_CHECKING:
    from viscorough.media.load import Load

# A medium may be represented by springs and dashpots if its compliance J differs from theirs by at most this share.
LARGEST_MISFIT = 0.1
# A medium that is known only by J is sampled from this share of the shortest interval between two turns of a load (see
# Load.shortest_interval) up to its duration, with so many times per decade.
_SHORTEST, _PER_DECADE = 1e-6, 20


def checked_times(time: ArrayLike) -> Array:
    """Return times as an array of floats, without labels. Raises ValueError unless they are real numbers from 0 on."""
    times = real_numbers("time", time)
    if (times < 0).any():
        raise ValueError(f"time: {times.min():g}; allowed: 0 or more")
    return times


class Medium(ABC):
    """Base class of linear viscoelastic media, with creep compliance J(t) and relaxation modulus ψ(t) in shear.

    Every subclass defines J. A motion is computed for springs and dashpots with the same J, see `spectrum`. If the
    medium consists of springs and dashpots, a subclass also defines its two spectra, which are needed for direct
    integration in time.

    Examples
    --------
    >>> import numpy as np
    >>> import viscorough
    >>> from viscorough.media.medium import Medium
    >>> class Logarithmic(Medium):
    ...     def creep_compliance(self, time):
    ...         return 1.0 + np.log1p(time)
    >>> load = viscorough.Load([0.0, 1.0, 10.0], force=[0.0, 1.0, 1.0])
    >>> spectrum, misfit = Logarithmic().spectrum(load)
    >>> misfit < 1e-6
    True
    """

    @property
    def relaxation(self) -> RelaxationSpectrum | None:
        """Return the spectrum of ψ, or None if the medium does not consist of springs and dashpots."""
        return None

    @property
    def retardation(self) -> RetardationSpectrum | None:
        """Return the spectrum of J, or None if the medium does not consist of springs and dashpots."""
        return None

    @property
    def first_time(self) -> float:
        """Return the time from which on J is known, which is 0 except for a measured J."""
        return 0.0

    @property
    def last_time(self) -> float:
        """Return the time up to which J is known, which is infinite except for a measured J."""
        return np.inf

    @abstractmethod
    def creep_compliance(self, time: ArrayLike) -> Array:
        """Return the creep compliance J at times t ≥ 0, an array of any shape. At time 0 this is J(0+)."""

    def spectrum(self, load: Load) -> tuple[Spectrum, float]:
        """Return springs and dashpots that have the J of the medium, and their largest relative misfit of J.

        The misfit is the largest over the times of the load. Unless a subclass knows its spectrum, J is sampled at
        these times, and a spring, a dashpot and Kelvin-Voigt elements are fitted to it (viscorough.media.free_form).

        Raises ValueError if the misfit exceeds 10 %, as for a J that no medium that relaxes has.
        """
        last = load.duration or 1.0
        times, fit = self._fitted(_SHORTEST * min(load.shortest_interval, last), last)
        errors = np.abs(fit.errors)
        check_misfit(type(self).__name__, times, errors)
        retardation = solvable(fit.retardation, times[1], times[-1])
        return spectrum_of(relaxation_spectrum(retardation), retardation), float(errors.max())

    def creep_rate(self, time: ArrayLike) -> Array:
        """Return dJ/dt at times t ≥ 0, an array of any shape; infinite at time 0 in a springpot.

        Unless a subclass knows dJ/dt, this is the rate of springs and dashpots that are fitted to J at these times.
        """
        time = checked_times(time)
        positive = time[time > 0]
        if not positive.size:
            return np.full(time.shape, np.nan)
        _, fit = self._fitted(_SHORTEST * float(positive.min()), float(positive.max()))
        rates = fit.strengths / fit.times * np.exp(-np.divide.outer(time, fit.times))
        return fit.second + rates.sum(axis=-1)

    def relaxation_modulus(self, time: ArrayLike) -> Array:
        """Return the relaxation modulus ψ at times t ≥ 0, an array of any shape.

        The pulse η δ(t) of a parallel dashpot is left out. Raises ValueError if ψ is not known.
        """
        raise self._without_modulus()

    def relaxation_integral(self, start: ArrayLike, end: ArrayLike) -> Array:
        """Return the integral ∫ψ dt from `start` ≥ 0 to `end` ≥ `start`.

        The pulse η δ(t) of a parallel dashpot is left out. Raises ValueError if ψ is not known.
        """
        raise self._without_modulus()

    def _fitted(self, first: float, last: float) -> tuple[Array, Fit]:
        """Return time 0 and times of equal ratios between two times, and the fit to J at these times."""
        count = int(np.ceil(_PER_DECADE * np.log10(last / first))) + 1
        times = np.append(0.0, np.geomspace(first, last, count))
        return times, fit_creep(times, np.asarray(self.creep_compliance(times), dtype=float))

    def _without_modulus(self) -> ValueError:
        return ValueError(f"medium: {type(self).__name__}; allowed: media whose relaxation is known, as a Prony series")


def check_misfit(name: str, times: Array, errors: Array) -> None:
    """Raise ValueError if springs and dashpots miss the compliance or the modulus of a medium.

    name : name of the medium, for the message
    times, errors : times of the samples, and the sizes of the relative errors of the fit at these times
    """
    if (largest := errors.max()) > LARGEST_MISFIT:
        raise ValueError(
            f"{name}: springs and dashpots miss it by {100 * largest:.2g} % at time {times[errors.argmax()]:g}; "
            f"allowed: {100 * LARGEST_MISFIT:g} %, as for every medium that relaxes: J and its rate are then smooth, "
            "and the rate falls"
        )
