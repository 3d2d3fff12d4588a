"""Result type of `identify_medium`: a medium, its confidence intervals, and the error of the zero of the depth."""

import dataclasses
from dataclasses import dataclass

import numpy as np

from viscorough.basics import units
from viscorough.basics.argument_names import argument
from viscorough.basics.arrays import ReadOnlyArrays
from viscorough.basics.summaries import si_unit, span, with_unit
from viscorough.media.medium import Medium


@dataclass(frozen=True)
class IdentifiedMedium(ReadOnlyArrays):
    """A medium that `identify_medium` identified from a measured record.

    Attributes
    ----------
    medium : Medium
        Medium of the requested kind: a FreeForm for a table, a Prony series or a springpot.
    time : array
        Time 0, and the times at which J or ψ was determined, shape (times,).
    compliance : array
        Creep compliance J at the times of `time`, for every kind of `medium`.
    relaxation_modulus : array or None
        Relaxation modulus ψ at the times of `time` if the force was measured; None if the depth was measured.
    low, high : array
        Ends of the 95 % interval at each time: of J if the depth was measured, of ψ if the force was measured. Before
        the first row of the record, `low` is 0 for J, and `high` is infinite for ψ. Both arrays are nan if the scatter
        is not known.
    scatter : float
        Standard deviation of the measured depth [length] or force, as given by the user or as found from the record;
        nan if it is not known.
    misfit : float
        Root mean square of the difference between the measured values and the values that follow from `medium`.
    offset, drift : float
        Error of the zero of the depth [length], and the rate at which this error drifts [length/time]; nan if not
        fitted.
    offset_interval, drift_interval : array
        Ends of the 95 % intervals of `offset` and `drift`, shape (2,); nan if not known.
    assumed_offset : float
        Error of the zero of the depth that `offset_effect` assumes [length]: the scatter of the depth, or 0.1 % of the
        largest depth if the scatter is not known; nan if `offset` was fitted.
    offset_effect : float
        Largest relative error of J, at times from the first to the last row of the record, if the zero of the depth is
        wrong by `assumed_offset`.
    length_unit : str
        Unit of the depth. If it is known, moduli are in Pa, times in s and forces in N.

    Examples
    --------
    >>> import numpy as np
    >>> import viscorough
    >>> curve = viscorough.indent(viscorough.self_affine_disc(0.8, 17, rms=1e-6, diameter=1e-4, seed=1))
    >>> record = viscorough.kinetics(curve, 5e-6, 1e6, np.geomspace(0.1, 100, 50))
    >>> identified = viscorough.identify_medium(curve, 5e-6, record.time, record.depth, scatter=1e-9)
    >>> print(f"{1e6 * identified.low[-1]:.1f} to {1e6 * identified.high[-1]:.1f}")
    99.9 to 100.1
    """

    medium: Medium
    time: np.ndarray
    compliance: np.ndarray
    relaxation_modulus: np.ndarray | None
    low: np.ndarray
    high: np.ndarray
    scatter: float
    misfit: float
    offset: float = np.nan
    offset_interval: np.ndarray = dataclasses.field(default_factory=lambda: np.full(2, np.nan))
    drift: float = np.nan
    drift_interval: np.ndarray = dataclasses.field(default_factory=lambda: np.full(2, np.nan))
    assumed_offset: float = np.nan
    offset_effect: float = np.nan
    length_unit: str = units.UNKNOWN

    def __str__(self) -> str:
        """Return a summary: kind of medium, ranges of times and J (and ψ), scatter, misfit, and zero of the depth."""
        unit = self.length_unit
        text = (
            f"{type(self.medium).__name__} identified from a record of {self.measured}\n"
            f"time t {span(self.time, si_unit('s', unit))}\n"
            f"compliance J {span(self.compliance, si_unit('1/Pa', unit))}\n"
        )
        if self.relaxation_modulus is not None:
            text += f"relaxation modulus ψ {span(self.relaxation_modulus, si_unit('Pa', unit))}\n"
        return f"{text}{self.quality}\n{self.zero_of_depth}"

    @property
    def measured(self) -> str:
        """Return the name of the measured quantity, "depth" or "force"."""
        return "depth" if self.relaxation_modulus is None else "force"

    @property
    def quality(self) -> str:
        """Return one line that states the scatter of the record and the misfit of the medium."""
        name, shown = self.measured, "J" if self.measured == "depth" else "ψ"
        unit = self.length_unit if name == "depth" else si_unit("N", self.length_unit)
        if np.isnan(self.scatter):
            scatter = f"scatter of {name} unknown, so that {shown} has no intervals ({argument('scatter')} states it)"
        else:
            scatter = f"scatter of {name} {with_unit(self.scatter, unit, 3)}"
        return f"{scatter}, misfit of the medium {with_unit(self.misfit, unit, 3)} (rms)"

    @property
    def zero_of_depth(self) -> str:
        """Return one line that states offset and drift of the depth, or the effect of an offset that was not fitted."""
        unit = self.length_unit
        rate = unit if unit == units.UNKNOWN else f"{unit} s-1"
        texts = []
        for name, number, ends, shown_unit in (
            ("offset", self.offset, self.offset_interval, unit),
            ("drift", self.drift, self.drift_interval, rate),
        ):
            if not np.isnan(number):
                interval = "" if np.isnan(ends).any() else f" [{ends[0]:.3g}, {ends[1]:.3g}]"
                texts.append(f"{name} of the depth {with_unit(number, shown_unit, 3)}{interval}")
        if np.isnan(self.offset):
            texts.append(
                f"an error of {with_unit(self.assumed_offset, unit, 3)} of the zero of the depth, which was not "
                f"fitted, would change J by up to {100 * self.offset_effect:.2g} %"
            )
        return ", ".join(texts)
