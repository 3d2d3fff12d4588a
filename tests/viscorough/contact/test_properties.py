"""Properties of every indenter, on random small maps, for the dense solver and for the grid solver.

Neither more depth nor more or higher elements lower the force. This follows from complementarity if the inverse of the
influence matrix has no positive entry off its diagonal (computed up to 25 × 25 elements).
"""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays

from support.influence import influence_matrix
from viscorough import (
    Indenter,
    SolverOptions,
    contact_at,
    indent,
    kinetics,
    self_affine_disc,
)
from viscorough.contact.complete_contact import complete_contact
from viscorough.contact.gap_map import gap_map
from viscorough.contact.prescribed_depth import ContactSolver
from viscorough.viscous.integration.events import newtonian_events

TOLERANCE = 1e-9
# The relative error of the force is of second order in the tolerance. The error of the stiffness is of second order in
# the error of q. On the grid, the error of q is the root of the tolerance times a factor that grows with the contact
# set.
STIFFNESS, FORCE = 1e-8, 1e-10
OPTIONS = {
    "dense": SolverOptions(dense_contacts=10**9, dense_interactions=10**9),
    "grid": SolverOptions(dense_contacts=0, dense_interactions=0),
}
both_routes = pytest.mark.parametrize("route", OPTIONS)
some = settings(max_examples=60, deadline=None, derandomize=True)

shapes = array_shapes(min_dims=2, max_dims=2, max_side=12)
heights = st.floats(-4, 0, width=16) | st.integers(-3, 0) | st.just(np.nan)
# Without a fill every element is drawn. With a fill most elements are equal (a plateau, or nan), with a few peaks and
# pits.
maps = arrays(float, shapes, elements=heights, fill=st.nothing()) | arrays(float, shapes, elements=heights)
seeds = st.integers(0, 10**6)
# Maps are squares, and rectangles longer in either direction up to the largest aspect.
spacings = st.just((0.3, 0.3)) | st.sampled_from([(0.3, 0.5), (0.3, 0.06), (0.1, 0.5)])
indenters = st.builds(Indenter, maps.filter(lambda array: np.isfinite(array).any()), spacings) | st.builds(
    self_affine_disc, st.floats(0, 1), st.integers(9, 17), seed=seeds
)


@st.composite
def pressings(draw):
    """Draw an indenter and depths, from a thousandth of its largest gap to a depth of almost complete contact."""
    indenter = draw(indenters)
    steps = draw(st.lists(st.integers(-25, 20), min_size=3, max_size=6, unique=True))
    return indenter, (np.nanmax(indenter.initial_gap) or indenter.spacing) * 1.3 ** np.sort(steps)


def press(indenter, depths, route):
    curve = indent(indenter, tolerance=TOLERANCE, depths=depths, options=OPTIONS[route])
    assert (curve.operator_applications > 0) == (route == "grid")
    return curve


# ---- the curve of one indenter ---------------------------------------------------------------------------------------


@both_routes
@given(pressings())
@settings(some, max_examples=100)
def test_complementarity_and_the_flat_punch_of_the_contact_set(route, pressing):
    """No tension, no overlap, no gap in contact, and no element that loses contact.

    k/G = 4π d Σq with K q = 1 on the set, and F/G = 4π d Σ q (u − g).
    """
    indenter, depths = pressing
    curve = press(indenter, depths, route)
    solver = ContactSolver(indenter, TOLERANCE, OPTIONS[route])
    place, scale = solver.elements.places_on_map(), 4 * np.pi * indenter.element_side
    matrix, initial_gap = influence_matrix(*place, indenter.aspect), indenter.initial_gap[place]
    contact, inside = solver.unloaded_state(), np.zeros(indenter.elements, dtype=bool)
    for i, depth in enumerate(depths):
        contact = solver.advance(contact, depth)
        pressure, solver_gap = np.zeros(indenter.elements), gap_map(solver, contact)[place]
        members, reduced_pressure, _ = contact.member_loads()
        pressure[members] = reduced_pressure * solver.units.pressure
        gap = matrix @ pressure * indenter.element_side / (4 * np.pi) - depth + initial_gap
        limit = TOLERANCE * depth
        # The solver adds its steps in single precision. The rounding error must stay far below the tolerance.
        np.testing.assert_allclose(solver_gap, gap, rtol=0, atol=0.05 * limit)

        before, inside = inside, np.isin(np.arange(indenter.elements), members)
        assert np.all(inside[before])
        assert np.all(pressure >= 0)
        assert np.all(solver_gap >= -limit)
        assert np.all(np.abs(solver_gap[inside]) <= limit)

        assert inside.sum() == curve.contact_count[i]
        tangent = np.linalg.solve(matrix[np.ix_(inside, inside)], np.ones(inside.sum()))
        np.testing.assert_allclose(curve.stiffness[i], scale * tangent.sum(), rtol=STIFFNESS)
        np.testing.assert_allclose(curve.force[i], scale * tangent @ (depth - initial_gap[inside]), rtol=FORCE)


strips = arrays(float, st.tuples(st.just(1), st.integers(100, 300)), elements=heights, fill=st.nothing())
long_strips = st.builds(Indenter, strips.filter(lambda array: np.isfinite(array).any()), spacings)
decades = st.floats(-5, -1)


@both_routes
@given(indenters | long_strips, decades)
@some
def test_whole_curve_ends_at_complete_contact(route, indenter, decade):
    tolerance = 10**decade
    curve = indent(indenter, tolerance=tolerance, until_fraction=1.0, options=OPTIONS[route])
    end = complete_contact(indenter)
    assert curve.contact_fraction[-1] == 1
    if np.ptp(indenter.initial_gap[np.isfinite(indenter.heights)]) > 0:  # otherwise contact is complete at any depth
        np.testing.assert_allclose(curve.depth[-1], end.depth, rtol=0.01 * tolerance)
    np.testing.assert_allclose(curve.force[-1], end.stiffness * (curve.depth[-1] - end.mean_gap), rtol=0.1 * tolerance)


@pytest.mark.filterwarnings("ignore:contact is complete")
@both_routes
@given(indenters | long_strips, decades, st.floats(0, 1))
@some
def test_pressures_at_a_force_are_zero_where_the_gap_is_open_and_nowhere_negative(route, indenter, decade, share):
    """The forces include exact levels, where an element just touches."""
    tolerance, options = 10**decade, OPTIONS[route]
    curve = indent(indenter, tolerance=tolerance, until_fraction=1.0, options=options)
    level = curve.force[round(share * (curve.force.size - 1))]
    contact = contact_at(indenter, force=level, tolerance=tolerance, options=options)
    inside = np.isfinite(indenter.heights)
    pressure, gap = contact.pressure[inside], contact.gap[inside]
    assert (pressure >= 0).all()
    assert (pressure[gap > tolerance * contact.depth] == 0).all()
    area = indenter.spacing * indenter.row_spacing
    np.testing.assert_allclose(pressure.sum() * area, level, rtol=1e-6)


# ---- one indenter and another ----------------------------------------------------------------------------------------


@both_routes
@given(pressings(), st.floats(-12, 12), st.floats(-12, 12))
@some
def test_scaling_laws(route, pressing, height_decades, size_decades):
    """The force is linear in heights and of second order in all lengths; the stiffness is linear in the size alone."""
    indenter, depths = pressing
    curve = press(indenter, depths, route)
    height, size = 10**height_decades, 10**size_decades
    higher = press(replace(indenter, heights=height * indenter.heights), height * depths, route)
    np.testing.assert_allclose(higher.force, height * curve.force, rtol=FORCE)
    np.testing.assert_allclose(higher.stiffness, curve.stiffness, rtol=STIFFNESS)
    spacings = size * indenter.spacing, size * indenter.row_spacing
    larger = press(Indenter(size * indenter.heights, spacings), size * depths, route)
    np.testing.assert_allclose(larger.force, size**2 * curve.force, rtol=FORCE)
    np.testing.assert_allclose(larger.stiffness, size * curve.stiffness, rtol=STIFFNESS)


# ---- penetration in time ---------------------------------------------------------------------------------------------
forces = st.lists(st.integers(0, 9), min_size=1, max_size=6)


@given(pressings(), forces, forces, st.integers(1, 5), st.floats(-6, 6))
@some
def test_depth_grows_under_a_force_and_is_constant_without_one(pressing, earlier, later, rest, decades):
    """The depth grows under a force, and is exactly constant without one."""
    indenter, depths = pressing
    curve = press(indenter, depths, "dense")
    force = np.array([*earlier, *np.zeros(1 + rest), *later, 1.0])
    times = np.linspace(0, 10**decades, force.size)
    viscosity = np.trapezoid(force, times) / curve.force[-1]  # the last level is reached at the end
    result = kinetics(curve, force, viscosity, times)
    # Between first contact and the first level the depth can be undetermined (nan).
    assert np.all(np.diff(result.depth[np.isfinite(result.depth)]) >= 0)
    assert np.all(result.velocity[(force > 0) & np.isfinite(result.velocity)] > 0)
    assert result.depth[-1] == pytest.approx(depths[-1], rel=1e-9)
    resting = slice(len(earlier), len(earlier) + 1 + rest)
    np.testing.assert_array_equal(result.depth[resting], result.depth[len(earlier)])
    np.testing.assert_array_equal(result.velocity[resting], 0)


@given(indenters, seeds)
@some
def test_kinetics_agrees_with_direct_integration_in_time(indenter, seed):
    """Integration from event to event in time gives the same depths as the correspondence with the elastic problem."""
    curve, events = indent(indenter, tolerance=TOLERANCE, until_fraction=1.0), newtonian_events(indenter)
    times = np.sort(np.random.default_rng(seed).random(30)) * curve.force[-1]
    np.testing.assert_allclose(kinetics(curve, 1.0, 1.0, times).depth, events.depth_at(times), rtol=1e-9)
