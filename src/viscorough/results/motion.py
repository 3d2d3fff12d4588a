"""Motion of an indenter: the result of everything that moves in time."""

from dataclasses import dataclass

import numpy as np

from viscorough.basics import units
from viscorough.basics.arrays import ReadOnlyArrays
from viscorough.basics.summaries import si_unit, span, with_unit


@dataclass(frozen=True)
class Motion(ReadOnlyArrays):
    """Motion of an indenter under a load; read-only arrays of shape (times,).

    Attributes
    ----------
    time : array
        Times t, in s if the unit of length is known, else in the unit of viscosity × length² / force.
    depth : array
        u [length]. Under no force it is not unique: the indenter then rests on the recovering surface.
    force : array
        F, in N if the unit of length is known.
    velocity : array
        v = du/dt [length/time], the limit after each time; before it at the last time of a history and before a step.
    contact_fraction : array
        Share of the elements of the indenter that are in contact [1].
    length_unit : str
        Unit of the lengths, as UDUNITS spells it; "1" if it is not known.
    receding_from : float
        Time from which the contact has receded, at first; nan if it only grows.

    Examples
    --------
    >>> import viscorough
    >>> disc = viscorough.self_affine_disc(0.7, 17, rms=0.01, seed=1)
    >>> solid = viscorough.StandardLinearSolid(4.0, 1.0, 0.5)
    >>> load = viscorough.Load([0.0, 1.0, 1.5, 2.0], force=[0.0, 0.1, 0.1, 0.0])
    >>> motion = viscorough.kinetics(viscorough.indent(disc), load, solid)
    >>> motion.receding_from
    1.5
    """

    time: np.ndarray
    depth: np.ndarray
    force: np.ndarray
    velocity: np.ndarray
    contact_fraction: np.ndarray
    length_unit: str = units.UNKNOWN
    receding_from: float = np.nan

    def __str__(self) -> str:
        """The first and last time, depth, force and velocity, and when the contact recedes."""
        unit = self.length_unit
        text = (
            f"Motion at {self.time.size} times\n"
            f"time t {span(self.time, si_unit('s', unit))}\n"
            f"depth u {span(self.depth, unit)}\n"
            f"force F {span(self.force, si_unit('N', unit))}\n"
            f"velocity v {span(self.velocity, si_unit(f'{unit} s-1', unit))}\n"
            f"contact fraction {span(self.contact_fraction)}"
        )
        if np.isnan(self.receding_from):
            return text
        return f"{text}\nthe contact recedes from time {with_unit(self.receding_from, si_unit('s', unit))} on"
