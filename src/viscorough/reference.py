"""Exact solutions and the laws of the paper, for comparison with computations.

Elastic quantities are normalised with the shear modulus G of an incompressible half-space (ν = 1/2, E* = 4G):
force is F/G [length²], stiffness is k/G = d(F/G)/du [length]. The contact is frictionless and non-adhesive.

The paper's laws are dimensionless. The reduced force is X = F/(4GhL) for an elastic half-space and X = Ft/(4ηhL) for a
viscous half-space, with the time t and the viscosity η. The reduced stiffness is κ = k/(4GL). The indenter has the rms
height h, the diameter L and the Hurst exponent H. Its velocity is v.

The paper prints some of its laws with a factor 1/Γ(2−α). The functions give such a law in two forms. `gamma=True` is
the printed law, which the paper derives by a Laplace transform although the depth is not linear in F/G. `gamma=False`
is the law without the factor, which follows from Eqs. 1 and 3 by integration.

Sources: Hertz 1882; Love 1929 and 1939 (square element, cone); Sneddon 1965 (bodies of revolution);
Johnson 1985, Contact Mechanics (flat ellipse); Popov and Heß 2015 (method of dimensionality reduction, MDR).
"""

from dataclasses import dataclass

import numpy as np
from scipy.special import ellipkm1
from scipy.special import gamma as gamma_function

from viscorough.basics.arrays import float_or_array, positive, shown
from viscorough.basics.elasticity import one_element_stiffness as one_element_stiffness
from viscorough.basics.types import Array, Numbers
from viscorough.surfaces.indenter import Indenter

# Reduced stiffness κ = k/(E*L) of a disc in complete contact. The disc is then a flat punch of radius L/2 with
# k = 2E*·L/2. In region (c) of the paper, κ has this value, so that vt/h = X.
COMPLETE_CONTACT_STIFFNESS = 1.0


# ---- exact elastic solutions


@dataclass(frozen=True)
class PowerLawBody:
    """Body of revolution with the profile z = c rⁿ, where r is the distance from the axis of the body.

    At contact radius a the depth is u = κₙ c aⁿ (κₙ: see `mdr_profile`), the force F = 2E*·n/(n+1)·u a, and the
    stiffness k = 2E*a (Sneddon).

    Parameters
    ----------
    coefficient : float
        Coefficient c > 0 [length^(1−n)].
    exponent : float
        Exponent n > 0: 1 for a cone, 2 for a paraboloid, which approximates a sphere.

    Raises
    ------
    ValueError
        Unless coefficient and exponent are finite and positive.

    Examples
    --------
    >>> from viscorough import reference
    >>> sphere = reference.sphere(radius=2.0)
    >>> round(float(sphere.depth(sphere.force(0.1))), 12)
    0.1
    """

    coefficient: float
    exponent: float

    def __post_init__(self) -> None:
        for name in ("coefficient", "exponent"):
            object.__setattr__(self, name, positive(f"{name} of a power-law body", getattr(self, name)))

    def mdr_profile(self, x: Numbers) -> Numbers:
        """Return the profile of the line that is equivalent to this body in the MDR, in the unit of x.

        g(x) = κₙ c abs(x)ⁿ with κₙ = √π Γ(n/2+1)/Γ((n+1)/2).
        """
        n = self.exponent
        kappa = np.sqrt(np.pi) * gamma_function(n / 2 + 1) / gamma_function((n + 1) / 2)
        return kappa * self.coefficient * np.abs(x) ** n

    def contact_radius(self, depth: Numbers) -> Numbers:
        """Return the contact radius a at depth u, which solves `mdr_profile(a)` = u."""
        return (depth / self.mdr_profile(1.0)) ** (1 / self.exponent)

    def force(self, depth: Numbers) -> Numbers:
        """Return the force F/G [length²] at depth u [length]."""
        return 8 * self.exponent / (self.exponent + 1) * depth * self.contact_radius(depth)

    def depth(self, force: Numbers) -> Numbers:
        """Return the depth u [length] at the force F/G [length²]: the inverse of `force`."""
        n = self.exponent
        return self.mdr_profile((force * (n + 1) / (8 * n * self.mdr_profile(1.0))) ** (1 / (n + 1)))

    def stiffness(self, depth: Numbers) -> Numbers:
        """Return the stiffness k/G = 8a [length] at depth u [length], with a the contact radius."""
        return 8 * self.contact_radius(depth)

    def indenter(self, elements_across: int, width: float = 1.0, rows: int | None = None) -> Indenter:
        """Return a map of the heights of this body on a square, with the tip (height 0) at the centre.

        Parameters
        ----------
        elements_across : int
            Number of columns of elements.
        width : float
            Side of the square [length].
        rows : int, optional
            Number of rows of elements, by default the number of columns.
        """
        rows = rows or elements_across
        x, y = _element_centres(elements_across, width), _element_centres(rows, width)
        heights = -self.coefficient * np.hypot(y[:, None], x) ** self.exponent
        return Indenter(heights, width / elements_across, width / rows)

    def mdr_line(self, points: int, width: float = 1.0) -> Indenter:
        """Return the line that is equivalent to this body in the MDR, with the given width and number of points."""
        return Indenter(np.negative(self.mdr_profile(_element_centres(points, width))), width / points)


def sphere(radius: float) -> PowerLawBody:
    """Return the paraboloid z = r²/(2R) that approximates a sphere of radius R.

    At depth u the force is F = (4/3)E*√R u^(3/2), and the contact radius a = √(Ru) (Hertz).

    Examples
    --------
    >>> from viscorough import reference
    >>> round(float(reference.sphere(radius=1.0).contact_radius(0.01)), 12)  # √(Ru)
    0.1
    """
    return PowerLawBody(1 / (2 * positive("radius of a sphere", radius)), 2)


def cone(slope: float) -> PowerLawBody:
    """Return the cone z = r tanθ, with tanθ = `slope`.

    At depth u the force is F = 2E*u²/(π tanθ). At contact radius a the depth is u = (π/2) a tanθ (Love).

    Examples
    --------
    >>> from viscorough import reference
    >>> round(float(reference.cone(slope=0.1).contact_radius(0.1)), 6)  # 2u/(π slope)
    0.63662
    """
    return PowerLawBody(slope, 1)


def flat_ellipse_stiffness(major: float, minor: float) -> float:
    """Return the stiffness k/G [length] of a flat elliptical punch with semi-axes a = `major` ≥ b = `minor`.

    k = πE*a/K(m) (Johnson), with the complete elliptic integral of the first kind K of parameter m = 1 − b²/a². The
    force is k u at every depth u. Equal semi-axes give the flat disc, with k = 2E*a.

    Raises
    ------
    ValueError
        Unless major ≥ minor > 0, with finite semi-axes.

    Examples
    --------
    >>> from viscorough import reference
    >>> round(float(reference.flat_ellipse_stiffness(1.0, 1.0)), 6)  # a disc: 8a
    8.0
    """
    major, minor = float_or_array("semi-axis of an ellipse", major), float_or_array("semi-axis of an ellipse", minor)
    if not np.all((np.asarray(minor) > 0) & (np.asarray(major) >= minor)):
        raise ValueError(f"semi-axes of an ellipse: {major}, {minor}; allowed: finite, major >= minor > 0")
    return 4 * np.pi * major / ellipkm1((minor / major) ** 2)


def flat_disc_stiffness(radius: float) -> float:
    """Return the stiffness k/G = 8a [length] of a flat disc of radius a. The force is k u at every depth u.

    Examples
    --------
    >>> from viscorough import reference
    >>> float(reference.flat_disc_stiffness(1.0))
    8.0
    """
    return flat_ellipse_stiffness(radius, radius)


# ---- the paper's laws


def zeta_elastic(hurst: Numbers) -> Numbers:
    """Return the prefactor ζ ≈ π(3 − H)/10 of the stiffness κ = ζ X^α in elastic contact (Eq. 4 of the paper).

    X = F/(4GhL) and κ = k/(4GL) are the reduced force and stiffness.

    Examples
    --------
    >>> from viscorough import reference
    >>> round(float(reference.zeta_elastic(0.5)), 4)
    0.7854
    """
    return np.pi * (3 - _hurst_exponent(hurst)) / 10


def exponent_alpha(hurst: Numbers) -> Numbers:
    """Return the exponent α = 1/(1 + H) of the stiffness κ = ζ X^α, which the paper states for 0.4 < H < 1 (Eq. 5).

    X = F/(4GhL) and κ = k/(4GL) are the reduced force and stiffness.

    Examples
    --------
    >>> from viscorough import reference
    >>> reference.exponent_alpha(1.0)
    0.5
    """
    return 1 / (1 + _hurst_exponent(hurst))


def depth_law(x: Numbers, zeta: Numbers, alpha: Numbers, *, gamma: bool = False) -> Numbers:
    """Return the depth u/h = X^(1−α)/(ζ(1−α)) (Eq. 6), divided by Γ(2−α) if `gamma` is true (Eq. 8).

    X = Ft/(4ηhL) is the reduced time under a constant force F, and h is the rms height.

    Raises
    ------
    ValueError
        Unless α < 1.

    Examples
    --------
    >>> from viscorough import reference
    >>> reference.depth_law(4.0, zeta=0.5, alpha=0.5)
    8.0
    """
    alpha = float_or_array("alpha", alpha)
    if not np.all(np.asarray(alpha) < 1):
        raise ValueError(f"exponent alpha of the depth law: {shown(alpha)}; allowed: below 1")
    return velocity_law(x, zeta, alpha, gamma=gamma) / (1 - alpha)


def velocity_law(x: Numbers, zeta: Numbers, alpha: Numbers, *, gamma: bool = False) -> Numbers:
    """Return the velocity vt/h = X^(1−α)/ζ, divided by Γ(2−α) if `gamma` is true (Eq. 9).

    X = Ft/(4ηhL) is the reduced time under a constant force F, and h is the rms height. Without the factor 1/Γ(2−α),
    the law follows from vt/h = X/κ (Eq. 1) and the reduced stiffness κ = ζ X^α (Eq. 3).

    Examples
    --------
    >>> from viscorough import reference
    >>> reference.velocity_law(4.0, zeta=0.5, alpha=0.5)
    4.0
    """
    x, zeta, alpha = float_or_array("x", x), float_or_array("zeta", zeta), float_or_array("alpha", alpha)
    if np.any(np.asarray(x) < 0) or np.any(np.asarray(zeta) <= 0):
        raise ValueError(f"velocity law: x {shown(x)}, zeta {shown(zeta)}; allowed: x of at least 0, zeta above 0")
    return x ** (1 - alpha) / (zeta * (gamma_function(2 - alpha) if gamma else 1))


def exponent_beta(hurst: Numbers) -> Numbers:
    """Return the exponent β = 1 − α = H/(1 + H) of the velocity, vt/h ∝ X^β (Eq. 10).

    X = Ft/(4ηhL) is the reduced time, and h is the rms height.

    Examples
    --------
    >>> from viscorough import reference
    >>> reference.exponent_beta(1.0)
    0.5
    """
    hurst = _hurst_exponent(hurst)
    return hurst / (1 + hurst)


def zeta_viscous(hurst: Numbers) -> Numbers:
    """Return the prefactor ζ ≈ 2 − H, which the paper fits to viscous indentation (Eq. 11).

    The law that the paper fits is vt/h = X^(1−α)/(ζ Γ(2−α)). Here v is the velocity, and X = Ft/(4ηhL) is the reduced
    time.

    Examples
    --------
    >>> from viscorough import reference
    >>> reference.zeta_viscous(0.5)
    1.5
    """
    return 2 - _hurst_exponent(hurst)


def rate_law(x: Numbers, hurst: Numbers, *, gamma: bool = False) -> Numbers:
    """Return the velocity vt/h with the exponent α from Eq. 5 and the prefactor ζ from Eq. 11.

    The velocity is X^(1−α)/ζ, see `velocity_law`. If `gamma` is true, it is divided by Γ(2−α) = Γ((1+2H)/(1+H)), which
    gives Eq. 12.

    Examples
    --------
    >>> from viscorough import reference
    >>> reference.rate_law(4.0, hurst=1.0)
    2.0
    """
    return velocity_law(x, zeta_viscous(hurst), exponent_alpha(hurst), gamma=gamma)


def line_spectrum(wavenumber: Numbers, spectrum: Numbers, transfer: Numbers = np.pi) -> Numbers:
    """Return the two-sided spectrum C1D(q) = λ q C2D(q) of the line that represents a surface in the MDR.

    q is the wavenumber, C2D the spectrum of the surface, and λ = `transfer`. λ = π (Eq. 13) gives line and surface the
    same rms height. In general λ = π (h1D/h2D)², with the rms heights h1D of the line and h2D of the surface.

    Examples
    --------
    >>> from viscorough import reference
    >>> round(float(reference.line_spectrum(2.0, 1.0)), 4)  # π q C2D
    6.2832
    """
    transfer, spectrum = float_or_array("transfer", transfer), float_or_array("spectrum", spectrum)
    return transfer * float_or_array("wavenumber", wavenumber) * spectrum


def _hurst_exponent(hurst: Numbers) -> Numbers:
    """Return the Hurst exponent as a float or an array. Raises ValueError for negative numbers."""
    exponent = float_or_array("hurst", hurst)
    if np.any(np.asarray(exponent) < 0):
        raise ValueError(f"hurst: {shown(hurst)}; allowed: numbers of at least 0")
    return exponent


def _element_centres(number: int, width: float) -> Array:
    """Return the centres of `number` equal elements that fill the interval from -width/2 to width/2."""
    return (np.arange(number) - (number - 1) / 2) * width / number
