"""Define the motion of an indenter in time, the result of all computations with a load history."""

from dataclasses import dataclass

import numpy as np

from viscorough.basics.summaries import InNotebooks, si_unit, span, with_unit


@dataclass(frozen=True, eq=False)
class Motion(InNotebooks):
    """Motion of an indenter under a load. All arrays have the shape (times,).

    Attributes
    ----------
    time : array
        Times t [s].
    depth : array
        Depth u [length]. At zero force the depth is not unique: the indenter is assumed to rest on the recovering
        surface.
    force : array
        Force F [N].
    velocity : array
        Velocity v = du/dt [length/time]. If the velocity jumps at a time, this is the velocity just after the jump,
        except at the last time, and at the sample just before a step of the load. There it is the velocity just before
        the jump. On a map the velocity jumps whenever another element touches. While few elements touch, its graph is
        therefore a staircase (`drawstyle="steps-post"` in matplotlib).
    contact_fraction : array
        Share of the elements of the indenter that are in contact.
    length_unit : str
        "m" if numbers are in SI units, "1" if they are in consistent units that are not known.
    receding_from : float
        Time when the contact begins to recede for the first time; nan if the contact only grows.

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
    length_unit: str = "1"
    receding_from: float = np.nan

    def __repr__(self) -> str:
        """Return a summary: first and last value of each quantity, and the time from which the contact recedes."""
        unit = self.length_unit
        text = (
            f"Motion at {self.time.size} times\n"
            f"time t {span(self.time, si_unit('s', unit))}\n"
            f"depth u {span(self.depth, unit)}\n"
            f"force F {span(self.force, si_unit('N', unit))}\n"
            f"velocity v {span(self.velocity, si_unit('m s-1', unit))}\n"
            f"contact fraction {span(self.contact_fraction)}"
        )
        if np.isnan(self.receding_from):
            return text
        return f"{text}\nthe contact recedes from time {with_unit(self.receding_from, si_unit('s', unit))} on"
