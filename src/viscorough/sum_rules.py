"""Two exact integrals of every loading curve, from two linear solutions, and the audit of curves by them.

Let all elements touch and stay joined to the surface, under tension as well. The pressures are then p/G = u q − s with
K q = 1 and K s = g₀, where K is the displacement per p/G and g₀ the initial gap. By reciprocity F = k_c (u − ⟨g₀⟩_q),
with k_c the stiffness of the flat punch of the whole outline and ⟨·⟩_q the mean with the weights q. The frictionless
curve ends on this straight line, and du = dF/k on the way to it. Hence

    ∫₀^∞ (1/k − 1/k_c) dF = ⟨g₀⟩_q        ∫₀^∞ (⟨g₀⟩_q + F/k_c − u) dF = ∫ F (1/k − 1/k_c) dF = U

where U is the elastic energy of the joined surface at zero mean force. In units of h and 4GhL the integrands are the
interface's part of vt/h, g(X) = X/κ − X/κ_c, over ln X and over X. No contact problem enters the right-hand sides, so
that they check levels, stiffness and interpolation of a curve together.
"""

import sys
import warnings
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from viscorough.argument_names import argument
from viscorough.arrays import ReadOnlyArrays, real_number
from viscorough.contact.complete_contact import joined_surface
from viscorough.contact.loading_path import indent
from viscorough.contact.options import DEFAULT, SolverOptions
from viscorough.contact.parallel import require_threads
from viscorough.contact.ranking import all_elements
from viscorough.contact.step_control import FINEST_ACCURACY
from viscorough.errors import AccuracyWarning
from viscorough.indenter import Indenter, check_indenter
from viscorough.loading_curve import LoadingCurve
from viscorough.summaries import unit_power, with_unit
from viscorough.types import Array, Progress

# Relative difference of chord and tangent below which the curve is straight between two levels.
_STRAIGHT = 1e-9
# Points between two levels at which the interpolated curve is evaluated.
_POINTS, _WEIGHTS = (np.polynomial.legendre.leggauss(8) + np.array([[1.0], [0.0]])) / 2
# Standard deviations of the two quadratures over an interval in which the stiffness has a single jump at a random
# force, over the jump of 1/k and the width, and over the square of the width: √(1/12) and √(1/720).
_JUMP, _JUMP_OF_SECOND = 12**-0.5, 720**-0.5
# Tolerance of the contacts over that of the audit: it leaves a tenth of the latter for the errors of the stiffness,
# whose effect on the first integral grows with the force at complete contact.
_CONTACT_TOLERANCE, _LEAST_CONTACT_TOLERANCE = 0.01, 1e-12
# Largest number of parts into which an interval is divided at a time, and of times; factor by which the errors of all
# intervals together must fall within two times, which they do not if the levels are wrong.
_MOST_PARTS, _MAX_ROUNDS, _LEAST_REDUCTION = 3, 12, 0.9
_TINY = 1e-300


@dataclass(frozen=True)
class CompleteContact(ReadOnlyArrays):
    """Where the loading curve of an indenter ends, and its two integrals, from linear solutions alone.

    Attributes
    ----------
    mean_gap : float
        ⟨g₀⟩_q, the first integral [length].
    energy : float
        U/G, the second integral [length³].
    stiffness : float
        k_c/G of the whole outline as a flat punch [length].
    depth : float
        u from which on all elements touch [length].
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
        """F/G = k_c (u − ⟨g₀⟩_q)/G from which on all elements touch [length²]."""
        return self.stiffness * (self.depth - self.mean_gap)


@dataclass(frozen=True)
class Integral:
    """One of the two integrals of a loading curve beside its exact value.

    Attributes
    ----------
    exact : float
        From linear solutions.
    deviations : dict
        Of quadratures over the curve from the exact value, relative, by name.
    error : float
        Estimated error, relative: of the quadrature "by levels", and in the second integral of both.
    """

    exact: float
    deviations: dict[str, float]
    error: float

    @classmethod
    def of(cls, exact: float, values: dict[str, float], error: float, scale: float) -> "Integral":
        """The integral with these quadratures and this error; `scale` is what they are relative to."""
        return cls(exact, {name: float(value - exact) / scale for name, value in values.items()}, error / scale)


@dataclass(frozen=True)
class SumRules(ReadOnlyArrays):
    """Both integrals of a loading curve.

    Attributes
    ----------
    first : Integral
        For ⟨g₀⟩_q: u − F/k_c at the "last level" (no check of a curve of `indent`, whose level of complete contact
        has the same source), ∫ (1/k − 1/k_c) dF "by levels", from forces and
        stiffnesses alone, and "between levels", with the stiffness of `LoadingCurve.at_force` [length].
    second : Integral
        For U/G: ∫ (⟨g₀⟩_q + F/k_c − u) dF "by levels", from depths and stiffnesses there, and "between levels", with
        the depth of `LoadingCurve.at_force` [length³].
    errors : array
        Estimated error in each interval, of both integrals over their scales, shape (levels − 1,).
    """

    first: Integral
    second: Integral
    errors: np.ndarray

    @property
    def error(self) -> float:
        """The larger one of the estimated errors of both integrals, relative."""
        return max(self.first.error, self.second.error)

    @property
    def largest_deviation(self) -> float:
        """The largest deviation of any quadrature from the exact value, relative."""
        return max(abs(value) for rule in (self.first, self.second) for value in rule.deviations.values())


@dataclass(frozen=True)
class Audit(ReadOnlyArrays):
    """A loading curve with levels added until its integrals are known to a tolerance, and what they are.

    Attributes
    ----------
    tolerance : float
        Of both integrals, relative.
    complete : CompleteContact
        What `complete_contact` gives for the indenter.
    curve : LoadingCurve
        With the added levels.
    rules : SumRules
        Both integrals of this curve.
    interpolation_error : float
        Largest relative error of the depth that was interpolated without the added levels, at these.
    """

    tolerance: float
    complete: CompleteContact
    curve: LoadingCurve
    rules: SumRules
    interpolation_error: float

    @property
    def integrals_agree(self) -> bool:
        """Whether the estimated error and all deviations from the exact integrals are within the tolerance."""
        return max(self.rules.error, self.rules.largest_deviation) <= self.tolerance

    @property
    def is_interpolated(self) -> bool:
        """Whether the depth between levels was as accurate as `indent` promises."""
        return self.interpolation_error <= max(self.curve.tolerance, FINEST_ACCURACY)

    @property
    def agrees(self) -> bool:
        """Whether the integrals agree, and the interpolated depth is as accurate as promised."""
        return self.integrals_agree and self.is_interpolated

    def __str__(self) -> str:
        """Verdict; exact value, deviations and estimated error of both integrals."""
        verdict = "agree" if self.integrals_agree else "do not agree"
        text = f"Audit over {self.curve.depth.size} levels: both integrals {verdict} to {self.tolerance:g}"
        if not self.is_interpolated:
            text += f", and depths between levels are off by {self.interpolation_error:.1e}"
        for name, integral, power in (("mean gap", self.rules.first, 1), ("energy U/G", self.rules.second, 3)):
            exact = with_unit(integral.exact, unit_power(self.curve.length_unit, power), 8)
            deviations = ", ".join(f"{of} {deviation:+.1e}" for of, deviation in integral.deviations.items())
            text += f"\n{name} {exact}, {deviations}, estimated error {integral.error:.1e}"
        return text


def complete_contact(indenter: Indenter, *, threads: int = 1) -> CompleteContact:
    """The complete contact of an indenter, from two linear problems without a contact problem.

    With P = p d/(4πG), d the side of an element and K the influence coefficients, K q = 1 and K s = g₀ give::

        ⟨g₀⟩_q = Σs/Σq,   k_c/G = 4π d Σq,   U/G = 2π d (Σ s g₀ − (Σs)²/Σq),   u = max s/q

    where u is the depth at which the last tension vanishes. They are solved on the grid by preconditioned conjugate
    gradients. On a line, springs of stiffness 4G Δx are independent (MDR)::

        ⟨g₀⟩_q = mean g₀,   k_c/G = 4 Δx n,   U/G = 2 Δx Σ (g₀ − mean g₀)²,   u = max g₀

    Parameters
    ----------
    indenter : Indenter
        Indenter.
    threads : int, optional
        Of the processor.

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
    """The energy `reduced` · length². Raises ValueError if double precision cannot represent it."""
    with np.errstate(over="ignore", under="ignore"):
        energy = float(reduced * np.square(length))
    if not np.isfinite(energy) or 0 < abs(energy) < sys.float_info.min or (energy == 0 and reduced * length != 0):
        size, unit = ("large", "larger") if energy > 1 else ("small", "smaller")
        text = f"the energy of complete contact is too {size} to represent; a {unit} unit of length is needed"
        raise ValueError(text)
    return energy


def integrals(curve: LoadingCurve, complete: CompleteContact) -> SumRules:
    """Both integrals of a loading curve as quadratures, with estimates of their errors, beside the exact ones.

    Before its first level the curve is taken as straight. Between two levels 1/k jumps down wherever an element joins.
    "By levels", the first integral is therefore a sum of trapezoids. In the second one, the curve cuts off from the
    triangle of chord and tangents, to which convexity confines it, what m equal jumps at random forces do on average:
    the share (1 − 1/m)/3, none for one jump, that of a parabola for many. Where chord and tangent coincide, the curve
    is straight, and both are exact. The estimated error of an interval is what its trapezoid differs from its rise in
    depth, at least the standard deviation for such jumps, 0.29 ΔF Δ(1/k)/√m; that of the second integral is 0.13 ΔF
    times as large, the ratio for such jumps, or what the two quadratures differ by. Errors of intervals add as
    independent ones, but at least as their known parts do. That of the second integral is three standard deviations and
    what both quadratures differ by in all, so that it holds for either of them.

    curve : LoadingCurve; complete : CompleteContact of its indenter

    Returns SumRules.
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
    triangle = np.minimum(triangle, rise**2 * drop / 8)  # the largest one; 0 where the stiffness is lower by rounding
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
        Integral.of(complete.mean_gap, first, total, scale),
        Integral.of(complete.energy, second, total_of_second, scale_of_second),
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
    """Follow a loading curve to complete contact and compare its two integrals with the exact ones.

    Its contacts are solved to a hundredth of the tolerance, and levels are added where they reduce the estimated errors
    of both integrals (`integrals`) most, until these are within the tolerance. As k jumps at every contact event, the
    errors fall as the inverse of the number of levels. On maps of up to 400 elements every event is a level, and the
    integrals are exact to rounding.

    Parameters
    ----------
    indenter : Indenter
        Indenter with two-dimensional heights.
    tolerance : float, optional
        Of both integrals, relative; between 1e-10 and 0.1.
    progress : Progress, optional
        Function that is called with the share of the rounds of added levels that is done, up to 1.
    threads, options : int or SolverOptions, optional
        As in `indent`.

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
        # A few levels are added in any case, unless the curve is exact: at them it is seen whether interpolation holds.
        allowed, enough = (tolerance, tolerance) if number else (min(tolerance, rules.error / 2), _STRAIGHT)
        # Where the jump in the middle of an interval comes to an end of a part of it, only the round after shows less.
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
            break  # the added levels contradict the others, so that the estimated error remains
        rules = integrals(curve, complete)
    between = curve.force > plain.force[0]
    interpolated = plain.at_force(curve.force[between])[0] / curve.depth[between]
    return Audit(tolerance, complete, curve, rules, abs(interpolated - 1).max(initial=0.0))


def _curve(indenter: Indenter, **how: Any) -> LoadingCurve:
    """The curve of `indent`, without its warnings: complete contact lies beyond what the theory describes."""
    with warnings.catch_warnings(action="ignore", category=AccuracyWarning):
        return indent(indenter, **how)


def _depths_to_add(curve: LoadingCurve, rules: SumRules, allowed: float) -> Array:
    """Depths that divide the intervals between levels into equal parts, as few as reduce the error to the allowed one.

    The error of an interval of n parts is 1/n of that of the interval, and errors add as independent ones do: the sum
    of n is smallest with n in proportion to the error to the power 2/3. Where errors have one sign they add up to more
    than that, by the ratio of the estimated error to the independent sum.
    """
    weight = rules.errors[1:] ** (2 / 3)
    of_one_sign = max(rules.error / max(float(np.linalg.norm(rules.errors)), _TINY), 1.0)
    parts = np.clip(np.ceil(weight * np.sqrt(weight.sum()) / allowed * of_one_sign), 1, _MOST_PARTS).astype(int)
    # Levels must not be so close that their differences are lost to rounding.
    parts[np.diff(curve.depth) < 1e-6 * curve.depth[1:]] = 1
    intervals = zip(curve.depth[:-1], curve.depth[1:], parts, strict=True)
    added = (np.linspace(start, end, number + 1)[1:-1] for start, end, number in intervals)
    return np.concatenate([np.empty(0), *added])


def _merged(curve: LoadingCurve, added: LoadingCurve) -> LoadingCurve:
    """The LoadingCurve with the levels of both."""
    order = np.argsort(np.append(curve.depth, added.depth))
    levels: dict[str, Any] = {
        name: np.append(getattr(curve, name), getattr(added, name))[order]
        for name in ("depth", "force", "stiffness", "contact_count", "residual")
    }
    return replace(curve, operator_applications=curve.operator_applications + added.operator_applications, **levels)
