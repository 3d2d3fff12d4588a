"""Media with a free form: a spring, a dashpot and any number of Kelvin-Voigt elements in series."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from viscorough.basics import units
from viscorough.basics.arrays import ReadOnlyArrays, increasing, read_only, real_number, real_numbers
from viscorough.basics.summaries import span
from viscorough.basics.types import Array
from viscorough.media.free_form import Fit, fit_creep, fit_relaxation
from viscorough.media.load import Load
from viscorough.media.medium import check_misfit, checked_times
from viscorough.media.spectra import (
    RelaxationSpectrum,
    RetardationSpectrum,
    Spectrum,
    relaxation_spectrum,
    retardation_spectrum,
    solvable,
)
from viscorough.media.springs_and_dashpots import SpringsAndDashpots

# A table is refused if the misfit of its medium exceeds _SYSTEMATIC and the errors are systematic: their root mean
# square is more than _BEYOND_SCATTER times the scatter of the table. The scatter follows from the second differences of
# the errors, for tables of at least _ROWS_FOR_SCATTER rows.
_SYSTEMATIC, _BEYOND_SCATTER, _ROWS_FOR_SCATTER = 0.01, 2.0, 8
# An error up to this multiple of the scatter of a table is noise of this row.
_OUTLIER = 5.0


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
        Retardation time θ_j > 0 of each element, shape (elements,). Elements of the same time become one element.
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
        if not (np.isfinite(times).all() and (times > 0).all()):
            raise ValueError("FreeForm: retardation_times; allowed: finite numbers above 0")
        times, place = np.unique(times, return_inverse=True)  # elements of the same time are a single element
        compliances = np.bincount(place, compliances, times.size)
        for name, value in (single | {"last_time": float(self.last_time)}).items():
            object.__setattr__(self, name, value)
        object.__setattr__(self, "compliances", read_only(compliances))
        object.__setattr__(self, "retardation_times", read_only(times))
        self._check_spectra()

    @cached_property
    def retardation(self) -> RetardationSpectrum:
        """Return the spectrum of J, with a negligible spring or dashpot if motions need it (spectra.solvable)."""
        times, last = self.retardation_times, self.last_time
        first = self.first_time or (float(times.min()) if times.size else 1.0)
        given = RetardationSpectrum(self.instantaneous_compliance, self.fluidity, self.compliances, times)
        return solvable(given, first, last if np.isfinite(last) else 1.0)

    @cached_property
    def relaxation(self) -> RelaxationSpectrum:
        return relaxation_spectrum(self.retardation)

    def creep_compliance(self, time: ArrayLike) -> Array:
        """Return J at times t ≥ 0, an array of any shape; nan at times at which it is not known."""
        time = checked_times(time)
        elements = self.compliances * np.expm1(-np.divide.outer(time, self.retardation_times))
        values = self.instantaneous_compliance + self.fluidity * time - elements.sum(axis=-1)
        return np.where((time >= self.first_time) & (time <= self.last_time), values, np.nan)


def free_form_of(relaxation: RelaxationSpectrum, first_time: float = 0.0, last_time: float = np.inf) -> FreeForm:
    """Return the FreeForm with a given spectrum of ψ: one that consists of springs and at least one branch."""
    instantaneous, fluidity, compliances, times = retardation_spectrum(relaxation)
    return FreeForm(instantaneous, fluidity, compliances, times, first_time, last_time)


class _Table(ReadOnlyArrays, SpringsAndDashpots):
    """Base class of media that are fitted to a table. `free_form` is the fitted medium, and `errors` are its errors."""

    times: np.ndarray
    free_form: FreeForm
    errors: np.ndarray

    def _fit(self, fit: Fit, times: Array, medium: FreeForm) -> None:
        """Store the fitted medium. Raises ValueError if the fit misses the table by more than its scatter."""
        name, errors = type(self).__name__, np.abs(fit.errors)
        check_misfit(name, times, np.where(errors > _OUTLIER * _scatter(fit.errors), errors, 0.0))
        if errors.max() > _SYSTEMATIC and np.sqrt(np.mean(errors**2)) > _BEYOND_SCATTER * _scatter(fit.errors):
            raise ValueError(
                f"{name}: springs and dashpots miss it by {100 * errors.max():.2g} % at time "
                f"{times[errors.argmax()]:g}, which is more than its scatter; allowed: tables of a medium that relaxes"
            )
        object.__setattr__(self, "free_form", medium)
        object.__setattr__(self, "errors", read_only(errors))

    @property
    def first_time(self) -> float:
        return float(self.times[0])

    @property
    def last_time(self) -> float:
        return float(self.times[-1])

    @property
    def relaxation(self) -> RelaxationSpectrum:
        return self.free_form.relaxation

    @cached_property
    def retardation(self) -> RetardationSpectrum:
        return self.free_form.retardation

    def creep_compliance(self, time: ArrayLike) -> Array:
        """Return the fitted J at times t ≥ 0, an array of any shape; nan before the first and after the last row."""
        return self.free_form.creep_compliance(time)

    def spectrum(self, load: Load) -> tuple[Spectrum, float]:
        """Return the fitted springs and dashpots, and their largest relative misfit of the rows during the load."""
        return super().spectrum(load)[0], float(self.errors[self.times <= max(load.duration, self.times[0])].max())


@dataclass(frozen=True, repr=False)
class CreepTable(_Table):
    """A medium with a measured creep compliance J: springs and dashpots that are fitted to a table.

    The fit has a spring, a dashpot and Kelvin-Voigt elements with non-negative compliances, which every medium that
    relaxes has. It smooths noise, and is more accurate than straight lines between the rows. J is not known before the
    first and after the last row. The arrays are copied.

    Parameters
    ----------
    times : array
        Times of the rows, which increase from 0 or from a later time, shape (rows,).
    compliances : array
        J at the times of the rows, shape (rows,); at time 0 this is J(0+). Noise may make it decrease.

    Raises
    ------
    ValueError
        Unless there are two or more rows with finite values, and at least one J above 0. If the fit misses a row by
        more than 10 %, or by more than 1 % and more than the scatter of the table explains. No relaxing medium has such
        a J.

    Examples
    --------
    >>> import viscorough
    >>> table = viscorough.CreepTable([0.0, 1.0, 10.0], [0.2, 0.5, 0.9])
    >>> round(float(table.creep_compliance(1.0)), 9)
    0.5
    """

    times: np.ndarray
    compliances: np.ndarray

    def __repr__(self) -> str:
        """Return a summary, without the arrays: the number of rows, and the ranges of times and J."""
        return f"CreepTable of {len(self.times)} points, t {span(self.times)}, J {span(self.compliances)}"

    def __post_init__(self) -> None:
        times, values = _rows(self, "compliances", "1/Pa")
        fit = fit_creep(times, values)
        spectrum = fit.first, fit.second, fit.strengths, fit.times
        self._fit(fit, times, FreeForm(*spectrum, float(times[0]), float(times[-1])))


@dataclass(frozen=True, repr=False)
class RelaxationTable(_Table):
    """A medium with a measured relaxation modulus ψ: springs and dashpots that are fitted to a table.

    The fit has a spring and Maxwell branches with non-negative moduli; see CreepTable. A parallel dashpot cannot be
    found, because its pulse η δ(t) is at time 0 only. Parts of the medium that relax before the first row or after the
    last row are not known, so rows over a long time are needed.

    Parameters
    ----------
    times : array
        Times of the rows, which increase from 0 or from a later time, shape (rows,).
    moduli : array
        ψ at the times of the rows, shape (rows,). Noise may make it increase.

    Raises
    ------
    ValueError
        See CreepTable.

    Examples
    --------
    >>> import numpy as np
    >>> from viscorough.media.table import RelaxationTable
    >>> times = np.geomspace(0.01, 100, 40)
    >>> table = RelaxationTable(times, 1 + 3 * np.exp(-times / 0.5))  # a standard linear solid
    >>> round(float(table.creep_compliance(100.0)), 6)
    1.0
    """

    times: np.ndarray
    moduli: np.ndarray

    def __repr__(self) -> str:
        """Return a summary, without the arrays: the number of rows, and the ranges of times and ψ."""
        return f"RelaxationTable of {len(self.times)} points, t {span(self.times)}, ψ {span(self.moduli)}"

    def __post_init__(self) -> None:
        times, values = _rows(self, "moduli", "Pa")
        fit = fit_relaxation(times, values)
        relaxation = fit.relaxation
        if not fit.times.size:  # a single spring: see spectra.solvable
            medium = FreeForm(1 / fit.first, 0.0, [], [], float(times[0]), float(times[-1]))
        else:
            medium = free_form_of(relaxation, float(times[0]), float(times[-1]))
        self._fit(fit, times, medium)


def _rows(table: _Table, name: str, unit: str) -> tuple[Array, Array]:
    """Return times and values of a table as arrays of floats, and store them.

    name, unit : name of the values, and their SI unit
    """
    kind = type(table).__name__
    times = increasing(f"{kind}: times", units.numbers(table.times, "s", "m", f"{kind}: times"))
    values = units.numbers(getattr(table, name), unit, "m", f"{kind}: {name}")
    if times[0] < 0 or times.size < 2:
        raise ValueError(f"{kind}: times: {times.size}, from {times[0]:g} on; allowed: two or more, from 0 on")
    if values.shape != times.shape:
        raise ValueError(
            f"{kind}: {name} of shape {values.shape}; allowed: a number for each time, shape {times.shape}"
        )
    if not np.isfinite(values).all() or not values.max() > 0:
        raise ValueError(f"{kind}: {name} {span(values)}; allowed: finite numbers, at least one of them above 0")
    for field, array in (("times", times), (name, values)):
        object.__setattr__(table, field, read_only(array))
    return times, values


def _scatter(errors: Array) -> float:
    """Return the standard deviation of the noise in the errors of a fit; 0 for a table of few rows."""
    if errors.size < _ROWS_FOR_SCATTER:
        return 0.0
    return float(np.sqrt(np.mean(np.diff(errors, 2) ** 2) / 6))
