"""Options of the contact solver: how a contact is computed."""

from dataclasses import dataclass, fields

from viscorough.arrays import real_number, shown, whole_number

# The first set leaves out elements that touch in this last part of a step from the unloaded state (in a smaller part of
# smaller steps): the load of elements that touch before bends the surface away from them.
LATE = 0.5


@dataclass(frozen=True)
class SolverOptions:
    """Options of the contact solver. The defaults suit every indenter; other values serve to measure the effect of a
    part.

    Parameters
    ----------
    precision : str
        "single" or "double": floating-point type of the iterations on the grid. They compute corrections to the
        predicted contact, so rounding to single precision stays far below the tolerance.
    exact_gap_below : float
        Tolerance below which the gap is recomputed in double precision when the bound on its rounding error nears the
        tolerance; 0: the gap is never recomputed.
    operator_rounding : float
        Bound on the rounding error of one application of the half-space operator, over the largest deflection and the
        machine precision; 0: rounding is ignored.
    max_iterations : int
        Largest number of iterations of one level; beyond it ConvergenceError is raised.
    dense_contacts : int
        Largest number of elements in contact for a dense solution of a level.
    dense_interactions : int
        Largest product, for a dense solution of a level, of the number of elements that can be in contact and the
        number of elements in contact at the level before.
    padding : bool
        Pad the grid against periodic images; without padding the indenter repeats at its own period.

    Raises
    ------
    ValueError
        For other texts, for negative numbers, and for max_iterations below 1.

    Examples
    --------
    >>> import viscorough
    >>> disc = viscorough.self_affine_disc(0.7, 17, rms=0.01, seed=1)
    >>> double = viscorough.SolverOptions(precision="double")
    >>> viscorough.indent(disc, depths=[0.005], options=double).depth.tolist()
    [0.005]
    """

    precision: str = "single"
    exact_gap_below: float = 1e-4
    operator_rounding: float = 5.0
    max_iterations: int = 2000
    dense_contacts: int = 400
    dense_interactions: int = 1_000_000
    padding: bool = True

    def __repr__(self) -> str:
        """Show the call that makes these options, without default values."""
        given = {field.name: getattr(self, field.name) for field in fields(self)}
        changed = [f"{name}={given[name]!r}" for name in given if given[name] != getattr(SolverOptions, name)]
        return f"SolverOptions({', '.join(changed)})"

    def __post_init__(self) -> None:
        if not isinstance(self.precision, str) or self.precision not in ("single", "double"):
            raise ValueError(f"precision: must be one of single, double, not {shown(self.precision)}")
        for name in ("exact_gap_below", "operator_rounding"):
            number = real_number(name, getattr(self, name))
            if not number >= 0:
                raise ValueError(f"{name}: must not be negative, not {number!r}")
            object.__setattr__(self, name, number)
        for name, least in (("max_iterations", 1), ("dense_contacts", 0), ("dense_interactions", 0)):
            object.__setattr__(self, name, whole_number(name, getattr(self, name), least))
        if not isinstance(self.padding, bool):
            raise ValueError(f"padding: must be True or False, not {shown(self.padding)}")


DEFAULT = SolverOptions()
