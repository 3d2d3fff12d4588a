"""What every linear viscoelastic medium answers, whatever is known of it."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from viscorough.basics.types import Array


class RelaxationSpectrum(NamedTuple):
    """ψ(t) = η δ(t) + G∞ + Σ G_i exp(−t/τ_i): a dashpot, a spring and Maxwell branches side by side.

    viscosity : η; relaxed_modulus : G∞; moduli, times : G_i > 0 and τ_i > 0, arrays of shape (branches,)
    """

    viscosity: float
    relaxed_modulus: float
    moduli: Array
    times: Array

    @property
    def instantaneous_modulus(self) -> float:
        """G∞ + Σ G_i, the modulus of a medium without a dashpot at time 0."""
        return self.relaxed_modulus + self.moduli.sum()


class RetardationSpectrum(NamedTuple):
    """J(t) = J₀ + φ t + Σ J_j (1 − exp(−t/θ_j)): a spring, a dashpot and Kelvin-Voigt elements in series.

    instantaneous_compliance : J₀; fluidity : φ
    compliances, times : J_j > 0 and θ_j > 0, arrays of shape (elements,)
    """

    instantaneous_compliance: float
    fluidity: float
    compliances: Array
    times: Array


class Medium(ABC):
    """A linear viscoelastic medium: creep compliance J(t) and relaxation modulus ψ(t) in shear.

    A subclass gives J, its rate and its integral. Where its ψ or its spectra are known it gives those as well: ψ is
    what prescribed depths and pressures need, discrete spectra are what direct integration needs.

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
        """Spectrum of ψ; None unless the medium consists of springs and dashpots."""
        return None

    @property
    def retardation(self) -> RetardationSpectrum | None:
        """Spectrum of J; None unless the medium consists of springs and dashpots."""
        return None

    @property
    def last_time(self) -> float:
        """The time up to which J is known; infinite for all but measured media."""
        return np.inf

    @abstractmethod
    def creep_compliance(self, time: ArrayLike) -> Array:
        """J at times t ≥ 0, any shape; J(0+) at time 0."""

    @abstractmethod
    def creep_rate(self, time: ArrayLike, *, left: bool = False) -> Array:
        """dJ/dt at times t ≥ 0, any shape; where J has a kink, the rate after it, or with `left` before it."""

    @abstractmethod
    def creep_integral(self, start: ArrayLike, end: ArrayLike) -> Array:
        """∫J dt from start ≥ 0 to end ≥ start."""

    def creep_increment(self, start: ArrayLike, end: ArrayLike) -> Array:
        """J(end) − J(start) for 0 ≤ start ≤ end."""
        return self.creep_compliance(end) - self.creep_compliance(start)

    def relaxation_modulus(self, time: ArrayLike) -> Array:
        """ψ at times t ≥ 0, any shape, without the pulse η δ(t) of a dashpot. Raises ValueError if it is not known."""
        raise self._without_modulus()

    def relaxation_integral(self, start: ArrayLike, end: ArrayLike) -> Array:
        """∫ψ dt from start ≥ 0 to end ≥ start, without the pulse at time 0. Raises ValueError if it is not known."""
        raise self._without_modulus()

    def _without_modulus(self) -> ValueError:
        return ValueError(f"medium: {type(self).__name__}; allowed: media whose relaxation is known, as a Prony series")
