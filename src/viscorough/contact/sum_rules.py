"""Compare loading curves with two exact integrals, which follow from two linear solutions.

Let all elements touch and stay joined to the surface, under tension as well. The pressures are then p/G = u q − s with
K q = 1 and K s = g₀, with K the displacement per p/G and g₀ the initial gap. By reciprocity F = k_c (u − ⟨g₀⟩_q),
with k_c the stiffness of the flat punch of the whole outline and ⟨·⟩_q the mean with the weights q. The frictionless
curve ends on this straight line, and du = dF/k on the way to it. Hence

    ∫₀^∞ (1/k − 1/k_c) dF = ⟨g₀⟩_q        ∫₀^∞ (⟨g₀⟩_q + F/k_c − u) dF = ∫ F (1/k − 1/k_c) dF = U

with U the elastic energy of the joined surface at zero mean force. In units of h and 4GhL the integrand is the part of
the interface in vt/h, g(X) = X/κ − X/κ_c, over ln X and over X. The right-hand sides need no contact problem, so they
check levels, stiffness and interpolation of a curve together.
"""

import sys
import warnings
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from viscorough.basics.argument_names import argument
from viscorough.basics.arrays import ReadOnlyArrays, real_number
from viscorough.basics.errors import AccuracyWarning
from viscorough.basics.summaries import unit_power, with_unit
from viscorough.basics.types import Array, Progress
from viscorough.contact.complete_contact import joined_surface
from viscorough.contact.loading_path import indent
from viscorough.contact.options import DEFAULT, SolverOptions
from viscorough.contact.parallel import require_threads
from viscorough.contact.ranking import all_elements
from viscorough.contact.step_control import FINEST_ACCURACY
from viscorough.results.loading_curve import LoadingCurve
from viscorough.surfaces.indenter import Indenter, check_indenter

# Relative difference of chord and tangent below which the curve is straight between two levels.
_STRAIGHT = 1e-9
# Points and weights of the quadrature of the interpolated curve between two levels (Gauss and Legendre).
_POINTS, _WEIGHTS = (np.polynomial.legendre.leggauss(8) + np.array([[1.0], [0.0]])) / 2
# Standard deviation of the first quadrature, over ΔF Δ(1/k), if the stiffness has a single jump at a random force.
_JUMP = 12**-0.5
# Standard deviation of the second quadrature, over ΔF² Δ(1/k), in this case.
_JUMP_OF_SECOND = 720**-0.5
# Tolerance of the contacts over the tolerance of the audit. It leaves a tenth of the latter for errors of the
# stiffness, whose effect on the first integral grows with the force at complete contact.
_CONTACT_TOLERANCE = 0.01
# Least tolerance that contacts can meet.
_LEAST_CONTACT_TOLERANCE = 1e-12
# Divide an interval into at most so many parts in one round.
_MOST_PARTS = 3
# Add levels in at most so many rounds.
_MAX_ROUNDS = 12
# Errors of all intervals must fall to this share within two rounds. They do not if the levels are wrong.
_LEAST_REDUCTION = 0.9
# Avoids divisions by 0.
_TINY = 1e-300


@dataclass(frozen=True)
class CompleteContact(ReadOnlyArrays):
    """Complete contact of an indenter, and the two integrals of its loading curve, from linear solutions.

    Attributes
    ----------
    mean_gap : float
        First integral ⟨g₀⟩_q, the mean initial gap with the pressures of a flat punch as weights [length].
    energy : float
        Second integral U/G, the elastic energy of the joined surface at zero mean force [length³].
    stiffness : float
        Stiffness k_c/G of the whole outline as a flat punch [length].
    depth : float
        Least depth u at which all elements touch [length].
    length_unit : str
        Unit of the lengths; "1" if it is not known.
    """

    mean_gap: float
    energy: float
    stiffness: float
    depth: float
    length_unit: str = "1"

    @property
    def force(self) -> float:
        """Return the force of complete contact, F/G = k_c (u − ⟨g₀⟩_q)/G [length²]."""
        return self.stiffness * (self.depth - self.mean_gap)


@dataclass(frozen=True)
class Integral:
    """One of the two integrals of a loading curve, compared with its exact value.

    Attributes
    ----------
    exact : float
        Exact value, from linear solutions.
    deviations : dict
        Relative deviations of quadratures over the curve from the exact value, by name.
    error : float
        Estimated relative error of the quadrature "by levels" in the first integral, of both in the second integral.
    """

    exact: float
    deviations: dict[str, float]
    error: float

    @classmethod
    def compared(cls, exact: float, values: dict[str, float], error: float, scale: float) -> "Integral":
        """Return the integral with quadratures and an error, which are divided by `scale`."""
        return cls(exact, {name: float(value - exact) / scale for name, value in values.items()}, error / scale)


@dataclass(frozen=True)
class SumRules(ReadOnlyArrays):
    """Both integrals of a loading curve.

    Attributes
    ----------
    first : Integral
        Integral ⟨g₀⟩_q [length]. Its quadratures are u − F/k_c at the "last level", ∫ (1/k − 1/k_c) dF "by levels" from
        forces and stiffnesses alone, and "between levels" with the stiffness of `LoadingCurve.at_force`. The last
        level is no check of a curve of `indent`, whose depth of complete contact has the same source.
    second : Integral
        Integral U/G [length³]. Its quadratures are ∫ (⟨g₀⟩_q + F/k_c − u) dF "by levels" from depths and stiffnesses,
        and "between levels" with the depth of `LoadingCurve.at_force`.
    errors : array
        Estimated relative error of both integrals in each interval between levels, shape (levels,); the first interval
        starts at zero force [1].
    """

    first: Integral
    second: Integral
    errors: np.ndarray

    @property
    def error(self) -> float:
        """Return the larger of the estimated relative errors of both integrals."""
        return max(self.first.error, self.second.error)

    @property
    def largest_deviation(self) -> float:
        """Return the largest relative deviation of a quadrature from the exact value."""
        return max(abs(value) for rule in (self.first, self.second) for value in rule.deviations.values())


@dataclass(frozen=True)
class Audit(ReadOnlyArrays):
    """Loading curve to complete contact, with added levels for accurate integrals, and both integrals.

    Attributes
    ----------
    tolerance : float
        Requested relative accuracy of both integrals [1].
    complete : CompleteContact
        Complete contact of the indenter.
    curve : LoadingCurve
        Curve with the added levels.
    rules : SumRules
        Both integrals of this curve.
    interpolation_error : float
        Largest relative error, at the added levels, of the depth that the curve without them interpolates [1].
    """

    tolerance: float
    complete: CompleteContact
    curve: LoadingCurve
    rules: SumRules
    interpolation_error: float

    @property
    def integrals_agree(self) -> bool:
        """Return True if the estimated error and all deviations from the exact integrals are within the tolerance."""
        return max(self.rules.error, self.rules.largest_deviation) <= self.tolerance

    @property
    def is_interpolated(self) -> bool:
        """Return True if the interpolated depth between levels is as accurate as `indent` promises."""
        return self.interpolation_error <= max(self.curve.tolerance, FINEST_ACCURACY)

    @property
    def agrees(self) -> bool:
        """Return True if the integrals agree, and the interpolated depth is as accurate as promised."""
        return self.integrals_agree and self.is_interpolated

    def __str__(self) -> str:
        """Return the verdict, and exact value, deviations and estimated error of both integrals."""
        verdict = "agree" if self.integrals_agree else "do not agree"
        text = f"Audit over {self.curve.depth.size} levels: both integrals {verdict} to {self.tolerance:g}"
        if not self.is_interpolated:
            text += f", and depths between levels are off by {self.interpolation_error:.1e}"
        for name, integral, power in (("mean gap", self.rules.first, 1), ("energy U/G", self.rules.second, 3)):
            exact = with_unit(integral.exact, unit_power(self.curve.length_unit, power), 8)
            deviations = ", ".join(
                f"{quadrature} {deviation:+.1e}" for quadrature, deviation in integral.deviations.items()
            )
            text += f"\n{name} {exact}, {deviations}, estimated error {integral.error:.1e}"
        return text


def complete_contact(indenter: Indenter, *, threads: int = 1) -> CompleteContact:
    """Compute the complete contact of an indenter from two linear problems, without a contact problem.

    With the loads P = p d/(4πG), the side d of an element and the influence coefficients K, the solutions of K q = 1
    and K s = g₀ give::

        ⟨g₀⟩_q = Σs/Σq,   k_c/G = 4π d Σq,   U/G = 2π d (Σ s g₀ − (Σs)²/Σq),   u = max s/q

    The last tension vanishes at the depth u. The problems are solved on the grid by preconditioned conjugate gradients.
    On a line of n points, springs of stiffness 4G Δx are independent (MDR)::

        ⟨g₀⟩_q = mean g₀,   k_c/G = 4 Δx n,   U/G = 2 Δx Σ (g₀ − mean g₀)²,   u = max g₀

    Parameters
    ----------
    indenter : Indenter
        Map or line of heights.
    threads : int, optional
        Number of threads; the result does not depend on it.

    Returns
    -------
    CompleteContact

    Raises
    ------
    ConvergenceError
        If the linear problems are not solved to 1e-12.

    Examples
    --------
    >>> import numpy as np, viscorough
    >>> heights = np.array([[0.0, -1.0], [-1.0, 0.0]])
    >>> end = viscorough.complete_contact(viscorough.Indenter(heights, spacing=1.0))
    >>> round(float(end.mean_gap), 12)  # the four elements are equivalent
    0.5
    """
    check_indenter("complete_contact", indenter)
    require_threads("complete_contact", threads)
    if indenter.heights.ndim == 1:
        gap, stiffness = indenter.initial_gap, 4 * indenter.spacing * indenter.elements
        largest = gap.max()
        energy = _energy(stiffness / 2 * (gap / (largest or 1.0)).var(), largest)
        return CompleteContact(float(gap.mean()), energy, stiffness, float(largest), indenter.length_unit)
    elements = all_elements(indenter, threads)
    units = elements.units
    joined = joined_surface(elements, threads=threads)
    above_mean = elements.initial_gap - joined.mean_gap
    energy = _energy(float(units.stiffness / 2 * joined.load @ above_mean), units.length)
    return CompleteContact(
        mean_gap=joined.mean_gap * units.length,
        energy=energy,
        stiffness=units.stiffness * joined.tangent.sum(),
        depth=joined.depth * units.length,
        length_unit=indenter.length_unit,
    )


def _energy(reduced: float, length: float) -> float:
    """Return the energy `reduced` · length². Raises ValueError if double precision cannot represent it."""
    with np.errstate(over="ignore", under="ignore"):
        energy = float(reduced * np.square(length))
    if not np.isfinite(energy) or 0 < abs(energy) < sys.float_info.min or (energy == 0 and reduced * length != 0):
        size, unit = ("large", "larger") if energy > 1 else ("small", "smaller")
        text = f"the energy of complete contact is too {size} to represent; a {unit} unit of length is needed"
        raise ValueError(text)
    return energy


def integrals(curve: LoadingCurve, complete: CompleteContact) -> SumRules:
    """Compute both integrals of a loading curve by quadratures with estimated errors, and compare with exact values.

    The curve is taken as straight before its first level. Between two levels, 1/k jumps down when an element joins. Let
    ΔF, Δu and Δ(1/k) be the changes between two levels, and m the number of elements that join. If chord and tangent
    coincide, the curve is straight, and the quadratures of both integrals are exact. Otherwise:

    - The first integral "by levels" is a sum of trapezoids T of 1/k. The error of an interval is e₁ = max(|T − Δu|,
      0.29 ΔF Δ(1/k)/√m), the latter being the standard deviation for m equal jumps at random forces.
    - The second integral "by levels" is a sum of trapezoids of ⟨g₀⟩_q + F/k_c − u, minus the area between chord and
      curve. By convexity the curve lies in the triangle of chord and tangents. For m equal jumps at random forces, the
      share (2 + 1/m)/3 of the triangle lies on average between chord and curve: all of it for one jump, 2/3, as for a
      parabola, for many jumps.
    - "Between levels", both integrals are Gauss quadratures of the curve that LoadingCurve.at_force interpolates.
    - The error of an interval in the second integral is e₂ = max(0.13 ΔF e₁, difference of both quadratures), with the
      ratio of the standard deviations for such jumps.
    - Errors of intervals are added as independent errors. The error of the first integral is max(|Σ (T − Δu)|, √Σe₁²).
      The error of the second is the difference of both quadratures plus 3√Σe₂², so it holds for either quadrature.

    curve : loading curve to complete contact
    complete : complete contact of the indenter of this curve
    """
    depth, force = np.append(0.0, curve.depth), np.append(0.0, curve.force)
    stiffness = np.append(curve.force[0] / curve.depth[0], curve.stiffness)
    count = np.append(curve.contact_count[0], curve.contact_count)
    rise, sink = np.diff(force), np.diff(depth)
    before, after = 1 / stiffness[:-1], 1 / stiffness[1:]
    drop, least = np.maximum(before - after, _TINY), 1 / complete.stiffness
    is_straight = np.abs(rise * before - sink) <= _STRAIGHT * sink

    trapezoid = np.where(is_straight, rise * before, rise * (before + after) / 2)
    off = np.where(is_straight, 0.0, trapezoid - sink)
    joined = np.maximum(np.diff(count), 1)
    jumps = _JUMP * rise * drop / np.sqrt(joined)
    error = np.where(is_straight, 0.0, np.maximum(np.abs(off), jumps))

    # ⟨g₀⟩_q + F/k_c − u, which is convex and falls to zero.
    remaining = complete.mean_gap + force * least - depth
    triangle = np.maximum((rise * before - sink) * (sink - rise * after), 0.0) / (2 * drop)
    triangle = np.minimum(triangle, rise**2 * drop / 8)  # 0 if the stiffness decreases by rounding
    areas = rise * (remaining[1:] + remaining[:-1]) / 2 - (2 + 1 / joined) / 3 * triangle
    inner = force[1:-1, None] + rise[1:, None] * _POINTS
    inner_depth, inner_stiffness = curve.at_force(inner)
    inner_areas = rise[1:] * ((complete.mean_gap + inner * least - inner_depth) @ _WEIGHTS)
    inner_sinks = rise[1:] * ((1 / inner_stiffness - least) @ _WEIGHTS)
    error_of_second = np.maximum(_JUMP_OF_SECOND / _JUMP * rise * error, np.append(0, np.abs(inner_areas - areas[1:])))

    # Errors are relative to the exact values, unless those are 0.
    scale, scale_of_second = complete.mean_gap or depth[-1], complete.energy or force[-1] * depth[-1]
    first = {
        "last level": depth[-1] - force[-1] * least,
        "by levels": trapezoid.sum() - force[-1] * least,
        "between levels": sink[0] - rise[0] * least + inner_sinks.sum(),
    }
    second = {"by levels": areas.sum(), "between levels": areas[0] + inner_areas.sum()}
    total = max(abs(off.sum()), np.sqrt((error**2).sum()))
    total_of_second = abs(areas[1:].sum() - inner_areas.sum()) + 3 * np.sqrt((error_of_second**2).sum())
    return SumRules(
        Integral.compared(complete.mean_gap, first, total, scale),
        Integral.compared(complete.energy, second, total_of_second, scale_of_second),
        np.hypot(error / scale, error_of_second / scale_of_second),
    )


def audit(
    indenter: Indenter,
    *,
    tolerance: float = 1e-3,
    progress: Progress | None = None,
    threads: int = 1,
    options: SolverOptions = DEFAULT,
) -> Audit:
    """Compute a loading curve to complete contact, and compare its two integrals with their exact values.

    Contacts are solved to a hundredth of the tolerance. Levels are added in the intervals with the largest estimated
    errors of both integrals, until the errors are within the tolerance. Since k jumps at every contact event, the
    errors are inversely proportional to the number of levels. On maps of up to 400 elements every event is a level, and
    the integrals are exact to rounding.

    Parameters
    ----------
    indenter : Indenter
        Indenter with two-dimensional heights.
    tolerance : float, optional
        Relative accuracy of both integrals, between 1e-10 and 0.1 [1].
    progress : Progress, optional
        Function called with the finished share of the rounds of added levels, up to 1.
    threads : int, optional
        Number of threads; the result does not depend on it.
    options : SolverOptions, optional
        Details of the iterations, such as their precision; change them only to measure their effect.

    Returns
    -------
    Audit

    Raises
    ------
    ValueError
        For arguments out of range.
    ConvergenceError
        If a contact cannot be solved.

    Examples
    --------
    >>> import viscorough
    >>> disc = viscorough.self_affine_disc(0.8, 17, seed=1)
    >>> bool(viscorough.audit(disc, tolerance=1e-9).agrees)
    True
    """
    check_indenter("audit", indenter, 2)
    tolerance = real_number(argument("tolerance", of="audit"), tolerance)
    if not 1e-10 <= tolerance <= 0.1:
        raise ValueError(f"{argument('tolerance', of='audit')} must be between 1e-10 and 0.1, not {tolerance!r}")
    progress = progress or (lambda done: None)
    contact_tolerance = max(_CONTACT_TOLERANCE * tolerance, _LEAST_CONTACT_TOLERANCE)
    how: dict[str, Any] = {"tolerance": contact_tolerance, "threads": threads, "options": options}
    complete = complete_contact(indenter, threads=threads)
    plain = curve = _curve(indenter, until_fraction=1.0, **how)
    rules, norms = integrals(curve, complete), [np.inf, np.inf]
    for number in range(_MAX_ROUNDS):
        # Unless the curve is exact, the first round adds levels in any case: they check the interpolation.
        allowed, enough = (tolerance, tolerance) if number else (min(tolerance, rules.error / 2), _STRAIGHT)
        # If a jump lies at the new level of an interval, its error falls only in the following round.
        norms.append(float(np.linalg.norm(rules.errors)))
        if rules.error <= enough or norms[-1] > _LEAST_REDUCTION * norms[-3]:
            break
        depths = _depths_to_add(curve, rules, allowed)
        if depths.size == 0:
            break
        progress((number + 1) / _MAX_ROUNDS)
        try:
            curve = _merged(curve, _curve(indenter, depths=depths, **how))
        except ValueError:
            break  # the added levels contradict the others; the estimated error remains
        rules = integrals(curve, complete)
    between = curve.force > plain.force[0]
    interpolated = plain.at_force(curve.force[between])[0] / curve.depth[between]
    return Audit(tolerance, complete, curve, rules, abs(interpolated - 1).max(initial=0.0))


def _curve(indenter: Indenter, **how: Any) -> LoadingCurve:
    """Return the curve of `indent` without its warnings, since complete contact is beyond the range of the theory."""
    with warnings.catch_warnings(action="ignore", category=AccuracyWarning):
        return indent(indenter, **how)


def _depths_to_add(curve: LoadingCurve, rules: SumRules, allowed: float) -> Array:
    """Return the fewest depths that divide intervals between levels into equal parts and reduce the error enough.

    Dividing an interval into n parts divides its error by n. For independent errors, the number of parts is smallest if
    n is proportional to the error to the power 2/3. Errors of equal sign add up to more, by the ratio of the estimated
    error to the independent sum.
    """
    weight = rules.errors[1:] ** (2 / 3)
    equal_signs = max(rules.error / max(float(np.linalg.norm(rules.errors)), _TINY), 1.0)
    parts = np.clip(np.ceil(weight * np.sqrt(weight.sum()) / allowed * equal_signs), 1, _MOST_PARTS).astype(int)
    # Levels must not be so close that their differences are lost to rounding.
    parts[np.diff(curve.depth) < 1e-6 * curve.depth[1:]] = 1
    intervals = zip(curve.depth[:-1], curve.depth[1:], parts, strict=True)
    added = (np.linspace(start, end, number + 1)[1:-1] for start, end, number in intervals)
    return np.concatenate([np.empty(0), *added])


def _merged(curve: LoadingCurve, added: LoadingCurve) -> LoadingCurve:
    """Return the LoadingCurve with the levels of both curves."""
    order = np.argsort(np.append(curve.depth, added.depth))
    levels: dict[str, Any] = {
        name: np.append(getattr(curve, name), getattr(added, name))[order]
        for name in ("depth", "force", "stiffness", "contact_count", "residual")
    }
    return replace(curve, operator_applications=curve.operator_applications + added.operator_applications, **levels)
