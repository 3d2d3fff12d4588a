"""Base class of linear viscoelastic media."""

from __future__ import annotations

from abc import ABC, abstractmethod

import numpy as np
from numpy.typing import ArrayLike

from viscorough.basics.arrays import real_numbers
from viscorough.basics.types import Array
from viscorough.media.spectra import RelaxationSpectrum, RetardationSpectrum


def checked_times(time: ArrayLike) -> Array:
    """Return times as an array of floats, without labels. Raises ValueError unless they are real numbers from 0 on."""
    times = real_numbers("time", time)
    if (times < 0).any():
        raise ValueError(f"time: {times.min():g}; allowed: 0 or more")
    return times


class Medium(ABC):
    """Base class of linear viscoelastic media, with creep compliance J(t) and relaxation modulus ψ(t) in shear.

    Every subclass defines J, the rate dJ/dt and the integral ∫J dt. If ψ is known, a subclass also defines ψ, which is
    needed for prescribed depths and for pressures. If the medium consists of springs and dashpots, a subclass also
    defines the two spectra, which are needed for direct integration in time.

    Examples
    --------
    >>> import viscorough
    >>> from viscorough.media.medium import Medium
    >>> isinstance(viscorough.Maxwell(2.0, 5.0), Medium)
    True
    >>> viscorough.Springpot(1.0, 0.5).relaxation is None  # no springs and dashpots
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
    def last_time(self) -> float:
        """Return the time up to which J is known, which is infinite except for a measured J."""
        return np.inf

    @abstractmethod
    def creep_compliance(self, time: ArrayLike) -> Array:
        """Return the creep compliance J at times t ≥ 0, an array of any shape. At time 0 this is J(0+)."""

    @abstractmethod
    def creep_rate(self, time: ArrayLike, *, left: bool = False) -> Array:
        """Return dJ/dt at times t ≥ 0, an array of any shape.

        left : if J has a kink at a time, return the rate before the kink instead of the rate after it
        """

    @abstractmethod
    def creep_integral(self, start: ArrayLike, end: ArrayLike) -> Array:
        """Return the integral ∫J dt from `start` ≥ 0 to `end` ≥ `start`."""

    def creep_increment(self, start: ArrayLike, end: ArrayLike) -> Array:
        """Return the rise of the creep compliance J(end) − J(start), for 0 ≤ start ≤ end."""
        return self.creep_compliance(end) - self.creep_compliance(start)

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

    def _without_modulus(self) -> ValueError:
        return ValueError(f"medium: {type(self).__name__}; allowed: media whose relaxation is known, as a Prony series")
