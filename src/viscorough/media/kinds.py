"""Linear viscoelastic media, defined by their creep compliance J(t) and relaxation modulus ψ(t) in shear.

Each class is a `Medium` (viscorough.media.medium). A function with an argument `medium` also accepts a number, the
viscosity of a Newtonian medium.

The half-space is incompressible at all times. Numbers are in SI units, or in consistent units: viscosities are then in
the unit of modulus × time, and compliances in the inverse of the unit of modulus. Moduli are shear moduli G. In all
media J does not decrease and is concave. This holds for every medium that relaxes, where ψ is a sum of decaying
exponentials with positive weights.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import gamma

from viscorough.basics.arrays import positive, real_number, shown
from viscorough.basics.types import Array
from viscorough.media.load import Load
from viscorough.media.medium import Medium, checked_times
from viscorough.media.spectra import (
    RelaxationSpectrum,
    Spectrum,
    power_law_spectrum,
    relaxation_spectrum,
    spectrum_of,
)
from viscorough.media.springs_and_dashpots import SpringsAndDashpots

_NONE = np.array([])
# Error of a motion in a springpot after a turn of the load, because J is not represented at earlier times, in units of
# about 1e-3; see `Springpot.spectrum`. A contact that begins late in an interval between two turns increases the error.
_SHORTEST = 1e-7
# Largest ratio of the duration of a load to its shortest interval in a springpot: for larger ratios numbers overflow.
_LONGEST = 1e150


@dataclass(frozen=True)
class Newtonian(SpringsAndDashpots):
    """The linearly viscous medium of the paper: creep compliance J = t/η, relaxation modulus ψ = η δ(t).

    Parameters
    ----------
    viscosity : float
        Viscosity η. Raises ValueError unless it is a finite number above 0.

    Examples
    --------
    >>> import viscorough
    >>> float(viscorough.Newtonian(viscosity=5.0).creep_compliance(10.0))
    2.0
    """

    viscosity: float

    def __post_init__(self) -> None:
        _check_parameters(self)
        self._check_spectra()

    @cached_property
    def relaxation(self) -> RelaxationSpectrum:
        return RelaxationSpectrum(self.viscosity, 0.0, _NONE, _NONE)


@dataclass(frozen=True)
class _SpringAndDashpot(SpringsAndDashpots):
    shear_modulus: float
    viscosity: float

    def __post_init__(self) -> None:
        _check_parameters(self)
        self._check_spectra()


class Maxwell(_SpringAndDashpot):
    """A spring and a dashpot in series: J = 1/G + t/η, ψ = G exp(−t/τ), with τ = η/G.

    Parameters
    ----------
    shear_modulus : float
        Shear modulus G of the spring.
    viscosity : float
        Viscosity η of the dashpot in shear.

    Raises
    ------
    ValueError
        Unless modulus and viscosity are finite numbers above 0.

    Examples
    --------
    >>> import viscorough
    >>> float(viscorough.Maxwell(shear_modulus=2.0, viscosity=5.0).creep_compliance(10.0))
    2.5
    """

    @cached_property
    def relaxation(self) -> RelaxationSpectrum:
        modulus = np.array([self.shear_modulus])
        return RelaxationSpectrum(0.0, 0.0, modulus, self.viscosity / modulus)


class KelvinVoigt(_SpringAndDashpot):
    """A spring and a dashpot in parallel: J = (1 − exp(−t/θ))/G, ψ = G + η δ(t), with θ = η/G.

    Parameters
    ----------
    shear_modulus : float
        Shear modulus G of the spring.
    viscosity : float
        Viscosity η of the dashpot in shear.

    Raises
    ------
    ValueError
        Unless modulus and viscosity are finite numbers above 0.

    Examples
    --------
    >>> import viscorough
    >>> viscorough.KelvinVoigt(shear_modulus=2.0, viscosity=5.0).retardation.times.tolist()
    [2.5]
    """

    @cached_property
    def relaxation(self) -> RelaxationSpectrum:
        return RelaxationSpectrum(self.viscosity, self.shear_modulus, _NONE, _NONE)


@dataclass(frozen=True)
class StandardLinearSolid(SpringsAndDashpots):
    """A solid that relaxes from the modulus G₀ to the modulus G∞ with one relaxation time τ.

    ψ = G∞ + (G₀ − G∞) exp(−t/τ), and J = 1/G∞ − (1/G∞ − 1/G₀) exp(−t/θ) with the retardation time θ = τ G₀/G∞.

    Parameters
    ----------
    instantaneous_modulus : float
        Shear modulus G₀ at time 0.
    relaxed_modulus : float
        Shear modulus G∞ < G₀ after a long time.
    relaxation_time : float
        Relaxation time τ.

    Raises
    ------
    ValueError
        Unless moduli and time are finite numbers above 0 and G∞ < G₀.

    Examples
    --------
    >>> import viscorough
    >>> solid = viscorough.StandardLinearSolid(4.0, 1.0, relaxation_time=0.5)
    >>> float(solid.creep_compliance(0.0)), solid.retardation.times.tolist()
    (0.25, [2.0])
    """

    instantaneous_modulus: float
    relaxed_modulus: float
    relaxation_time: float

    def __post_init__(self) -> None:
        _check_parameters(self)
        self._check_spectra()

    @cached_property
    def relaxation(self) -> RelaxationSpectrum:
        branch = self.instantaneous_modulus - self.relaxed_modulus
        if not branch > 0:
            raise ValueError(
                f"StandardLinearSolid: relaxed_modulus {self.relaxed_modulus:g}; "
                f"allowed: below instantaneous_modulus, {self.instantaneous_modulus:g}"
            )
        return RelaxationSpectrum(0.0, self.relaxed_modulus, np.array([branch]), np.array([self.relaxation_time]))


@dataclass(frozen=True)
class Prony(SpringsAndDashpots):
    """A Prony series: a spring and Maxwell branches in parallel, with ψ = G∞ + Σ G_i exp(−t/τ_i).

    J is computed exactly from ψ, see `viscorough.media.spectra.retardation_spectrum`.

    Parameters
    ----------
    relaxed_modulus : float
        Shear modulus G∞ ≥ 0 after a long time, 0 for a medium that flows.
    moduli : sequence of float
        Shear modulus G_i > 0 of each branch.
    relaxation_times : sequence of float
        Relaxation time τ_i > 0 of each branch, in any order.

    Raises
    ------
    ValueError
        For values outside these ranges, for empty lists, and if the numbers of times and moduli differ.

    Examples
    --------
    >>> import viscorough
    >>> medium = viscorough.Prony(1.0, moduli=[2.0, 3.0], relaxation_times=[0.1, 10.0])
    >>> float(medium.relaxation.instantaneous_modulus)
    6.0
    """

    relaxed_modulus: float
    moduli: Sequence[float]
    relaxation_times: Sequence[float]

    def __post_init__(self) -> None:
        _check_parameters(self, zero="relaxed_modulus")
        if len(self.moduli) != len(self.relaxation_times):
            raise ValueError(
                f"Prony: {len(self.moduli)} moduli and {len(self.relaxation_times)} relaxation_times; "
                "allowed: one time for every modulus"
            )
        self._check_spectra()

    @cached_property
    def relaxation(self) -> RelaxationSpectrum:
        times = np.array(self.relaxation_times)
        # Branches with the same rate are merged into one branch.
        _, first, branch = np.unique(1 / times, return_index=True, return_inverse=True)
        moduli = np.bincount(branch, self.moduli).astype(float)
        return RelaxationSpectrum(0.0, self.relaxed_modulus, moduli, times[first])


@dataclass(frozen=True)
class Springpot(Medium):
    """A medium that creeps by a power law of time: J = t^a/(K Γ(1+a)), ψ = K t^(−a)/Γ(1−a).

    Parameters
    ----------
    modulus : float
        Prefactor K of ψ [modulus · time^a].
    exponent : float
        Exponent a of J.

    Raises
    ------
    ValueError
        Unless K is a finite number above 0 and 0 < a < 1.

    Examples
    --------
    >>> import viscorough
    >>> round(float(viscorough.Springpot(modulus=1.0, exponent=0.5).creep_compliance(4.0)), 4)
    2.2568
    """

    modulus: float
    exponent: float

    def __post_init__(self) -> None:
        _check_parameters(self)
        if not self.exponent < 1:
            text = "allowed: above 0 and below 1 (1 is a Newtonian medium)"
            raise ValueError(f"Springpot: exponent {self.exponent:g}; {text}")
        if np.isinf(1 / self.modulus):
            raise ValueError(f"Springpot: modulus {self.modulus:g}; allowed: numbers whose inverse is finite")

    def spectrum(self, load: Load) -> Spectrum:
        """Return springs and dashpots with the same J, within a relative error of 1e-8, at the times of the load.

        They creep like the springpot from the time s up to the duration of the load. The share s/T of the shortest
        interval T between two turns of the load satisfies (s/T)^(1+a) = _SHORTEST: before the time s, J errs by about
        J(s) ~ s^a, and the integral of this error over time, ~ s^(1+a), affects the motion after a turn.

        Raises ValueError if the duration is more than _LONGEST times the shortest interval.
        """
        if load.duration > _LONGEST * load.shortest_interval:
            raise ValueError(
                f"times: intervals from {load.shortest_interval:g} to {load.duration:g} in a springpot; allowed: the "
                f"longest up to {_LONGEST:g} times the shortest; times within that range are needed"
            )
        shortest = load.shortest_interval * _SHORTEST ** (1 / (1 + self.exponent))
        retardation = power_law_spectrum(self.modulus, self.exponent, shortest, load.duration or 1.0)
        return spectrum_of(relaxation_spectrum(retardation), retardation)

    def creep_compliance(self, time: ArrayLike) -> Array:
        """Return the creep compliance J at times t ≥ 0, an array of any shape."""
        return checked_times(time) ** self.exponent / (self.modulus * gamma(1 + self.exponent))

    def creep_rate(self, time: ArrayLike) -> Array:
        """Return dJ/dt at times t ≥ 0, an array of any shape; infinite at time 0."""
        with np.errstate(divide="ignore"):
            return checked_times(time) ** (self.exponent - 1) / (self.modulus * gamma(self.exponent))

    def relaxation_modulus(self, time: ArrayLike) -> Array:
        """Return the relaxation modulus ψ at times t ≥ 0, an array of any shape; infinite at time 0."""
        with np.errstate(divide="ignore"):
            return self.modulus * checked_times(time) ** -self.exponent / gamma(1 - self.exponent)


# Media that have a name in MEDIUM.yaml: {value of the key `kind`: class}. The other keys of the file are the
# parameters of the class.
KINDS: dict[str, Any] = {
    "newtonian": Newtonian,
    "maxwell": Maxwell,
    "kelvin_voigt": KelvinVoigt,
    "standard_linear_solid": StandardLinearSolid,
    "prony": Prony,
    "springpot": Springpot,
}


def medium_of(medium: Medium | float) -> Medium:
    """Return `medium`, or the Newtonian medium if `medium` is a viscosity.

    Raises ValueError for anything that is neither a medium nor a viscosity.
    """
    if isinstance(medium, Medium):
        return medium
    try:
        return Newtonian(medium)
    except ValueError as error:
        allowed = "a medium as viscorough.Maxwell, or the viscosity of a Newtonian one, a finite number above 0"
        raise ValueError(f"argument medium: {shown(medium)}; allowed: {allowed}") from error


def _check_parameters(medium: Any, zero: str = "") -> None:
    """Convert the parameters of a medium to floats, and lists of parameters to tuples of floats.

    zero : name of the parameter that may be 0; all other values must be above 0

    Raises ValueError with the names of medium and parameter unless all values are finite numbers above 0.
    """
    for field in dataclasses.fields(medium):
        value, name = getattr(medium, field.name), f"{type(medium).__name__}: {field.name}"
        checked: float | tuple[float, ...]
        if field.type == "Sequence[float]":
            if np.ndim(value) != 1 or not len(value):
                raise ValueError(f"{name} {shown(value)}; allowed: a list of one or more numbers above 0")
            checked = tuple(positive(f"{name}[{i}]", entry) for i, entry in enumerate(value))
        elif field.name == zero:
            checked = real_number(name, value)
            if checked < 0:
                raise ValueError(f"{name} {shown(value)}; allowed: 0 or a finite number above 0")
        else:
            checked = positive(name, value)
        object.__setattr__(medium, field.name, checked)
