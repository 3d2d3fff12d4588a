"""Define the loading curve: force and stiffness of an indenter as functions of its depth in an elastic half-space.

The elastic loading curve also determines the solution of the viscous problem (paper, Eqs. 1-3). A different force,
viscosity or time only rescales the curve.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from viscorough.basics.arrays import increasing, real_numbers
from viscorough.basics.summaries import InNotebooks, si_unit, span
from viscorough.basics.types import Array, Integers, Pair

# Allowed relative rounding error of forces and depths.
_ROUNDING = 1e-12
# Bound on the rounding error of the difference of two depths, relative to the larger depth.
_CANCELLATION = 4 * np.finfo(float).eps
# Number of bisections for the force at a given depth between two levels. With this number the force is exact to
# rounding, even if the forces of the two levels differ by a factor of up to 1e10.
_HALVINGS = 90


# Attributes of a LoadingCurve that describe the error of the grid: arrays with one value per level, or None.
_GRID_QUANTITIES = ("grid_error", "force_grid_error", "area_change")


@dataclass(frozen=True, eq=False)
class LoadingCurve(InNotebooks):
    """Depth, force and tangent stiffness of a rigid indenter pressed into an elastic half-space, at successive levels.

    A level is a computed point of the curve: one contact. If the shear modulus G is
    replaced by a viscosity η, and the force F by ∫F dt, the same curve describes an indenter in a linearly viscous
    half-space (Radok; paper, Sec. III).

    Attributes
    ----------
    depth : array
        Depth u from first contact, strictly increasing and positive, shape (levels,) [length].
    force : array
        Force F/G, with G the shear modulus of the incompressible half-space, shape (levels,) [length²].
    stiffness : array
        Tangent stiffness k/G = d(F/G)/du of the elements in contact, shape (levels,) [length].
    contact_count : array
        Number of elements in contact, shape (levels,).
    elements : int
        Number of elements of the indenter.
    method : str
        Method that computed the curve.
    tolerance : float
        Requested relative accuracy.
    operator_applications : int
        Number of times that the half-space operator was applied on the grid; a measure of the computing time.
    residual : array
        Largest remaining gap in contact or overlap outside the contact, divided by the depth, shape (levels,).
    length_unit : str
        "m" if numbers are in SI units, "1" if they are in consistent units that are not known.
    grid_error : array
        Estimated relative error of the viscous velocity due to the spacing of the map, at the force of each level,
        shape (levels,). This attribute and the next four attributes are None unless an estimate of the grid error
        was requested; `viscorough.contact.grid_error` has the formulas.
    force_grid_error : array
        Estimated relative error of the force due to the spacing, at the depth of each level, shape (levels,). The
        depth is counted from the highest point of the map.
    area_change : array
        Estimated relative change of the contact area when the spacing of the map is halved, shape (levels,). As the
        spacing decreases, the contact area of a rough surface approaches no limit, so it has no error.
    mean_grid_error, mean_area_change : float
        Means of `grid_error` and `area_change` over all forces F/G above hL/25. Here h is the rms height of the map,
        and L the diameter of a disc with the same area. If the curve ends at F/G < 0.4 hL, the means are over the last
        decade of force.

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

    def __post_init__(self) -> None:
        if self.length_unit not in ("m", "1"):
            raise ValueError(f"loading curve: length_unit {self.length_unit!r}; 'm' or '1' is needed")
        for name in ("depth", "force"):
            values = increasing(f"loading curve: {name}", getattr(self, name), above_zero=True)
            object.__setattr__(self, name, values)
        grid_quantities = [name for name in _GRID_QUANTITIES if getattr(self, name) is not None]
        for name in ("force", "stiffness", "contact_count", "residual", *grid_quantities):
            object.__setattr__(self, name, np.asarray(getattr(self, name)))
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
        if self.operator_applications < 0:
            raise ValueError("loading curve: operator_applications must not be negative")
        if self.elements < 1 or not 0 <= self.tolerance < np.inf:
            text = f"{self.elements} elements and a tolerance of {self.tolerance:g}"
            raise ValueError(f"loading curve: {text}; at least 1 and a finite number from 0 on are needed")

    def __repr__(self) -> str:
        """Return a summary: method, number of levels, first and last value of each quantity, and grid error."""
        unit, levels = self.length_unit, self.depth.size
        lines = [
            f"Loading curve by {self.method}: {levels} level{'s' * (levels > 1)}, {self.elements} elements",
            f"depth u {span(self.depth, unit)}, force F/G {span(self.force, si_unit('m2', unit))}, "
            f"stiffness k/G {span(self.stiffness, unit)}",
            f"contact fraction {span(self.contact_fraction)}",
            self.grid_error_text,
        ]
        return "\n".join(filter(None, lines))

    @property
    def contact_fraction(self) -> Array:
        """Return the share of the indenter's elements that are in contact, shape (levels,)."""
        return self.contact_count / self.elements

    @property
    def grid_error_text(self) -> str:
        """Return a line of text that states and explains the error of the grid, or "" if it was not estimated."""
        if self.mean_grid_error is None or self.mean_area_change is None:
            return ""
        return (
            f"grid error about {100 * self.mean_grid_error:.2g} %: a scan twice as fine would change the velocity by "
            f"about that; the contact area changes by {100 * self.mean_area_change:.2g} % when the spacing is halved"
        )

    @property
    def starts_straight(self) -> bool:
        """Return True if the tangent at the first level passes through the origin.

        This is the case if all elements in contact at the first level have the same height.
        """
        return bool(abs(self.force[0] - self.stiffness[0] * self.depth[0]) <= _ROUNDING * self.force[0])

    def at_force(self, force: "ArrayLike") -> tuple[Array, Array]:
        """Interpolate depth u and stiffness k/G at given forces F/G; nan beyond the last level.

        If at most one element comes into contact between two levels, the curve between them consists exactly of the
        tangents at both levels. Otherwise ln u is interpolated as a function of ln F by a cubic Hermite polynomial,
        which is exact for a power law. The true curve F(u) is convex, so it lies in the triangle of the chord and the
        two tangents. The interpolated curve is limited to this triangle.

        Before the first level the curve is a straight line through the origin, if the tangent at the first level passes
        through the origin (`starts_straight`). Otherwise depth and stiffness are nan, except that the depth is zero at
        zero force.

        Parameters
        ----------
        force : array_like
            Forces F/G, any shape [length²].

        Returns
        -------
        depth, stiffness : array
            Depths u and stiffnesses k/G, both in the shape of `force` [length].
        """
        force = real_numbers("force", force)
        # A force that differs only by rounding from the first or last force of the curve is replaced by this force.
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

        This function is the inverse of `at_force`. If `at_force` gives nan before the first level, force and stiffness
        are also nan before the first level, except that the force is zero at zero depth.

        Parameters
        ----------
        depth : array_like
            Depths u, any shape [length].

        Returns
        -------
        force, stiffness : array
            Forces F/G [length²] and stiffnesses k/G [length], both in the shape of `depth`.

        Examples
        --------
        >>> import viscorough
        >>> disc = viscorough.self_affine_disc(0.7, 17, rms=0.01, seed=1)
        >>> curve = viscorough.indent(disc)
        >>> force, stiffness = curve.at_depth(0.01)
        >>> round(float(curve.at_force(force)[0]), 9)
        0.01
        """
        depth = real_numbers("depth", depth)
        # A depth that differs only by rounding from the first or last depth of the curve is replaced by this depth.
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
        """Return forces, depths and stiffnesses at the levels around each point, and the number of joining elements.

        Forces, depths and stiffnesses are pairs: the values at the levels just before and just after the point of
        interpolation. Joining elements come into contact between these two levels.

        after : for each point of interpolation, index of the level just after the point
        """
        forces, depths, stiffnesses = ((at[after - 1], at[after]) for at in (self.force, self.depth, self.stiffness))
        return forces, depths, stiffnesses, self.contact_count[after] - self.contact_count[after - 1]


def check_curve(caller: str, curve: object) -> None:
    """Raise TypeError unless `curve` is a LoadingCurve.

    caller : name of the function that the user called; the message starts with it
    """
    if not isinstance(curve, LoadingCurve):
        text = "a LoadingCurve is needed, as viscorough.indent, reduce or load_curve returns it"
        raise TypeError(f"{caller}: {type(curve).__name__}; {text}")


def interpolate_between(
    forces: Pair, depths: Pair, stiffnesses: Pair, joined: Any, force: Array
) -> tuple[Array, Array]:
    """Interpolate depth and tangent stiffness at forces between two levels, like LoadingCurve.at_force.

    forces, depths, stiffnesses : each a pair, the value at the first and at the second level; numbers, or arrays of
        shape (n,)
    joined : number of elements that come into contact between the two levels; number, or array of shape (n,)
    force : forces F/G between the levels, shape (n,) [length²]

    Returns (depth, stiffness), both of shape (n,).
    """
    (f0, f1), (u0, u1), (k0, k1) = forces, depths, stiffnesses
    # `left` and `right` are the depths on the tangents at the first and at the second level. Rounding errors alone
    # could make `right` smaller than `left`, so `right` gets a small margin.
    left, right = u0 + (force - f0) / k0, u1 - (f1 - force) / k1 + _CANCELLATION * u1
    is_left = left <= right
    tangents = np.clip(np.minimum(left, right), u0, u1)
    chord = u0 + (u1 - u0) * (force - f0) / (f1 - f0)
    cubic, cubic_stiffness = _hermite_in_logarithms(force, forces, depths, stiffnesses)
    tangent_stiffness = np.where(is_left & (force < f1), k0, k1)

    # Use the tangents if at most one element comes into contact between the levels, or if the cubic polynomial lies
    # above the tangents. Use the chord if the polynomial lies below the chord. Otherwise use the polynomial.
    on_tangents = ((joined >= 0) & (joined <= 1)) | (cubic > tangents * (1 + 1e-12))
    on_chord = cubic < chord * (1 - 1e-12)
    depth = np.where(on_tangents, tangents, np.where(on_chord, chord, cubic))
    chord_stiffness = (f1 - f0) / (u1 - u0)
    stiffness = np.where(on_tangents, tangent_stiffness, np.where(on_chord, chord_stiffness, cubic_stiffness))
    return depth, stiffness


def _hermite_in_logarithms(force: Array, forces: Pair, depths: Pair, stiffnesses: Pair) -> tuple[Array, Array]:
    """Interpolate ln u between two levels by a cubic Hermite polynomial of ln F; return depth u and stiffness dF/du.

    The stiffness is limited to the range between its values at the two levels. See `interpolate_between` for the
    arguments.
    """
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
