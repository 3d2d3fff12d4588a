"""Media with a free form: a spring, a dashpot and any number of Kelvin-Voigt elements in series."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from viscorough.basics.arrays import ReadOnlyArrays, read_only, real_number, real_numbers
from viscorough.basics.summaries import span
from viscorough.basics.types import Array
from viscorough.media.spectra import (
    RelaxationSpectrum,
    RetardationSpectrum,
    relaxation_spectrum,
    retardation_spectrum,
)
from viscorough.media.springs_and_dashpots import SpringsAndDashpots

# A medium without a spring (J₀ = 0) that is neither Newtonian nor Kelvin-Voigt has a parallel dashpot and branches. It
# gets a spring with this share of the compliance of its fastest element, or of the first known time.
_STIFF_SPRING = 1e-6
# A medium of a single spring gets a dashpot that creeps by this share of J₀ until the last known time.
_SLOW_DASHPOT = 1e-12


@dataclass(frozen=True, repr=False)
class FreeForm(ReadOnlyArrays, SpringsAndDashpots):
    """A spring, a dashpot and Kelvin-Voigt elements in series: J = J₀ + φ t + Σ J_j (1 − exp(−t/θ_j)).

    Every medium that relaxes is of this form. It is the result of a fit with non-negative strengths, to a table of J or
    ψ or to a measured record.

    Parameters
    ----------
    instantaneous_compliance : float
        Compliance J₀ ≥ 0 of the spring.
    fluidity : float
        Fluidity φ ≥ 0 of the dashpot, the inverse of its viscosity; 0 for a solid.
    compliances : array
        Compliance J_j ≥ 0 of each element, shape (elements,). Elements with J_j = 0 are dropped.
    retardation_times : array
        Retardation time θ_j > 0 of each element, all different, shape (elements,).
    first_time, last_time : float, optional
        Times between which J is known. Outside them `creep_compliance` is nan.

    Raises
    ------
    ValueError
        For numbers outside these ranges, and if all strengths are 0.

    Examples
    --------
    >>> from viscorough.media.table import FreeForm
    >>> medium = FreeForm(0.25, 0.0, [0.75], [2.0])  # a standard linear solid
    >>> round(float(medium.relaxation.instantaneous_modulus), 12), round(float(medium.relaxation.relaxed_modulus), 12)
    (4.0, 1.0)
    """

    instantaneous_compliance: float
    fluidity: float
    compliances: np.ndarray
    retardation_times: np.ndarray
    first_time: float = 0.0
    last_time: float = np.inf

    if TYPE_CHECKING:  # the constructor also accepts lists, which become arrays

        def __init__(
            self,
            instantaneous_compliance: float,
            fluidity: float,
            compliances: ArrayLike,
            retardation_times: ArrayLike,
            first_time: float = 0.0,
            last_time: float = np.inf,
        ) -> None: ...

    def __repr__(self) -> str:
        """Return a summary, without the arrays: the number of elements, and the range of their times."""
        times = self.retardation_times
        text = f"retardation times {span(times)}" if times.size else "no elements"
        return f"{type(self).__name__} of J₀ {self.instantaneous_compliance:g}, φ {self.fluidity:g}, {text}"

    def __post_init__(self) -> None:
        single = {name: real_number(f"FreeForm: {name}", getattr(self, name)) for name in ("first_time", "fluidity")}
        single["instantaneous_compliance"] = real_number(
            "FreeForm: instantaneous_compliance", self.instantaneous_compliance
        )
        compliances = real_numbers("FreeForm: compliances", self.compliances)
        times = real_numbers("FreeForm: retardation_times", self.retardation_times)
        if compliances.ndim != 1 or compliances.shape != times.shape:
            raise ValueError("FreeForm: compliances and retardation_times; allowed: two rows of the same length")
        used = compliances != 0
        compliances, times = compliances[used], times[used]
        strengths = np.array([single["instantaneous_compliance"], single["fluidity"], *compliances])
        if not (np.isfinite(strengths).all() and (strengths >= 0).all() and strengths.any()):
            raise ValueError("FreeForm: strengths; allowed: finite numbers of 0 or more, not all 0")
        if not (np.isfinite(times).all() and (times > 0).all() and np.unique(times).size == times.size):
            raise ValueError("FreeForm: retardation_times; allowed: finite numbers above 0, all different")
        for name, value in (single | {"last_time": float(self.last_time)}).items():
            object.__setattr__(self, name, value)
        object.__setattr__(self, "compliances", read_only(compliances))
        object.__setattr__(self, "retardation_times", read_only(times))
        self._check_spectra()

    @cached_property
    def retardation(self) -> RetardationSpectrum:
        """Return the spectrum of J. Where J₀ or φ must be above 0, they get a negligible value."""
        instantaneous, fluidity = self.instantaneous_compliance, self.fluidity
        compliances, times = self.compliances, self.retardation_times
        exact = times.size + (fluidity > 0) <= 1  # Newtonian or Kelvin-Voigt
        if instantaneous == 0 and not exact:
            fastest = times.min()
            first = self.first_time if self.first_time > 0 else fastest
            delayed = -(compliances * np.expm1(-first / times)).sum()
            instantaneous = _STIFF_SPRING * (fluidity * first + delayed)
        if fluidity == 0 and times.size == 0:
            last = self.last_time if np.isfinite(self.last_time) else 1.0
            fluidity = _SLOW_DASHPOT * instantaneous / last
        return RetardationSpectrum(instantaneous, fluidity, compliances, times)

    @cached_property
    def relaxation(self) -> RelaxationSpectrum:
        instantaneous, fluidity, compliances, times = self.retardation
        if instantaneous > 0:
            return relaxation_spectrum(self.retardation)
        if fluidity > 0:
            return RelaxationSpectrum(1 / fluidity, 0.0, np.array([]), np.array([]))
        modulus = float(1 / compliances[0])
        return RelaxationSpectrum(modulus * float(times[0]), modulus, np.array([]), np.array([]))

    def creep_compliance(self, time: ArrayLike) -> Array:
        """Return J at times t ≥ 0, an array of any shape; nan at times at which it is not known."""
        values = super().creep_compliance(time)
        time = np.asarray(time)
        return np.where((time >= self.first_time) & (time <= self.last_time), values, np.nan)


def free_form_of(relaxation: RelaxationSpectrum, first_time: float = 0.0, last_time: float = np.inf) -> FreeForm:
    """Return the FreeForm with a given spectrum of ψ: one that consists of springs and at least one branch."""
    instantaneous, fluidity, compliances, times = retardation_spectrum(relaxation)
    return FreeForm(instantaneous, fluidity, compliances, times, first_time, last_time)
