"""The elastic loading path against exact solutions and against itself."""

import numpy as np
import pytest

from support.contract import refused
from viscorough import Indenter, SolverOptions, contact_at, indent, reference, self_affine_disc
from viscorough.basics.errors import AccuracyWarning, ConvergenceError
from viscorough.contact.prescribed_depth import ContactSolver
from viscorough.viscous.integration.events import newtonian_events


def observed_order(elements, errors):
    return -np.polyfit(np.log(elements), np.log(np.abs(errors)), 1)[0]


def grid_size(n, aspect):
    """Return odd numbers of rows and columns of about n² elements of aspect dy/dx on a square."""
    return (2 * round(n * stretch / 2) + 1 for stretch in (aspect**-0.5, aspect**0.5))


# ---- exact solutions (E* = 4G), with observed orders -----------------------------------------------------------------
@pytest.mark.parametrize(
    ("shape", "aspect"),
    [
        (reference.sphere(2.0), 1.0),
        (reference.cone(0.2), 1.0),
        (reference.PowerLawBody(1.0, 4.0), 1.0),
        (reference.sphere(2.0), 0.5),
        (reference.sphere(2.0), 5.0),
    ],
    ids=["sphere", "cone", "r⁴", "sphere on wide rectangles", "sphere on tall rectangles"],
)
def test_bodies_of_revolution_converge(shape, aspect):
    """The force is of second order, the contact radius and the stiffness of first order.

    The errors are means over depths, since the error at one depth depends on how the contact's edge cuts the grid.
    """
    depths = np.linspace(0.1, 0.2, 9)
    elements, errors = np.array([33, 65, 129]), []
    for n in elements:
        rows, columns = grid_size(n, aspect)
        indenter = shape.indenter(columns, width=2, rows=rows)
        curve = indent(indenter, tolerance=1e-6, depths=depths)
        radius = np.sqrt(curve.contact_count / np.pi) * indenter.element_side
        values = curve.force, curve.stiffness, radius
        exact = shape.force(depths), shape.stiffness(depths), shape.contact_radius(depths)
        errors.append(np.abs(np.divide(values, exact) - 1).mean(axis=1))
    force, stiffness, radius = np.transpose(errors)
    assert observed_order(elements, force) > 1.7
    assert observed_order(elements, stiffness) > 0.7
    assert observed_order(elements, radius) > 0.7
    assert force[-1] < 2e-4
    assert max(stiffness[-1], radius[-1]) < 1e-2


@pytest.mark.parametrize(("aspect", "ratio"), [(1.0, 1.0), (1.0, 0.5), (0.5, 0.5), (5.0, 0.5)])
def test_flat_ellipse_converges_at_first_order(aspect, ratio):
    """The error is a mean over sizes, since the error of one ellipse depends on how its edge cuts the grid."""
    elements, errors, majors = np.array([33, 65, 129]), [], np.linspace(0.8, 1.0, 7)
    for n in elements:
        rows, columns = grid_size(n, aspect)
        x, y = ((np.arange(m) - (m - 1) / 2) * 2 / m for m in (columns, rows))
        maps = [np.where((y[:, None] / ratio) ** 2 + x**2 <= major**2, 0.0, np.nan) for major in majors]
        curves = [indent(Indenter(heights, (2 / columns, 2 / rows)), tolerance=1e-4) for heights in maps]
        stiffness = np.array([curve.stiffness[0] for curve in curves])
        errors.append(np.sqrt(np.mean((stiffness / reference.flat_ellipse_stiffness(majors, ratio * majors) - 1) ** 2)))
    assert curves[0].force == pytest.approx(curves[0].stiffness * curves[0].depth, rel=1e-9)
    assert len(curves[0].depth) == 1
    assert 0.6 < observed_order(elements, errors) < 1.6
    assert errors[-1] < 6e-3


# ---- accuracy --------------------------------------------------------------------------------------------------------


def test_error_of_force_is_of_second_order_in_the_tolerance():
    disc = self_affine_disc(0.7, 65, seed=3)
    depths = np.array([0.8, 1.5, 3.0])
    exact = indent(disc, tolerance=1e-10, depths=depths).force
    for tolerance in (1e-2, 1e-3, 1e-4):
        curve = indent(disc, tolerance=tolerance, depths=depths)
        assert curve.residual.max() <= tolerance
        assert np.abs(curve.force / exact - 1).max() < 0.1 * tolerance


@pytest.mark.parametrize("tolerance", [0.1, 0.03, 1e-2, 1e-3])
def test_force_of_few_elements_on_the_grid_is_far_more_accurate_than_the_tolerance(tolerance):
    """With the normal stopping criterion, elements that overlap within the tolerance would carry much of the force."""
    on_grid = SolverOptions(dense_contacts=0)
    for across, hurst, seed in [(17, 0.4, 9), (33, 0.7, 10), (33, 0.4, 13), (65, 0.7, 14)]:
        disc = self_affine_disc(hurst, across, seed=seed)
        depths = np.nanmax(disc.initial_gap) * np.geomspace(0.02, 1, 12)
        exact = indent(disc, tolerance=1e-10, depths=depths).force
        curve = indent(disc, tolerance=tolerance, depths=depths, options=on_grid)
        assert curve.contact_count[0] < 10
        assert np.abs(curve.force / exact - 1).max() < 0.06 * tolerance


@pytest.mark.parametrize(("tolerance", "largest", "median"), [(1e-2, 2e-2, 1e-3), (1e-4, 2e-3, 1e-4)])
def test_error_of_stiffness_is_small_in_the_median(tolerance, largest, median):
    errors = []
    for hurst in (0.2, 0.8):
        disc = self_affine_disc(hurst, 129, seed=1)
        depths = np.nanmax(disc.initial_gap) * np.geomspace(0.15, 3, 12)
        exact = indent(disc, tolerance=1e-9, depths=depths)
        errors += list(np.abs(indent(disc, tolerance=tolerance, depths=depths).stiffness / exact.stiffness - 1))
    assert max(errors) < largest
    assert np.median(errors) < median


# ---- levels ----------------------------------------------------------------------------------------------------------
@pytest.mark.parametrize("hurst", [0.2, 0.8])
def test_interpolation_stays_within_the_tolerance(hurst):
    disc = self_affine_disc(hurst, 65, seed=4)
    curve = indent(disc, tolerance=1e-3, until_fraction=0.9)
    depths = np.geomspace(curve.depth[0], curve.depth[-1] * (1 - 1e-9), 200)
    fine = indent(disc, tolerance=1e-7, depths=depths)
    inside = fine.force < curve.force[-1]
    depth, stiffness = curve.at_force(fine.force[inside])
    assert np.abs(depth / fine.depth[inside] - 1).max() < 1e-3
    assert np.median(np.abs(stiffness / fine.stiffness[inside] - 1)) < 1e-3


def test_curve_stops_at_fraction_or_force():
    disc = self_affine_disc(0.8, 65, seed=4)
    by_fraction = indent(disc, until_fraction=0.3)
    assert 0.3 <= by_fraction.contact_fraction[-1] < 0.6
    assert by_fraction.contact_fraction[-2] < 0.3
    by_force = indent(disc, until_force=2.0)
    assert 2.0 <= by_force.force[-1] < 2.2
    assert by_force.force[-2] < 2.0


@pytest.mark.parametrize("seed", range(8))
def test_curve_until_a_force_has_one_level_at_it(seed):
    """Rounding neither leaves the last level below the force nor adds a second level just beyond it."""
    random = np.random.default_rng(seed)
    disc = self_affine_disc(random.random(), 33, rms=0.05, seed=seed)
    for force in (10.0 ** random.uniform(-4, 0), np.float32(10.0 ** random.uniform(-4, -1))):
        for tolerance in (1e-2, 1e-5):
            curve = indent(disc, tolerance=tolerance, until_force=force)
            assert curve.force[-1] >= float(force)
            assert (curve.force[:-1] < float(force) * (1 - 1e-6)).all()


@pytest.mark.parametrize("end", [{"until_fraction": 1e-300}, {"until_fraction": 1.0, "until_force": 1e-300}])
def test_curve_that_ends_at_once_has_its_first_level(end):
    disc = self_affine_disc(0.6, 33, seed=1)
    curve, whole = indent(disc, **end), indent(disc)
    np.testing.assert_array_equal(curve.depth, whole.depth[:1])
    np.testing.assert_array_equal(curve.force, whole.force[:1])


@pytest.mark.parametrize(("seed", "share"), [(1, 0.8), (2, 0.9), (3, 0.9), (4, 0.9)])
def test_curve_that_ends_at_a_force_does_without_complete_contact(monkeypatch, seed, share):
    """At a loose tolerance the last contact may be complete, but the force at which to stop is reached."""
    disc = self_affine_disc(0.7, 33, seed=seed)
    fine = indent(disc, until_fraction=0.98)
    force = np.interp(share, fine.contact_fraction, fine.force)
    monkeypatch.setattr(
        ContactSolver, "solve_complete_contact", lambda solver: pytest.fail("complete contact was computed")
    )
    curve = indent(disc, tolerance=0.1, until_fraction=1.0, until_force=force)
    assert curve.force[-1] >= force
    assert curve.depth[-1] == pytest.approx(fine.at_force(curve.force[-1])[0], rel=0.1)


def test_first_contact_events_are_levels_at_every_tolerance():
    curve = indent(self_affine_disc(0.7, 33, seed=1), tolerance=0.1)
    assert curve.contact_count[:39].tolist() == list(range(1, 40))


def test_first_level_is_one_element_in_contact():
    disc = self_affine_disc(0.8, 65, seed=4)
    curve = indent(disc, until_fraction=0.01)
    stiffness = 4 * reference.one_element_stiffness(65)
    assert curve.contact_count[0] == 1
    assert curve.stiffness[0] == pytest.approx(stiffness, rel=1e-12)
    assert curve.force[0] == pytest.approx(stiffness * curve.depth[0], rel=1e-12)


# ---- refusals --------------------------------------------------------------------------------------------------------
def test_invalid_arguments_are_refused():
    for arguments, message in (
        ({"tolerance": 0.0}, "tolerance"),
        ({"until_fraction": 1.5}, "until"),
        ({"until_force": -1.0}, "until_force"),
        ({"depths": [0.2, 0.1]}, "each larger than the one before"),
        ({"depths": []}, "finite"),
        ({"indenter": Indenter(np.zeros(5), 1.0)}, "two-dimensional"),
        ({"forces": [0.0, 1.0]}, "argument forces: allowed is one row of finite numbers above 0"),
        ({"forces": [1.0], "depths": [1.0]}, "indent: depths and forces exclude each other"),
    ):
        with pytest.raises(ValueError, match=message):
            indent(**({"indenter": self_affine_disc(0.5, 9, seed=1)} | arguments))


def test_missing_convergence_raises():
    few = SolverOptions(dense_contacts=0, max_iterations=2)
    with pytest.raises(ConvergenceError, match="residual"):
        indent(self_affine_disc(0.5, 33, seed=1), tolerance=1e-8, depths=[1.0], options=few)


@pytest.mark.parametrize(("across", "centre"), [(24, (11.5, 11.5)), (33, (15.7, 16.2))])
def test_levels_of_a_paraboloid_increase_and_are_finite(across, centre):
    squares = np.square(np.arange(across) - np.array(centre)[:, None])
    paraboloid = Indenter(-np.add.outer(*squares) / 200, 1.0)
    curve = indent(paraboloid, tolerance=1e-3, start_fraction=0.7, until_fraction=0.95)
    for values in (curve.depth, curve.force):
        assert np.isfinite(values).all()
        assert (np.diff(values, prepend=0) > 0).all()
    assert curve.contact_fraction[-1] >= 0.95
    assert np.count_nonzero(curve.contact_fraction < 0.35) < 12  # levels before the start only lead up to it


def test_last_interval_of_a_small_curve_is_as_accurate_as_the_others():
    indenter = Indenter(np.array([[0.52, 0.08, 0.73], [0.7, 0.74, 0.85], [0.22, 0.55, 0.55]]), 1.0)
    curve, events = indent(indenter, tolerance=1e-5, until_fraction=0.5), newtonian_events(indenter)
    force = np.linspace(0, curve.force[-1], 200)[1:]
    np.testing.assert_allclose(curve.at_force(force)[0], events.depth_at(force), rtol=1e-5)


def test_curve_is_undetermined_below_a_first_depth_with_several_contacts():
    """The roughness is smaller than the tolerance times the depth, and still bends the curve at small forces."""
    indenter = Indenter(9e-4 * np.random.default_rng(0).random((20, 20)), 1.0)
    curve = indent(indenter, tolerance=1e-3, depths=[1.0, 2.0])
    depth, stiffness = curve.at_force(curve.force[0] * np.array([0.0, 0.01, 0.5, 1.0]))
    np.testing.assert_allclose(depth, [0.0, np.nan, np.nan, 1.0])
    assert np.isnan(stiffness[1:3]).all()


@pytest.mark.parametrize("depths", [None, [0.5, 1.5]])
def test_elements_of_one_height_give_a_straight_curve_from_the_origin(depths):
    """The contact is solved on the grid, where forces are accurate to the tolerance only."""
    plateau = Indenter(np.where(np.random.default_rng(0).random((40, 40)) < 0.5, 0.0, -2.0), 1.0)
    curve = indent(plateau, tolerance=1e-2, depths=depths)
    assert curve.operator_applications > 0
    depth, stiffness = curve.at_force(curve.force[0] * np.array([0.01, 0.5]))
    np.testing.assert_allclose(depth, curve.depth[0] * np.array([0.01, 0.5]), rtol=1e-12)
    np.testing.assert_array_equal(stiffness, curve.stiffness[0])


def test_element_that_touches_late_in_a_converged_step_joins():
    heights = np.zeros((9, 9))
    heights[4, 4] = -1.0  # the tangent leads to the solution until this pit touches
    pit = Indenter(heights, 1.0)
    gap_rate = (contact_at(pit, depth=0.1, tolerance=1e-6).gap[4, 4] - 1.0) / 0.1
    touch = -1.0 / gap_rate
    on_grid = SolverOptions(dense_contacts=0, dense_interactions=0)
    curve = indent(pit, depths=[0.5 * touch, 1.05 * touch], options=on_grid)
    np.testing.assert_array_equal(curve.contact_count, [80, 81])
    assert curve.residual[-1] <= 1e-3


def test_levels_closer_than_the_accuracy_are_refused():
    disc, steps = self_affine_disc(0.7, 65, rms=0.01, seed=1), np.arange(12)
    with refused(r"argument depths: 0\.02000002\d* and 0\.02000004\d* are closer than the accuracy"):
        indent(disc, depths=0.02 * (1 + 1e-6 * steps), tolerance=0.1)
    for name in ("depths", "forces"):
        assert indent(disc, **{name: 0.02 * (1 + 1e-3 * steps)}, tolerance=0.1).depth.size == steps.size


@pytest.mark.parametrize("tolerance", [1e-1, 1e-2, 1e-4])
@pytest.mark.parametrize("until_fraction", [0.1, 0.3, 0.9])
def test_curve_ends_close_to_the_contact_fraction(tolerance, until_fraction):
    """Without short last steps, the curve of the second disc to 1e-1 ends at 0.55 instead of 0.3."""
    for hurst, seed in ((0.2, 7), (0.46, 15)):
        curve = indent(self_affine_disc(hurst, 65, seed=seed), tolerance=tolerance, until_fraction=until_fraction)
        assert until_fraction <= curve.contact_fraction[-1] < until_fraction + 0.03


def test_elements_that_touch_at_once_beyond_the_end_are_a_warning():
    """Around a punch, the heights follow the surface that it deflects, so that all of them touch at the same depth."""
    heights = np.full((30, 30), -10.0)
    heights[10:20, 10:20] = 0.0
    conformal = Indenter(heights + contact_at(Indenter(heights, 1.0), depth=0.5, tolerance=1e-10).gap, 1.0)
    with pytest.warns(AccuracyWarning, match=r"contact fraction of 1, beyond argument until_fraction 0\.3; too many"):
        curve = indent(conformal, until_fraction=0.3)
    assert curve.contact_fraction[-2] < 0.3
