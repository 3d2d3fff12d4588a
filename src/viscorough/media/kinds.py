"""Linear viscoelastic media, defined by their creep compliance J(t) and relaxation modulus ψ(t) in shear.

Each class is a `Medium` (viscorough.media.medium). A function with an argument `medium` also accepts a number, the
viscosity of a Newtonian medium.

The half-space is incompressible at all times. Numbers are in consistent units: viscosities are in the unit of modulus ×
time, and compliances in the inverse of the unit of modulus. A text with a unit, such as "2 MPa", is converted to SI
units. In all media J does not decrease and is concave. This holds for every medium that relaxes, where ψ is a sum of
decaying exponentials with positive weights.

Moduli are shear moduli G. Young's moduli E = 3 G are given by other keywords (`YOUNG`). A medium with a constant
Poisson ratio other than 0.5 is replaced by the incompressible medium with the same response
(viscorough.basics.elasticity).
"""

from __future__ import annotations

import contextlib
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import gamma

from viscorough.basics import units
from viscorough.basics.argument_names import spelled
from viscorough.basics.arrays import (
    real_number,
    shown,
    unit_attribute,
)
from viscorough.basics.elasticity import poisson_ratio, shear_over_incompressible, young_over_shear
from viscorough.basics.types import Array, Scalar, Several
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
# SI unit of each parameter that may be given with a unit.
UNITS = {
    **dict.fromkeys(("shear_modulus", "instantaneous_modulus", "relaxed_modulus", "moduli"), "Pa"),
    **dict.fromkeys(("relaxation_time", "relaxation_times"), "s"),
    "viscosity": "Pa s",
}
# {parameter that is a shear modulus: keyword for the Young's modulus that can be given instead}
YOUNG = {
    "shear_modulus": "young_modulus",
    "instantaneous_modulus": "instantaneous_young_modulus",
    "relaxed_modulus": "relaxed_young_modulus",
    "moduli": "young_moduli",
    "modulus": "young_modulus",
}
# Names of the parameters that are lists of numbers.
_LISTS = ("moduli", "relaxation_times")
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
        _set_parameters(self, {"viscosity": self.viscosity})
        self._check_spectra()

    @cached_property
    def relaxation(self) -> RelaxationSpectrum:
        return RelaxationSpectrum(self.viscosity, 0.0, _NONE, _NONE)


@dataclass(frozen=True, init=False)
class _SpringAndDashpot(SpringsAndDashpots):
    shear_modulus: float
    viscosity: float

    def __init__(
        self,
        shear_modulus: Scalar | str | None = None,
        viscosity: Scalar | str | None = None,
        *,
        young_modulus: Scalar | str | None = None,
        poisson: float | None = None,
    ) -> None:
        given = {"shear_modulus": shear_modulus, "viscosity": viscosity}
        _set_parameters(self, given, {"shear_modulus": young_modulus}, poisson)
        self._check_spectra()


class Maxwell(_SpringAndDashpot):
    """A spring and a dashpot in series: J = 1/G + t/η, ψ = G exp(−t/τ), with τ = η/G.

    Parameters
    ----------
    shear_modulus : float or str
        Shear modulus G of the spring; a number, or a text such as "2 MPa".
    viscosity : float or str
        Viscosity η of the dashpot in shear; a number, or a text such as "2 kPa s".
    young_modulus : float or str, optional
        Young's modulus E instead of G: G = E/(1 − ν²)/4, which is E/3 for ν = 0.5.
    poisson : float, optional
        Poisson ratio ν, constant in time, above −1 and at most 0.5; only with `young_modulus`, by default 0.5. The
        medium is then replaced by the incompressible medium with the same E(t)/(1 − ν²). Therefore η, too, is divided
        by 2(1 − ν).

    Raises
    ------
    ValueError
        Unless modulus and viscosity are finite numbers above 0, and for a Poisson ratio outside these limits.

    Examples
    --------
    >>> import viscorough
    >>> float(viscorough.Maxwell(shear_modulus=2.0, viscosity=5.0).creep_compliance(10.0))
    2.5
    >>> viscorough.Maxwell(young_modulus="6 MPa", viscosity="5 kPa s")
    Maxwell(shear_modulus=2000000.0, viscosity=5000.0)
    """

    @cached_property
    def relaxation(self) -> RelaxationSpectrum:
        modulus = np.array([self.shear_modulus])
        return RelaxationSpectrum(0.0, 0.0, modulus, self.viscosity / modulus)


class KelvinVoigt(_SpringAndDashpot):
    """A spring and a dashpot in parallel: J = (1 − exp(−t/θ))/G, ψ = G + η δ(t), with θ = η/G.

    Parameters
    ----------
    shear_modulus : float or str
        Shear modulus G of the spring; a number, or a text such as "2 MPa".
    viscosity : float or str
        Viscosity η of the dashpot in shear; a number, or a text such as "2 kPa s".
    young_modulus : float or str, optional
        Young's modulus E instead of G: G = E/(1 − ν²)/4, which is E/3 for ν = 0.5.
    poisson : float, optional
        Poisson ratio ν, constant in time, above −1 and at most 0.5; only with `young_modulus`, by default 0.5. The
        medium is then replaced by the incompressible medium with the same E(t)/(1 − ν²). Therefore η, too, is divided
        by 2(1 − ν).

    Raises
    ------
    ValueError
        Unless modulus and viscosity are finite numbers above 0, and for a Poisson ratio outside these limits.

    Examples
    --------
    >>> import viscorough
    >>> viscorough.KelvinVoigt(shear_modulus=2.0, viscosity=5.0).retardation.times.tolist()
    [2.5]
    """

    @cached_property
    def relaxation(self) -> RelaxationSpectrum:
        return RelaxationSpectrum(self.viscosity, self.shear_modulus, _NONE, _NONE)


@dataclass(frozen=True, init=False)
class StandardLinearSolid(SpringsAndDashpots):
    """A solid that relaxes from the modulus G₀ to the modulus G∞ with one relaxation time τ.

    ψ = G∞ + (G₀ − G∞) exp(−t/τ), and J = 1/G∞ − (1/G∞ − 1/G₀) exp(−t/θ) with the retardation time θ = τ G₀/G∞.

    Parameters
    ----------
    instantaneous_modulus : float or str
        Shear modulus G₀ at time 0; a number, or a text such as "2 MPa".
    relaxed_modulus : float or str
        Shear modulus G∞ < G₀ after a long time; a number, or a text such as "2 MPa".
    relaxation_time : float or str
        Relaxation time τ; a number, or a text such as "20 ms".
    instantaneous_young_modulus, relaxed_young_modulus : float or str, optional
        Young's moduli instead of G₀ and G∞: G = E/(1 − ν²)/4, which is E/3 for ν = 0.5.
    poisson : float, optional
        Poisson ratio ν, constant in time, above −1 and at most 0.5; only with Young's moduli, by default 0.5.

    Raises
    ------
    ValueError
        Unless moduli and time are finite numbers above 0 and G∞ < G₀, and for a Poisson ratio outside these limits.

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

    def __init__(
        self,
        instantaneous_modulus: Scalar | str | None = None,
        relaxed_modulus: Scalar | str | None = None,
        relaxation_time: Scalar | str | None = None,
        *,
        instantaneous_young_modulus: Scalar | str | None = None,
        relaxed_young_modulus: Scalar | str | None = None,
        poisson: float | None = None,
    ) -> None:
        given = {"instantaneous_modulus": instantaneous_modulus, "relaxed_modulus": relaxed_modulus}
        young = {"instantaneous_modulus": instantaneous_young_modulus, "relaxed_modulus": relaxed_young_modulus}
        _set_parameters(self, given | {"relaxation_time": relaxation_time}, young, poisson)
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


@dataclass(frozen=True, init=False)
class Prony(SpringsAndDashpots):
    """A Prony series: a spring and Maxwell branches in parallel, with ψ = G∞ + Σ G_i exp(−t/τ_i).

    J is computed exactly from ψ, see `viscorough.media.spectra.retardation_spectrum`.

    Parameters
    ----------
    relaxed_modulus : float or str
        Shear modulus G∞ ≥ 0 after a long time, 0 for a medium that flows; a number, or a text such as "2 MPa".
    moduli : list
        Shear modulus G_i > 0 of each branch; numbers, or texts such as "2 MPa".
    relaxation_times : list
        Relaxation time τ_i > 0 of each branch, in any order; numbers, or texts such as "20 ms".
    relaxed_young_modulus : float or str, optional
        Young's modulus instead of G∞: G = E/(1 − ν²)/4, which is E/3 for ν = 0.5.
    young_moduli : list, optional
        Young's modulus of each branch instead of G_i.
    poisson : float, optional
        Poisson ratio ν, constant in time, above −1 and at most 0.5; only with Young's moduli, by default 0.5.

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
    moduli: tuple[float, ...]
    relaxation_times: tuple[float, ...]

    def __init__(
        self,
        relaxed_modulus: Scalar | str | None = None,
        moduli: Several | None = None,
        relaxation_times: Several | None = None,
        *,
        relaxed_young_modulus: Scalar | str | None = None,
        young_moduli: Several | None = None,
        poisson: float | None = None,
    ) -> None:
        given = {"relaxed_modulus": relaxed_modulus, "moduli": moduli, "relaxation_times": relaxation_times}
        young = {"relaxed_modulus": relaxed_young_modulus, "moduli": young_moduli}
        _set_parameters(self, given, young, poisson, zero="relaxed_modulus")
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


@dataclass(frozen=True, init=False)
class Springpot(Medium):
    """A medium that creeps by a power law of time: J = t^a/(K Γ(1+a)), ψ = K t^(−a)/Γ(1−a).

    Parameters
    ----------
    modulus : float
        Prefactor K of ψ [modulus · time^a].
    exponent : float
        Exponent a of J.
    young_modulus : float, optional
        Prefactor E₁ of Young's modulus E(t) = E₁ t^(−a)/Γ(1−a), instead of K: K = E₁/(1 − ν²)/4, which is E₁/3 for
        ν = 0.5.
    poisson : float, optional
        Poisson ratio ν, constant in time, above −1 and at most 0.5; only with `young_modulus`, by default 0.5.

    Raises
    ------
    ValueError
        Unless K is a finite number above 0 and 0 < a < 1, and for a Poisson ratio outside these limits.

    Examples
    --------
    >>> import viscorough
    >>> round(float(viscorough.Springpot(modulus=1.0, exponent=0.5).creep_compliance(4.0)), 4)
    2.2568
    """

    modulus: float
    exponent: float

    def __init__(
        self,
        modulus: Scalar | None = None,
        exponent: Scalar | None = None,
        *,
        young_modulus: Scalar | None = None,
        poisson: float | None = None,
    ) -> None:
        _set_parameters(self, {"modulus": modulus, "exponent": exponent}, {"modulus": young_modulus}, poisson)
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

    def relaxation_integral(self, start: ArrayLike, end: ArrayLike) -> Array:
        """Return the integral ∫ψ dt from `start` ≥ 0 to `end` ≥ `start`, to rounding."""
        return self.modulus * _power_increment(start, end, 1 - self.exponent) / gamma(2 - self.exponent)


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


def medium_of(medium: Medium | float | str, length_unit: str = units.UNKNOWN) -> Medium:
    """Return `medium`, or the Newtonian medium if `medium` is a viscosity: a number, or a text such as "2 kPa s".

    length_unit : unit of length of the indenter. If it is not known, the viscosity must not have a unit

    Raises ValueError for anything that is neither a medium nor a viscosity.
    """
    if isinstance(medium, Medium):
        return medium
    viscosity: Any = medium
    if isinstance(medium, str) or unit_attribute(medium):
        viscosity = units.number(medium, "Pa s", length_unit, "viscosity")
    try:
        return Newtonian(viscosity)
    except ValueError as error:
        allowed = spelled(
            "allowed: a finite number above 0 whose inverse is finite",
            "allowed: a medium as viscorough.Maxwell, or the viscosity of a Newtonian one, a finite number above 0",
        )
        raise ValueError(f"{spelled('--viscosity', 'medium')}: {shown(medium)}; {allowed}") from error


def _power_increment(start: ArrayLike, end: ArrayLike, power: float) -> Array:
    """Return end^power − start^power for 0 ≤ start ≤ end and power > 0, to rounding also for close times."""
    start, end = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
    with np.errstate(divide="ignore", invalid="ignore"):
        increment = start**power * np.expm1(power * np.log1p((end - start) / start))
    return np.where(start > 0, increment, end**power)


def _set_parameters(
    medium: Medium,
    given: dict[str, Any],
    young: dict[str, Any] | None = None,
    poisson: float | None = None,
    *,
    zero: str = "",
) -> None:
    """Check the arguments of a medium, and set them as its attributes.

    Values with a unit are converted to SI units, and Young's moduli to shear moduli.

    given : {parameter: value}; the value is None if it is missing, or if Young's modulus is given instead
    young : {parameter that is a shear modulus: Young's modulus, or None if it is not given}
    poisson : Poisson ratio, only if Young's moduli are given; None means 0.5
    zero : name of the parameter that may be 0; all other values must be above 0

    Raises ValueError with the names of medium and parameter unless all values are finite numbers above 0.
    """
    name, young = type(medium).__name__, young or {}
    keywords = ", ".join(YOUNG[modulus] for modulus in young)
    by_young = any(value is not None for value in young.values())
    if by_young and any(given[modulus] is not None for modulus in young):
        text = f"{name}: {', '.join(young)} and {keywords} exclude each other"
        raise ValueError(f"{text}; one of these kinds of moduli is allowed")
    if poisson is not None and not by_young:
        raise ValueError(f"{name}: poisson is for use with {keywords}")
    ratio = poisson_ratio(f"{name}: poisson", poisson)
    for parameter, value in given.items():
        divisor, spelled = 1.0, parameter
        if by_young and parameter in young:
            divisor, spelled, value = young_over_shear(ratio), YOUNG[parameter], young[parameter]
        elif parameter == "viscosity":
            divisor = shear_over_incompressible(ratio)
        if value is None:
            instead = f" or {YOUNG[parameter]}" if parameter in young and not by_young else ""
            raise ValueError(f"{name}: {spelled}{instead} is missing")
        checked: Any
        if parameter in _LISTS:
            checked = tuple(number / divisor for number in _numbers(name, spelled, value, UNITS[parameter]))
        else:
            checked = _number(name, spelled, value, UNITS.get(parameter), zero=parameter == zero) / divisor
        object.__setattr__(medium, parameter, checked)


def _numbers(medium: str, name: str, values: Any, unit: str) -> list[float]:
    """Return the values of a list as floats.

    Raises ValueError if `values` is not a list, or if `_number` refuses one of the values.
    """
    entries = list(values) if isinstance(values, list | tuple) or np.ndim(values) == 1 else []
    if not entries:
        raise ValueError(f"{medium}: {name} {shown(values)}; allowed: a list of one or more numbers above 0")
    return [_number(medium, f"{name}[{i}]", entry, unit) for i, entry in enumerate(entries)]


def _number(medium: str, name: str, value: Any, unit: str | None, *, zero: bool = False) -> float:
    """Return a value as a float; a value with a unit is converted to SI units.

    medium, name : names of medium and parameter, for messages
    unit : SI unit of the parameter; None for a parameter without a unit
    zero : whether 0 is allowed

    Raises ValueError unless the value is a finite number above 0, or 0 if `zero` is true.
    """
    if unit and (isinstance(value, str) or hasattr(value, "units")):
        value = units.number(value, unit, "m", f"{medium}: {name}")
    with contextlib.suppress(ValueError):
        number = real_number(name, value)
        if number > 0 or (zero and number == 0):
            return number
    allowed = "0 or a finite number above 0" if zero else "a finite number above 0"
    raise ValueError(f"{medium}: {name} {shown(value)}; allowed: {allowed}")
