"""Base class of linear viscoelastic media."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING

from numpy.typing import ArrayLike

from viscorough.basics.arrays import real_numbers
from viscorough.basics.types import Array
from viscorough.media.spectra import Spectrum

if TYPE_CHECKING:
    from viscorough.media.load import Load


def checked_times(time: ArrayLike) -> Array:
    """Return times as an array of floats, without labels. Raises ValueError unless they are real numbers from 0 on."""
    times = real_numbers("time", time)
    if (times < 0).any():
        raise ValueError(f"time: {times.min():g}; allowed: 0 or more")
    return times


class Medium(ABC):
    """Base class of linear viscoelastic media, with creep compliance J(t) and relaxation modulus ψ(t) in shear.

    A motion is computed for springs and dashpots with the same J, see `spectrum`. A medium of your own that consists of
    springs and dashpots is a subclass of SpringsAndDashpots (viscorough.media.springs_and_dashpots). It defines its
    spectrum of ψ, and also that of J if it is known; all other methods follow from the two.

    Examples
    --------
    A Burgers medium: a spring, a dashpot and a Kelvin-Voigt element in series.

    >>> import numpy as np
    >>> import viscorough
    >>> from viscorough.media.spectra import RetardationSpectrum, relaxation_spectrum
    >>> from viscorough.media.springs_and_dashpots import SpringsAndDashpots
    >>> class Burgers(SpringsAndDashpots):
    ...     retardation = RetardationSpectrum(0.5, 0.1, np.array([0.25]), np.array([2.0]))  # J₀, φ, J₁, θ₁
    ...     relaxation = relaxation_spectrum(retardation)
    >>> Burgers().creep_compliance([0.0, 2.0]).round(4)
    array([0.5  , 0.858])
    >>> curve = viscorough.indent(viscorough.self_affine_disc(0.7, 17, rms=0.01, seed=1))
    >>> viscorough.kinetics(curve, force=0.04, medium=Burgers(), times=[0.0, 2.0]).depth.round(4)
    array([0.0187, 0.0251])
    """

    @abstractmethod
    def creep_compliance(self, time: ArrayLike) -> Array:
        """Return the creep compliance J at times t ≥ 0, an array of any shape. At time 0 this is J(0+)."""

    @abstractmethod
    def creep_rate(self, time: ArrayLike) -> Array:
        """Return dJ/dt at times t ≥ 0, an array of any shape; infinite at time 0 in a springpot."""

    @abstractmethod
    def relaxation_modulus(self, time: ArrayLike) -> Array:
        """Return ψ at times t ≥ 0, an array of any shape, without the pulse η δ(t) of a parallel dashpot."""

    @abstractmethod
    def spectrum(self, load: Load) -> Spectrum:
        """Return springs and dashpots that have the J of the medium at the times of a load."""
