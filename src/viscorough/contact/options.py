"""Options of the contact solver: how a contact is computed."""

from dataclasses import dataclass, fields

from viscorough.basics.arrays import real_number, shown, whole_number

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
    max_depths : int
        Largest number of depths that are solved for a force; beyond it ConvergenceError is raised.
    rank_first : int
        Number of elements that are ranked before the first contact at a force; maps of fewer elements are ranked whole.
    rank_all_for_curves : int
        Largest number of elements that are all ranked before a curve.
    rank_all_share : float
        Share of the elements above which all are ranked as soon as a contact needs that many.
    blocks_from : int
        Number of elements above which the depth at a force is first estimated on a coarser map, of blocks of elements.
    blocks_in_contact : int
        Smallest number of blocks in contact for such an estimate.
    tiles_from : int
        Number of elements of a grid above which the operator may be restricted to tiles with elements in contact.
    tiles_share : float
        Largest share of these tiles in the grid for the restriction.

    Raises
    ------
    ValueError
        For other texts, for negative numbers, and for max_iterations, max_depths or rank_first below 1.

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
    max_depths: int = 100
    rank_first: int = 4096
    rank_all_for_curves: int = 131_072
    rank_all_share: float = 0.5
    blocks_from: int = 32_768
    blocks_in_contact: int = 20
    tiles_from: int = 262_144
    tiles_share: float = 0.5

    def __repr__(self) -> str:
        """Show the call that makes these options, without default values."""
        given = {field.name: getattr(self, field.name) for field in fields(self)}
        changed = [f"{name}={given[name]!r}" for name in given if given[name] != getattr(SolverOptions, name)]
        return f"SolverOptions({', '.join(changed)})"

    def __post_init__(self) -> None:
        if not isinstance(self.precision, str) or self.precision not in ("single", "double"):
            raise ValueError(f"precision: must be one of single, double, not {shown(self.precision)}")
        for name in ("exact_gap_below", "operator_rounding", "rank_all_share", "tiles_share"):
            number = real_number(name, getattr(self, name))
            if not number >= 0:
                raise ValueError(f"{name}: must not be negative, not {number!r}")
            object.__setattr__(self, name, number)
        for name in ("max_iterations", "max_depths", "rank_first"):
            object.__setattr__(self, name, whole_number(name, getattr(self, name), 1))
        numbers = "dense_contacts", "dense_interactions", "rank_all_for_curves"
        for name in (*numbers, "blocks_from", "blocks_in_contact", "tiles_from"):
            object.__setattr__(self, name, whole_number(name, getattr(self, name), 0))
        if not isinstance(self.padding, bool):
            raise ValueError(f"padding: must be True or False, not {shown(self.padding)}")


DEFAULT = SolverOptions()
