"""The loading curve, the common result of all contact computations.

The elastic loading curve determines the solution of the viscous problem (paper, Eqs. 1-3): other forces, viscosities
and times only rescale it.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from viscorough.basics import units
from viscorough.basics.arrays import ReadOnlyArrays, increasing, read_only
from viscorough.basics.summaries import span, unit_power
from viscorough.basics.types import Array, Integers, Pair, Scalar

# Allowed relative rounding error of forces and depths.
_ROUNDING = 1e-12
# Rounding error of the difference of two depths, over the larger depth.
_CANCELLATION = 4 * np.finfo(float).eps
# Halvings of the interval between two levels that find a force to rounding, if their forces differ by up to 1e10.
_HALVINGS = 90


# Optional arrays over levels that state the error of the grid.
_GRID_QUANTITIES = ("grid_error", "force_grid_error", "area_change")


@dataclass(frozen=True)
class LoadingCurve(ReadOnlyArrays):
    """Depth, force and tangent stiffness of a rigid indenter pressed into an elastic half-space, at successive levels.

    Arrays are copied and read-only. If G is replaced by the viscosity η and F by ∫F dt, the curve is the solution of
    the linearly viscous problem (Radok; paper, Sec. III).

    Attributes
    ----------
    depth : array
        Depth u from first contact, strictly increasing and positive, shape (levels,) [length].
    force : array
        Force F/G, with G the shear modulus of the incompressible half-space, shape (levels,) [length²].
    stiffness : array
        Tangent stiffness k/G = d(F/G)/du of the elements in contact at the level, shape (levels,) [length].
    contact_count : array
        Number of elements in contact, shape (levels,) [1].
    elements : int
        Number of elements of the indenter.
    method : str
        Method that computed the curve.
    tolerance : float
        Requested relative accuracy [1].
    operator_applications : int
        Number of applications of the half-space operator on the grid.
    residual : array
        Largest remaining gap in contact, or overlap outside it, over the depth, shape (levels,) [1].
    length_unit : str
        Unit of the lengths, as UDUNITS spells it; "1" if it is not known.
    grid_error : array
        Estimated relative error of the velocity due to the spacing of the map, at the force of each level, shape
        (levels,) [1]. This and the four following quantities are None unless they were requested;
        `viscorough.contact.grid_error` has the formulas.
    force_grid_error : array
        Estimated relative error of the force due to the spacing, at the depth of each level, counted from the highest
        point of the map, shape (levels,) [1].
    area_change : array
        Relative change of the contact area when the spacing of the map is halved, shape (levels,) [1]. The contact area
        of a rough surface has no limit and therefore no error.
    mean_grid_error, mean_area_change : float
        Means of `grid_error` and `area_change` over all forces from F/G = hL/25 on, with the rms height h of the map
        and the diameter L of a disc of its area, or over the last decade if the curve ends before 0.4 hL.
    sampling : int
        n for a curve on every n-th point of the map in both directions. Depths are counted from the highest point of
        the full map.
    choice : str
        Reason for the sampling and the tolerance, if they were chosen to meet a requested error.

    Raises
    ------
    ValueError
        For a curve without levels, for depths or forces that do not increase or are not finite, and for stiffnesses
        that are not finite and positive.

    Examples
    --------
    >>> import viscorough
    >>> disc = viscorough.self_affine_disc(0.7, 17, rms=0.01, seed=1)
    >>> curve = viscorough.indent(disc)
    >>> depth, stiffness = curve.at_force(curve.force[-1])
    >>> bool(abs(depth / curve.depth[-1] - 1) < 1e-12)
    True
    """

    depth: np.ndarray
    force: np.ndarray
    stiffness: np.ndarray
    contact_count: np.ndarray
    elements: int
    method: str
    tolerance: float
    operator_applications: int
    residual: np.ndarray
    length_unit: str = "1"
    grid_error: np.ndarray | None = None
    force_grid_error: np.ndarray | None = None
    area_change: np.ndarray | None = None
    mean_grid_error: float | None = None
    mean_area_change: float | None = None
    sampling: int = 1
    choice: str = ""

    def __post_init__(self) -> None:
        super().__post_init__()
        for name in ("depth", "force"):
            values = increasing(f"loading curve: {name}", getattr(self, name), above_zero=True)
            object.__setattr__(self, name, read_only(values))
        grid_quantities = [name for name in _GRID_QUANTITIES if getattr(self, name) is not None]
        for name in ("force", "stiffness", "contact_count", "residual", *grid_quantities):
            if (shape := getattr(self, name).shape) != self.depth.shape:
                text = f"loading curve: {name} has the shape {shape} and depth {self.depth.shape}"
                raise ValueError(f"{text}; one value for each level is needed")
            if not np.isfinite(getattr(self, name)).all():
                raise ValueError(f"loading curve: {name} must be finite")
        for name in (*grid_quantities, "mean_grid_error", "mean_area_change"):
            value, least = getattr(self, name), -1 if name.endswith("change") else 0
            if value is not None and not ((value >= least) & np.isfinite(value)).all():
                raise ValueError(f"loading curve: {name} must be finite and not below {least}")
        if not (self.stiffness > 0).all():
            raise ValueError("loading curve: stiffness must be finite and positive")
        if self.sampling < 1:
            raise ValueError("loading curve: sampling must be a whole number from 1 on")
        if self.elements < 1 or not 0 <= self.tolerance < np.inf:
            text = f"{self.elements} elements and a tolerance of {self.tolerance:g}"
            raise ValueError(f"loading curve: {text}; at least 1 and a finite number from 0 on are needed")

    def __str__(self) -> str:
        """Return a summary: method and levels; ranges of depth, force, stiffness and contact fraction; grid error."""
        unit, levels = self.length_unit, self.depth.size
        lines = [
            f"Loading curve by {self.method}: {levels} level{'s' * (levels > 1)}, {self.elements} elements",
            f"depth u {span(self.depth, unit)}, force F/G {span(self.force, unit_power(unit, 2))}, "
            f"stiffness k/G {span(self.stiffness, unit)}",
            f"contact fraction {span(self.contact_fraction)}",
            self.choice,
            self.grid_error_text,
        ]
        return "\n".join(filter(None, lines))

    @property
    def contact_fraction(self) -> Array:
        """Return the share of the indenter's elements that are in contact, shape (levels,) [1]."""
        return self.contact_count / self.elements

    @property
    def grid_error_text(self) -> str:
        """Return the error of the grid and its meaning in one line; "" if it was not requested."""
        if self.mean_grid_error is None or self.mean_area_change is None:
            return ""
        grid = "a scan" if self.sampling == 1 else "a sampling"
        return (
            f"grid error about {100 * self.mean_grid_error:.2g} %: {grid} twice as fine would change the velocity by "
            f"about that; the contact area changes by {100 * self.mean_area_change:.2g} % when the spacing is halved"
        )

    @property
    def starts_straight(self) -> bool:
        """Return True if the tangent of the first level passes through the origin, as for contacts of one height."""
        return bool(abs(self.force[0] - self.stiffness[0] * self.depth[0]) <= _ROUNDING * self.force[0])

    def normalised(self, rms: Scalar, diameter: Scalar) -> tuple[Array, Array]:
        """Return X = F/(4GhL) and κ = k/(4GL) (paper, Eq. 3), for rms height h and diameter L, of shape (levels,)."""
        unit = self.length_unit
        rms, diameter = units.number(rms, unit, unit, "rms"), units.number(diameter, unit, unit, "diameter")
        if not (rms > 0 and diameter > 0):
            raise ValueError(f"normalised: rms {rms:g}, diameter {diameter:g}; numbers above 0 are needed")
        return self.force / (4 * rms * diameter), self.stiffness / (4 * diameter)

    def at_force(self, force: "ArrayLike") -> tuple[Array, Array]:
        """Interpolate depth u and stiffness k/G at given forces F/G; nan beyond the last level.

        If at most one element joins the contact between two levels, the curve consists of the two tangents, exactly.
        Otherwise ln u is a cubic Hermite interpolant in ln F, which is exact for a power law. Since F(u) is convex, the
        interpolant is kept inside the triangle of chord and tangents.

        Before the first level the curve is a straight line through the origin if all elements in contact there have one
        height, so that the tangent passes through the origin. Otherwise depth and stiffness are nan, but the depth at
        zero force is zero.

        Parameters
        ----------
        force : array_like
            Forces F/G, any shape [length²].

        Returns
        -------
        depth, stiffness : array
            u and k/G, both of the shape of `force` [length].
        """
        unit = self.length_unit
        force = units.numbers(force, unit_power(unit, 2), unit, "force")
        # A force computed back from a level may miss it by rounding.
        for end in (self.force[0], self.force[-1]):
            force = np.where(np.abs(force - end) <= _ROUNDING * end, end, force)
        depth, stiffness = np.full(force.shape, np.nan), np.full(force.shape, np.nan)

        first = (force >= 0) & (force <= self.force[0]) if self.starts_straight else force == self.force[0]
        depth[first] = force[first] / self.force[0] * self.depth[0]
        stiffness[first] = self.stiffness[0]
        depth[force == 0] = 0.0

        inside = (force > self.force[0]) & (force <= self.force[-1])
        between = self._levels_around(np.searchsorted(self.force, force[inside]))
        depth[inside], stiffness[inside] = interpolate_between(*between, force[inside])
        return depth, stiffness

    def at_depth(self, depth: "ArrayLike") -> tuple[Array, Array]:
        """Interpolate force F/G and stiffness k/G at given depths u; nan beyond the last level.

        This is the inverse function of `at_force`. Before the first level force and stiffness are nan if `at_force`
        gives nan, but the force at zero depth is zero.

        Parameters
        ----------
        depth : array_like
            Depths u, any shape [length].

        Returns
        -------
        force, stiffness : array
            F/G [length²] and k/G [length], both of the shape of `depth`.

        Examples
        --------
        >>> import viscorough
        >>> disc = viscorough.self_affine_disc(0.7, 17, rms=0.01, seed=1)
        >>> curve = viscorough.indent(disc)
        >>> force, stiffness = curve.at_depth(0.01)
        >>> round(float(curve.at_force(force)[0]), 9)
        0.01
        """
        depth = units.numbers(depth, self.length_unit, self.length_unit, "depth")
        # A depth computed back from a level may miss it by rounding.
        for end in (self.depth[0], self.depth[-1]):
            depth = np.where(np.abs(depth - end) <= _ROUNDING * end, end, depth)
        force = np.full(depth.shape, np.nan)
        first = (depth >= 0) & (depth <= self.depth[0])
        force[first] = depth[first] / self.depth[0] * self.force[0]
        inside = (depth > self.depth[0]) & (depth <= self.depth[-1])
        j = np.searchsorted(self.depth, depth[inside])
        between, low, high = self._levels_around(j), self.force[j - 1], self.force[j]
        for _ in range(_HALVINGS):
            middle = 0.5 * (low + high)
            is_below = interpolate_between(*between, middle)[0] < depth[inside]
            low, high = np.where(is_below, middle, low), np.where(is_below, high, middle)
        force[inside] = np.where(depth[inside] == self.depth[j], self.force[j], high)
        at_force, stiffness = self.at_force(force)
        return np.where(np.isnan(at_force), np.nan, force), stiffness

    def _levels_around(self, after: Integers) -> tuple[Pair, Pair, Pair, Array]:
        """Return pairs of forces, depths and stiffnesses at two successive levels, and the number of joining elements.

        after : indices of the second levels
        """
        forces, depths, stiffnesses = ((at[after - 1], at[after]) for at in (self.force, self.depth, self.stiffness))
        return forces, depths, stiffnesses, self.contact_count[after] - self.contact_count[after - 1]


def check_curve(caller: str, curve: object) -> None:
    """Raise TypeError, which starts with the caller, for anything but a LoadingCurve, such as a path or an Indenter."""
    if not isinstance(curve, LoadingCurve):
        text = "a LoadingCurve is needed, as viscorough.indent, reduce or load_curve returns it"
        raise TypeError(f"{caller}: {type(curve).__name__}; {text}")


def interpolate_between(
    forces: Pair, depths: Pair, stiffnesses: Pair, joined: Any, force: Array
) -> tuple[Array, Array]:
    """Return depth and tangent stiffness at forces between two levels, as LoadingCurve.at_force.

    forces, depths, stiffnesses : pairs of values at the first and at the second level, numbers or arrays of shape (n,)
    joined : number of elements that join the contact between the levels, number or array of shape (n,)
    force : forces F/G between the levels, shape (n,) [length²]

    Returns (depth, stiffness), both of shape (n,).
    """
    (f0, f1), (u0, u1), (k0, k1) = forces, depths, stiffnesses
    # Far below the second level its tangent is inaccurate, by rounding. Then it must not be the lower tangent.
    left, right = u0 + (force - f0) / k0, u1 - (f1 - force) / k1 + _CANCELLATION * u1
    is_left = left <= right
    tangents = np.clip(np.minimum(left, right), u0, u1)
    chord = u0 + (u1 - u0) * (force - f0) / (f1 - f0)
    cubic, cubic_stiffness = _hermite_in_logarithms(force, forces, depths, stiffnesses)
    tangent_stiffness = np.where(is_left & (force < f1), k0, k1)

    # Use the tangents if at most one element joined, otherwise the cubic or the side of the triangle that it crosses.
    on_tangents = ((joined >= 0) & (joined <= 1)) | (cubic > tangents * (1 + 1e-12))
    where = [on_tangents, cubic < chord * (1 - 1e-12)]
    stiffness = np.select(where, [tangent_stiffness, (f1 - f0) / (u1 - u0)], cubic_stiffness)
    return np.select(where, [tangents, chord], cubic), stiffness


def _hermite_in_logarithms(force: Array, forces: Pair, depths: Pair, stiffnesses: Pair) -> tuple[Array, Array]:
    """Return depth and stiffness of the cubic Hermite interpolant of ln u over ln F between two levels."""
    (f0, f1), (u0, u1), (k0, k1) = forces, depths, stiffnesses
    span = np.log(f1 / f0)
    x = np.log(force / f0) / span
    slope0, slope1 = f0 / (k0 * u0), f1 / (k1 * u1)
    rise = np.log(u1 / u0)
    c2 = 3 * rise - span * (2 * slope0 + slope1)
    c3 = span * (slope0 + slope1) - 2 * rise
    cubic = u0 * np.exp(x * (span * slope0 + x * (c2 + x * c3)))
    local_slope = slope0 + x * (2 * c2 + 3 * x * c3) / span
    with np.errstate(divide="ignore", invalid="ignore"):
        return cubic, np.minimum(np.maximum(force / (cubic * local_slope), k0), k1)
