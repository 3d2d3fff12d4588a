"""Linear viscoelastic media, by their creep compliance J(t) and relaxation modulus ψ(t) in shear.

The half-space is incompressible at all times. Moduli are in one unit, times in another, viscosities in their product
and compliances in the inverse of the modulus. All media are passive: J does not decrease and is concave.
"""

from dataclasses import dataclass, fields
from functools import cached_property
from numbers import Real

import numpy as np
from scipy.special import gamma

from viscorough.viscous.creep_table import CreepTable
from viscorough.viscous.spectra import RelaxationSpectrum, RetardationSpectrum, retardation_spectrum

_NONE = np.array([])


class _Exponential:
    """A medium of springs and dashpots, which has discrete spectra: `relaxation` and `retardation`."""

    def __post_init__(self):
        _keep_positive(self)
        self._check_spectra()

    def creep_compliance(self, time):
        """J at times t ≥ 0, any shape; J(0+) at time 0."""
        time = np.asarray(time, dtype=float)
        instantaneous, fluidity, compliances, times = self.retardation
        delayed = -(compliances * np.expm1(-time[..., None] / times)).sum(axis=-1)
        return instantaneous + fluidity * time + delayed

    def creep_rate(self, time):
        """dJ/dt at times t ≥ 0, any shape."""
        time = np.asarray(time, dtype=float)
        _, fluidity, compliances, times = self.retardation
        return fluidity + (compliances / times * np.exp(-time[..., None] / times)).sum(axis=-1)

    def relaxation_modulus(self, time):
        """ψ at times t > 0, any shape, and its limit at time 0, without the pulse η δ(t) of a dashpot."""
        time = np.asarray(time, dtype=float)
        _, relaxed, moduli, times = self.relaxation
        return relaxed + (moduli * np.exp(-time[..., None] / times)).sum(axis=-1)

    def _check_spectra(self):
        """Raise ValueError if spectra cannot be held in double precision."""
        with np.errstate(all="ignore"):
            values = [*self.relaxation, *self.retardation, self.relaxation.instantaneous_modulus]
            finite = all(np.isfinite(value).all() for value in values)
            for spectrum in (self.relaxation, self.retardation):
                finite = finite and (spectrum.times > 0).all() and np.isfinite(1 / spectrum.times).all()
        if not finite:
            name = type(self).__name__
            raise ValueError(f"{name}: its values are too far apart for double precision; closer ones are allowed")


@dataclass(frozen=True)
class Newtonian(_Exponential):
    """A linearly viscous medium, that of the paper: J = t/η, ψ = η δ(t).

    viscosity : η. Raises ValueError unless it is a finite number above 0.
    """

    viscosity: float

    @cached_property
    def relaxation(self):
        return RelaxationSpectrum(self.viscosity, 0.0, _NONE, _NONE)

    @cached_property
    def retardation(self):
        return RetardationSpectrum(0.0, _inverse(self.viscosity), _NONE, _NONE)


@dataclass(frozen=True)
class _SpringAndDashpot(_Exponential):
    shear_modulus: float
    viscosity: float

    @property
    def _time(self):
        """η/G, shape (1,)."""
        return np.array([self.viscosity]) / self.shear_modulus


class Maxwell(_SpringAndDashpot):
    """A spring and a dashpot in series: J = 1/G + t/η, ψ = G exp(−t/τ), τ = η/G.

    shear_modulus : G; viscosity : η. Raises ValueError unless both are finite numbers above 0.
    """

    @cached_property
    def relaxation(self):
        return RelaxationSpectrum(0.0, 0.0, np.array([self.shear_modulus]), self._time)

    @cached_property
    def retardation(self):
        return RetardationSpectrum(_inverse(self.shear_modulus), _inverse(self.viscosity), _NONE, _NONE)


class KelvinVoigt(_SpringAndDashpot):
    """A spring and a dashpot side by side: J = (1 − exp(−t/θ))/G, θ = η/G, ψ = G + η δ(t).

    shear_modulus : G; viscosity : η. Raises ValueError unless both are finite numbers above 0.
    """

    @cached_property
    def relaxation(self):
        return RelaxationSpectrum(self.viscosity, self.shear_modulus, _NONE, _NONE)

    @cached_property
    def retardation(self):
        return RetardationSpectrum(0.0, 0.0, np.array([_inverse(self.shear_modulus)]), self._time)


@dataclass(frozen=True)
class StandardLinearSolid(_Exponential):
    """J = 1/G∞ − (1/G∞ − 1/G₀) exp(−t/θ), θ = τ G₀/G∞; ψ = G∞ + (G₀ − G∞) exp(−t/τ).

    instantaneous_modulus : G₀; relaxed_modulus : G∞ < G₀; relaxation_time : τ
    Raises ValueError unless all are finite numbers above 0 and G∞ < G₀.
    """

    instantaneous_modulus: float
    relaxed_modulus: float
    relaxation_time: float

    def __post_init__(self):
        _keep_positive(self)
        if not self.relaxed_modulus < self.instantaneous_modulus:
            raise ValueError(
                f"StandardLinearSolid: relaxed_modulus {self.relaxed_modulus:g}; "
                f"allowed: below instantaneous_modulus, {self.instantaneous_modulus:g}"
            )
        self._check_spectra()

    @cached_property
    def relaxation(self):
        branch = self.instantaneous_modulus - self.relaxed_modulus
        return RelaxationSpectrum(0.0, self.relaxed_modulus, np.array([branch]), np.array([self.relaxation_time]))

    @cached_property
    def retardation(self):
        instantaneous, relaxed = self.instantaneous_modulus, self.relaxed_modulus
        with np.errstate(over="ignore", invalid="ignore"):
            delayed = np.array([instantaneous - relaxed]) / instantaneous / relaxed
            times = np.array([self.relaxation_time]) * (instantaneous / relaxed)
        return RetardationSpectrum(_inverse(instantaneous), 0.0, delayed, times)


@dataclass(frozen=True)
class Prony(_Exponential):
    """A Prony series: ψ = G∞ + Σ G_i exp(−t/τ_i); J from the zeros of its relaxance, exactly.

    relaxed_modulus : G∞ ≥ 0, 0 for a medium that flows; moduli : G_i > 0; relaxation_times : τ_i > 0, in any order

    Raises ValueError for values outside these ranges, and unless there are as many times as moduli, at least one.
    """

    relaxed_modulus: float
    moduli: tuple
    relaxation_times: tuple

    def __post_init__(self):
        relaxed = _number(self, "relaxed_modulus", self.relaxed_modulus, zero=True)
        object.__setattr__(self, "relaxed_modulus", relaxed)
        for name in ("moduli", "relaxation_times"):
            values = getattr(self, name)
            if isinstance(values, str | bytes | dict) or np.ndim(values) != 1 or len(values) == 0:
                raise ValueError(f"Prony: {name} {values!r}; allowed: a list of one or more numbers above 0")
            numbers = tuple(_number(self, f"{name}[{i}]", value) for i, value in enumerate(values))
            object.__setattr__(self, name, numbers)
        if len(self.moduli) != len(self.relaxation_times):
            raise ValueError(
                f"Prony: {len(self.moduli)} moduli and {len(self.relaxation_times)} relaxation_times; "
                "allowed: one time for every modulus"
            )
        self._check_spectra()

    @cached_property
    def relaxation(self):
        times = np.array(self.relaxation_times)
        with np.errstate(over="ignore"):
            # Branches of one rate are one branch.
            _, first, branch = np.unique(1 / times, return_index=True, return_inverse=True)
            moduli = np.bincount(branch, self.moduli)
        return RelaxationSpectrum(0.0, self.relaxed_modulus, moduli, times[first])

    @cached_property
    def retardation(self):
        return retardation_spectrum(self.relaxation)


@dataclass(frozen=True)
class Springpot:
    """Creep by a power law: J = t^a/(K Γ(1+a)), ψ = K t^(−a)/Γ(1−a).

    modulus : K [modulus · time^a]; exponent : a
    Raises ValueError unless K is a finite number above 0 and 0 < a < 1.
    """

    modulus: float
    exponent: float

    def __post_init__(self):
        _keep_positive(self)
        if not self.exponent < 1:
            text = "allowed: above 0 and below 1 (1 is a Newtonian medium)"
            raise ValueError(f"Springpot: exponent {self.exponent:g}; {text}")
        if not np.isfinite(_inverse(self.modulus)):
            raise ValueError(f"Springpot: modulus {self.modulus:g}; allowed: numbers whose inverse is finite")

    def creep_compliance(self, time):
        """J at times t ≥ 0, any shape."""
        return np.asarray(time, dtype=float) ** self.exponent / (self.modulus * gamma(1 + self.exponent))

    def creep_rate(self, time, *, left=False):
        """dJ/dt at times t ≥ 0, any shape; infinite at time 0."""
        with np.errstate(divide="ignore"):
            return np.asarray(time, dtype=float) ** (self.exponent - 1) / (self.modulus * gamma(self.exponent))

    def creep_increment(self, start, end):
        """J(end) − J(start) for 0 ≤ start ≤ end, to rounding."""
        return _power_increment(start, end, self.exponent) / (self.modulus * gamma(1 + self.exponent))

    def creep_integral(self, start, end):
        """∫J dt from start ≥ 0 to end ≥ start, to rounding."""
        return _power_increment(start, end, 1 + self.exponent) / (self.modulus * gamma(2 + self.exponent))

    def relaxation_modulus(self, time):
        """ψ at times t ≥ 0, any shape; infinite at time 0."""
        with np.errstate(divide="ignore"):
            return self.modulus * np.asarray(time, dtype=float) ** -self.exponent / gamma(1 - self.exponent)

    def relaxation_integral(self, start, end):
        """∫ψ dt from start ≥ 0 to end ≥ start, to rounding."""
        return self.modulus * _power_increment(start, end, 1 - self.exponent) / gamma(2 - self.exponent)


def medium_of(medium):
    """The medium; a number is the viscosity of a Newtonian one. Raises ValueError for anything else."""
    if isinstance(medium, _Exponential | Springpot | CreepTable):
        return medium
    return Newtonian(medium)


def _power_increment(start, end, power):
    """end^power − start^power for 0 ≤ start ≤ end and power > 0, to rounding."""
    start, end = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
    with np.errstate(divide="ignore", invalid="ignore"):
        increment = start**power * np.expm1(power * np.log1p((end - start) / start))
    return np.where(start > 0, increment, end**power)


def _keep_positive(medium):
    for field in fields(medium):
        object.__setattr__(medium, field.name, _number(medium, field.name, getattr(medium, field.name)))


def _number(medium, name, value, *, zero=False):
    """The value as a float. Raises ValueError unless it is a finite number above 0, or 0 where that is allowed."""
    real = isinstance(value, Real) and not isinstance(value, bool) and abs(value) <= np.finfo(float).max
    if not (real and (value > 0 or (zero and value == 0))):
        allowed = "0 or a finite number above 0" if zero else "a finite number above 0"
        raise ValueError(f"{type(medium).__name__}: {name}: {repr(value)[:60]}; allowed: {allowed}")
    return float(value)


def _inverse(value):
    with np.errstate(over="ignore", divide="ignore"):
        return float(1 / np.float64(value))
