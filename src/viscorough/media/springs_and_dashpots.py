"""Base class of media that consist of springs and dashpots, with J and ψ from their spectra."""

from abc import abstractmethod
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from viscorough.basics.types import Array
from viscorough.media.load import Load
from viscorough.media.medium import Medium, checked_times
from viscorough.media.spectra import (
    RelaxationSpectrum,
    RetardationSpectrum,
    Spectrum,
    retardation_spectrum,
    spectrum_of,
)


class SpringsAndDashpots(Medium):
    """Base class of media of springs and dashpots. Their spectra are `relaxation` (ψ) and `retardation` (J)."""

    @property
    @abstractmethod
    def relaxation(self) -> RelaxationSpectrum: ...

    @cached_property
    def retardation(self) -> RetardationSpectrum:
        return retardation_spectrum(self.relaxation)

    def spectrum(self, load: Load) -> Spectrum:
        """Return the springs and dashpots of the medium. They are the same for every load."""
        return spectrum_of(self.relaxation, self.retardation)

    def creep_compliance(self, time: ArrayLike) -> Array:
        """Return the creep compliance J at times t ≥ 0, an array of any shape.

        At time 0 this is J(0+). At an infinite time it is 1/G∞ for a solid, and infinite for a medium that flows.
        """
        time = checked_times(time)
        instantaneous, fluidity, compliances, times = self.retardation
        delayed = -(compliances * np.expm1(-np.divide.outer(time, times))).sum(axis=-1)
        flow = np.multiply(fluidity, time) if fluidity else 0.0  # without a dashpot, also at an infinite time
        return instantaneous + flow + delayed

    def creep_rate(self, time: ArrayLike) -> Array:
        """Return dJ/dt at times t ≥ 0, an array of any shape."""
        time = checked_times(time)
        _, fluidity, compliances, times = self.retardation
        return fluidity + (compliances / times * np.exp(-np.divide.outer(time, times))).sum(axis=-1)

    def relaxation_modulus(self, time: ArrayLike) -> Array:
        """Return the relaxation modulus ψ at times t ≥ 0, an array of any shape. At time 0 this is ψ(0+).

        The pulse η δ(t) of a parallel dashpot is left out.
        """
        time = checked_times(time)
        _, relaxed, moduli, times = self.relaxation
        return relaxed + (moduli * np.exp(-np.divide.outer(time, times))).sum(axis=-1)

    def _check_spectra(self) -> None:
        """Raise ValueError unless all numbers in both spectra, and the inverse of their times, are finite."""
        with np.errstate(all="ignore"):
            rates = 1 / self.relaxation.times, 1 / self.retardation.times
            values = np.hstack([*self.relaxation, *self.retardation, self.relaxation.instantaneous_modulus, *rates])
        if not np.isfinite(values).all():
            name = type(self).__name__
            raise ValueError(f"{name}: its values are too far apart for double precision; closer ones are allowed")
