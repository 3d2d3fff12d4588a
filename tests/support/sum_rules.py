"""Oracle of loading curves: two integrals of a curve, compared with exact values from two linear problems.

First let all elements be joined to the surface, so that they also transmit tension. At the depth u, the pressures p are
then p/G = u q − s with K q = 1 and K s = g₀. Here G is the shear modulus, g₀ the initial gap, and the matrix K gives
the displacements due to p/G. By reciprocity the force is F = k_c (u − ⟨g₀⟩_q). Here k_c is the stiffness of a flat
punch with the outline of the whole indenter, and ⟨·⟩_q is the mean with the weights q.

The loading curve of the frictionless contact, with the stiffness k = dF/du, ends on this straight line. Hence

    ∫₀^∞ (1/k − 1/k_c) dF = ⟨g₀⟩_q        ∫₀^∞ (⟨g₀⟩_q + F/k_c − u) dF = ∫ F (1/k − 1/k_c) dF = U

where U is the elastic energy of the joined surface at zero mean force. The left-hand sides are integrals of a computed
curve. The right-hand sides need no contact problem (viscorough.contact.complete_contact), so they check levels,
stiffness and interpolation of the curve.

In the paper's variables X = F/(4GhL) and κ = k/(4GL), with the rms height h and the diameter L, these are the integrals
of g(X) = X/κ − X/κ_c over ln X and over X. The function g is the contribution of the interface to vt/h, where v is the
velocity and t the time.
"""

import warnings
from dataclasses import dataclass, replace

import numpy as np

from viscorough import AccuracyWarning, LoadingCurve, SolverOptions, indent
from viscorough.contact.complete_contact import CompleteContact, complete_contact
from viscorough.contact.step_control import FINEST_ACCURACY

# The curve counts as straight between two levels if the tangent at the first level passes through the second level,
# within this relative difference in depth.
_STRAIGHT = 1e-9
# Points and weights of Gauss–Legendre quadrature, for the interpolated curve between two levels.
_POINTS, _WEIGHTS = (np.polynomial.legendre.leggauss(8) + np.array([[1.0], [0.0]])) / 2
# Let the compliance 1/k jump once between two levels, at a random force. The error of the trapezoid of the first
# integral then has the standard deviation _JUMP ΔF Δ(1/k), where ΔF and Δ(1/k) are the changes between the levels.
_JUMP = 12**-0.5
# If the compliance 1/k jumps once between two levels, at a random force, the error of the second integral has the
# standard deviation _JUMP_OF_SECOND ΔF² Δ(1/k).
_JUMP_OF_SECOND = 720**-0.5
# The tolerance of the contacts is this share of the tolerance of the audit. Errors of the stiffness may then take a
# tenth of the tolerance of the audit. Their effect on the first integral grows with the force at complete contact.
_CONTACT_TOLERANCE = 0.01
# Levels are added in rounds. In one round, an interval between levels is divided into at most this number of parts.
_MOST_PARTS = 3
# Largest number of rounds in which levels are added.
_MAX_ROUNDS = 12
# Levels are added in rounds. Within two rounds, the norm of the errors of all intervals must fall at least to this
# share. Otherwise no more levels are added, because the levels themselves must be wrong.
_LEAST_REDUCTION = 0.9
# This number avoids divisions by 0.
_TINY = 1e-300


@dataclass(frozen=True)
class Integral:
    """One of the two integrals of a loading curve, compared with its exact value.

    exact : exact value, from two linear problems
    deviations : relative deviation of each quadrature of the curve from the exact value, {name of the quadrature:
        deviation} (see `SumRules`)
    error : estimated relative error. For the first integral it is the error of the quadrature "by levels". For the
        second integral it holds for both quadratures
    """

    exact: float
    deviations: dict[str, float]
    error: float

    @classmethod
    def compared(cls, exact: float, values: dict[str, float], error: float, scale: float) -> "Integral":
        """Return the comparison of quadratures with the exact value of an integral.

        values : {name of a quadrature: result}
        error : estimated absolute error
        scale : value by which all deviations and the error are divided
        """
        return cls(exact, {name: float(value - exact) / scale for name, value in values.items()}, error / scale)


@dataclass(frozen=True)
class SumRules:
    """Both integrals of a loading curve, each computed by several quadratures and compared with its exact value.

    first : integral ∫ (1/k − 1/k_c) dF = ⟨g₀⟩_q [length]. It is computed by three quadratures. "last level" is
        u − F/k_c at the last level. "by levels" uses forces and stiffnesses of the levels alone. "between levels" uses
        the stiffness that `LoadingCurve.at_force` interpolates. For a curve of `indent`, "last level" checks nothing,
        because the depth of complete contact follows from the same linear problems as the exact value
    second : integral ∫ (⟨g₀⟩_q + F/k_c − u) dF = U, as U/G [length³]. It is computed by two quadratures. "by levels"
        uses depths and stiffnesses of the levels alone. "between levels" uses the depth that `LoadingCurve.at_force`
        interpolates
    errors : estimated relative errors √(e₁² + e₂²) of the intervals between levels, shape (levels,). Here e₁ and e₂ are
        the contributions of an interval to the errors of both integrals. The first interval starts at zero force
    """

    first: Integral
    second: Integral
    errors: np.ndarray

    @property
    def error(self) -> float:
        """Return the larger of the estimated relative errors of the two integrals."""
        return max(self.first.error, self.second.error)

    @property
    def largest_deviation(self) -> float:
        """Return the largest relative deviation of any quadrature of the two integrals from the exact value."""
        return max(abs(value) for rule in (self.first, self.second) for value in rule.deviations.values())


@dataclass(frozen=True)
class Audit:
    """A loading curve up to complete contact, with levels added until its two integrals were accurate enough.

    tolerance : requested relative accuracy of both integrals
    complete : CompleteContact of the indenter
    curve : LoadingCurve with the added levels
    rules : SumRules of this curve
    interpolation_error : largest relative error of interpolated depths. At each added level, the computed depth is
        compared with the depth that is interpolated on the curve without added levels
    """

    tolerance: float
    complete: CompleteContact
    curve: LoadingCurve
    rules: SumRules
    interpolation_error: float

    @property
    def is_interpolated(self) -> bool:
        """Return True if the interpolated depth between levels is as accurate as `indent` promises."""
        return self.interpolation_error <= max(self.curve.tolerance, FINEST_ACCURACY)

    @property
    def agrees(self) -> bool:
        """Return True if error and deviations of both integrals are within the tolerance, and `is_interpolated`."""
        return max(self.rules.error, self.rules.largest_deviation) <= self.tolerance and self.is_interpolated


def integrals(curve: LoadingCurve, complete: CompleteContact) -> SumRules:
    """Compute both integrals of a loading curve by quadratures with estimated errors, and compare with exact values.

    The integrals are defined in `SumRules`. The curve is taken as straight before its first level. Whenever an element
    joins the contact, 1/k jumps down. Let ΔF, Δu and Δ(1/k) be the changes of force, depth and 1/k between two
    successive levels, and m the number of elements that join the contact between them. If chord and tangent coincide,
    the curve is straight in this interval, and all quadratures are exact. Otherwise:

    - The first integral "by levels" is a sum of trapezoids T of 1/k. The error of an interval is
      e₁ = max(|T − Δu|, 0.29 ΔF Δ(1/k)/√m). The second term is the standard deviation of T if 1/k has m equal jumps at
      random forces.
    - The second integral "by levels" is a sum of trapezoids of ⟨g₀⟩_q + F/k_c − u, minus the area between chord and
      curve. The curve is convex, so it lies in the triangle of the chord and the two tangents. For m equal jumps at
      random forces, the area between chord and curve is on average (2 + 1/m)/3 of the triangle. This is the whole
      triangle for one jump, and 2/3 of the triangle for many jumps, as for a parabola.
    - "Between levels", both integrals are Gauss quadratures of the curve that LoadingCurve.at_force interpolates.
    - The error of an interval in the second integral is e₂ = max(0.13 ΔF e₁, |D|). Here D is the difference between the
      quadratures "by levels" and "between levels" in the interval. The factor 0.13 is the ratio of the standard
      deviations of the two integrals, divided by ΔF, for jumps at random forces.
    - Errors of intervals are added as independent errors. The error of the first integral is max(|Σ (T − Δu)|, √Σe₁²).
      The error of the second integral is |ΣD| + 3√Σe₂², so that it holds for either quadrature.

    curve : loading curve up to complete contact
    complete : complete contact of the same indenter
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

    # `remaining` is the integrand ⟨g₀⟩_q + F/k_c − u of the second integral. This function of the force is convex and
    # falls to zero.
    remaining = complete.mean_gap + force * least - depth
    triangle = np.maximum((rise * before - sink) * (sink - rise * after), 0.0) / (2 * drop)
    # The area of a triangle of chord and tangents is at most ΔF² Δ(1/k)/8. If rounding makes the stiffness decrease
    # between two levels, `drop` is almost zero, and so is the limited area.
    triangle = np.minimum(triangle, rise**2 * drop / 8)
    areas = rise * (remaining[1:] + remaining[:-1]) / 2 - (2 + 1 / joined) / 3 * triangle
    inner = force[1:-1, None] + rise[1:, None] * _POINTS
    inner_depth, inner_stiffness = curve.at_force(inner)
    inner_areas = rise[1:] * ((complete.mean_gap + inner * least - inner_depth) @ _WEIGHTS)
    inner_sinks = rise[1:] * ((1 / inner_stiffness - least) @ _WEIGHTS)
    error_of_second = np.maximum(_JUMP_OF_SECOND / _JUMP * rise * error, np.append(0, np.abs(inner_areas - areas[1:])))

    # Errors are divided by the exact values. If the exact value is 0, errors of the first integral are divided by the
    # depth u at the last level, and errors of the second integral by F u.
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


def audit(indenter, tolerance=1e-3, options=None) -> Audit:
    """Compute a loading curve up to complete contact, and compare its two integrals with their exact values.

    Contacts are solved to a hundredth of the tolerance. Levels are added in the intervals with the largest estimated
    errors, until the errors of both integrals are within the tolerance. The errors are inversely proportional to the
    number of levels, because the stiffness jumps whenever an element touches. On maps of up to 400 elements there is a
    level for every element that touches, and the integrals are exact within rounding.

    tolerance : relative accuracy of both integrals, from 1e-10 on
    options : SolverOptions
    """
    how = {"tolerance": _CONTACT_TOLERANCE * tolerance, "options": options or SolverOptions()}
    complete = complete_contact(indenter)
    plain = curve = _curve(indenter, until_fraction=1.0, **how)
    rules, norms = integrals(curve, complete), [np.inf, np.inf]
    for number in range(_MAX_ROUNDS):
        # In the first round, add levels even if the error is within the tolerance, because the added levels serve to
        # check the interpolation. No levels are added if the curve is exact.
        allowed, enough = (tolerance, tolerance) if number else (min(tolerance, rules.error / 2), _STRAIGHT)
        # Compare with the error two rounds before. If the stiffness happens to jump exactly at a new level, the error
        # of the divided interval does not fall before the next round.
        norms.append(float(np.linalg.norm(rules.errors)))
        if rules.error <= enough or norms[-1] > _LEAST_REDUCTION * norms[-3]:
            break
        depths = _depths_to_add(curve, rules, allowed)
        if depths.size == 0:
            break
        try:
            curve = _merged(curve, _curve(indenter, depths=depths, **how))
        except ValueError:
            # With the new levels the forces would not increase with the depth, because the levels are too inaccurate.
            # Leave out the new levels: keep the curve before this round and its estimated error.
            break
        rules = integrals(curve, complete)
    between = curve.force > plain.force[0]
    interpolated = plain.at_force(curve.force[between])[0] / curve.depth[between]
    return Audit(tolerance, complete, curve, rules, abs(interpolated - 1).max(initial=0.0))


def _curve(indenter, **how) -> LoadingCurve:
    """Return the curve of `indent`, and ignore AccuracyWarnings.

    `indent` warns if the depth is larger than the map is wide, as it may be before contact is complete. The integrals
    are then still valid for the equations of linear elasticity.
    """
    with warnings.catch_warnings(action="ignore", category=AccuracyWarning):
        return indent(indenter, **how)


def _depths_to_add(curve: LoadingCurve, rules: SumRules, allowed: float):
    """Return depths of new levels that reduce the error of the integrals to the allowed error, with few new levels.

    Each interval between two levels is divided into n equal parts, which makes its error e about n times smaller. If
    the errors of the intervals are independent, the total error is √Σe², and the total number of parts is smallest for
    n ∝ e^(2/3). If errors have equal signs, the estimated error E of the integrals (SumRules.error) can exceed √Σe².
    Every n is then multiplied by E/√Σe².

    rules : both integrals of the curve, with the errors of its intervals
    allowed : allowed relative error of both integrals
    """
    weight = rules.errors[1:] ** (2 / 3)
    equal_signs = max(rules.error / max(float(np.linalg.norm(rules.errors)), _TINY), 1.0)
    parts = np.clip(np.ceil(weight * np.sqrt(weight.sum()) / allowed * equal_signs), 1, _MOST_PARTS).astype(int)
    # Do not divide intervals so narrow that rounding would dominate the differences between levels.
    parts[np.diff(curve.depth) < 1e-6 * curve.depth[1:]] = 1
    intervals = zip(curve.depth[:-1], curve.depth[1:], parts, strict=True)
    added = (np.linspace(start, end, number + 1)[1:-1] for start, end, number in intervals)
    return np.concatenate([np.empty(0), *added])


def _merged(curve: LoadingCurve, added: LoadingCurve) -> LoadingCurve:
    """Return the LoadingCurve with the levels of two curves of the same indenter."""
    order = np.argsort(np.append(curve.depth, added.depth))
    levels = {
        name: np.append(getattr(curve, name), getattr(added, name))[order]
        for name in ("depth", "force", "stiffness", "contact_count", "residual")
    }
    return replace(curve, operator_applications=curve.operator_applications + added.operator_applications, **levels)
