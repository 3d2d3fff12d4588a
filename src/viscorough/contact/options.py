"""Define the options of the contact solver."""

from dataclasses import dataclass, fields

from viscorough.basics.arrays import real_number, shown, whole_number

# A step Δu to the depth u starts from a guess of the contact set. The guess leaves out elements that are predicted to
# touch late in the step, because elements that touch earlier will push the surface away from them. "Late" means in the
# last share LATE · Δu/u of the step.
LATE = 0.5


@dataclass(frozen=True)
class SolverOptions:
    """Options of the contact solver.

    The defaults suit every indenter. Change an option only to measure the effect of a part of the solver.

    Parameters
    ----------
    precision : str
        Floating-point type of the iterations on the grid, "single" or "double". The iterations compute corrections to
        the predicted contact, so rounding to single precision stays far below the tolerance.
    exact_gap_below : float
        If the tolerance is below this value, the gap is recomputed in double precision as soon as the bound on its
        rounding error comes close to the tolerance. With 0 the gap is never recomputed.
    operator_rounding : float
        Bound on the rounding error of one application of the half-space operator, as a multiple of the largest
        deflection times the machine precision. With 0 this rounding error is ignored.
    max_iterations : int
        Largest number of iterations for one contact. ConvergenceError is raised if these do not suffice.
    dense_contacts : int
        Contacts of up to this number of elements are solved directly, with a dense matrix, instead of on a grid.
    dense_interactions : int
        A contact is solved with a dense matrix only if a product of two numbers is at most this: the number of
        elements that can touch at its depth, and the number of elements in contact at the depth solved before.
    padding : bool
        True to pad the grid with zeros, as a single indenter requires. Without padding, the grid is repeated
        periodically without space between the images, and the loads of all images act on the indenter.
    max_depths : int
        Largest number of depths that are solved to find the contact at a force. ConvergenceError is raised if these do
        not suffice.
    rank_first : int
        Before the first contact at a force, about this number of elements is sorted by height ("ranked"), from the
        highest element on. On maps of fewer elements, all are ranked at once.
    rank_all_for_curves : int
        Before the computation of a curve, all elements are ranked if their number is at most this.
    rank_all_share : float
        As soon as a contact needs more than this share of the elements to be ranked, all elements are ranked.
    blocks_from : int
        If the map has more elements than this, the depth at a force is first estimated on a coarser map, in which each
        block of 4 x 4 elements is replaced by its highest element.
    blocks_in_contact : int
        The estimate is used only if at least this number of blocks is in contact.
    tiles_from : int
        If a grid has more elements than this, the operator may be restricted to those tiles (parts of the grid) that
        contain elements that can touch.
    tiles_share : float
        The operator is restricted only if these tiles are at most this share of the grid.

    Raises
    ------
    ValueError
        For an unknown `precision`, for negative numbers, and for max_iterations, max_depths or rank_first below 1.

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
        """Return the call that creates these options; options with default values are left out."""
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
