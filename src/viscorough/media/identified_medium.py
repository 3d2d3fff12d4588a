"""The result of an identification: a medium, its intervals, and the errors of the zero of depth."""

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
    """A medium identified from a record, as `identify_medium` returns it.

    Attributes
    ----------
    medium : Medium
        Of the kind that was asked for.
    time : array
        0 and the times where J or ψ was determined, shape (times,).
    compliance : array
        Creep compliance J at these times, also if another kind than a table was fitted.
    relaxation_modulus : array or None
        Relaxation modulus ψ at these times, if the force was measured; None if the depth was.
    low, high : array
        Ends of the 95 % interval at each time, of J if the depth was measured, of ψ if the force was. Before the first
        row J has no lower limit but 0, and ψ no upper one. Both are nan if the scatter is not known.
    scatter : float
        Standard deviation of the measured depth [length] or force, as given or as found from the record; nan if it is
        not known.
    misfit : float
        Root mean square of the difference between the measured values and those in `medium`.
    offset, drift : float
        Error of the zero of the depth [length] and its drift [length/time]; nan if they were not fitted.
    offset_interval, drift_interval : array
        Ends of their 95 % intervals, shape (2,); nan if they are not known.
    assumed_offset : float
        Error of the zero of the depth, which was not fitted, for which `offset_effect` is stated [length]: the scatter
        of the depth, or 0.1 % of the largest depth if the scatter is not known; nan if the offset was fitted.
    offset_effect : float
        Largest relative change of J between the first and the last row if the zero of the depth were off by this.
    length_unit : str
        Unit of the depth; if it is known, moduli are in Pa, times in s and forces in N.

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
        """Kind of medium, J over time, scatter, misfit, and errors of the zero of depth."""
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
        """Return scatter and misfit in words, on one line."""
        name, shown = self.measured, "J" if self.measured == "depth" else "ψ"
        unit = self.length_unit if name == "depth" else si_unit("N", self.length_unit)
        if np.isnan(self.scatter):
            scatter = f"scatter of {name} unknown, so that {shown} has no intervals ({argument('scatter')} states it)"
        else:
            scatter = f"scatter of {name} {with_unit(self.scatter, unit, 3)}"
        return f"{scatter}, misfit of the medium {with_unit(self.misfit, unit, 3)} (rms)"

    @property
    def zero_of_depth(self) -> str:
        """Return offset and drift of the depth in words, on one line."""
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
