"""Averages of ensembles, on exact lines of dashpots that are counted and averaged independently of the module."""

import numpy as np
import pytest

from support.study import aggregate, line_curve
from viscorough.results.loading_curve import LoadingCurve
from viscorough_study.ensembles.averages import abscissa

pytestmark = pytest.mark.filterwarnings("error")


def line_stiffness(gaps, rms, x):
    """Return κ = N_touching/N at mean((u−g)₊) = X h, found by trying every number of touching points."""
    gaps = np.sort(gaps)
    touching = np.arange(1, gaps.size + 1)
    depth = (np.asarray(x)[:, None] * rms * gaps.size + np.cumsum(gaps)) / touching
    consistent = (depth > gaps) & (depth <= np.append(gaps[1:], np.inf))
    return touching[np.argmax(consistent, axis=1)] / gaps.size


@pytest.fixture
def gaps():
    """Return the gaps to the highest point of 12 rough lines of 40 points."""
    heights = np.random.default_rng(1).normal(size=(12, 40))
    return heights.max(axis=1, keepdims=True) - heights


def test_abscissa_is_made_of_multiples_and_contains_its_ends():
    x = abscissa(1e-7, 10, 20)
    assert x.size == 8 * 20 + 1
    np.testing.assert_allclose(x[[0, -1]], [1e-7, 10], rtol=1e-14)
    np.testing.assert_allclose(np.diff(np.log10(x)), 1 / 20, rtol=1e-10)
    assert np.isin(abscissa(3e-5, 0.2, 20), x).all()
    assert abscissa(1e-7, 30, 20)[-1] == pytest.approx(10**1.45)


@pytest.mark.parametrize("arguments", [(0, 1, 20), (2, 1, 20), (2, 3, 1)])
def test_invalid_abscissae_are_refused(arguments):
    with pytest.raises(ValueError, match=r"^abscissa: "):
        abscissa(*arguments)


def test_velocity_of_a_line_is_exact(gaps):
    x = abscissa(1e-3, 3, 20)
    rms = gaps.std(axis=1)
    ensemble = aggregate([line_curve(g) for g in gaps], {"line": rms}, 1.0, x, hurst=0.5, ensemble="lines")
    expected = np.array([line_stiffness(g, h, x) for g, h in zip(gaps, rms, strict=True)])
    assert 1 / 40 in expected  # in region (a) one point is in contact
    assert expected.max() > 0.9
    np.testing.assert_allclose(ensemble.stiffness.values[0], expected, rtol=1e-12)


def test_rms_conventions_shift_the_abscissa(gaps):
    """If h doubles, X halves at the same force: κ(X; 2h) = κ(2X; h)."""
    x = 2.0 ** np.arange(-10, 0)
    rms = {"disc": 1.0, "square": np.full(12, 2.0)}
    ensemble = aggregate([line_curve(g) for g in gaps], rms, 1.0, x, hurst=0.5, ensemble="a")
    disc, square = ensemble.stiffness.values
    np.testing.assert_allclose(square[:, :-1], disc[:, 1:], rtol=1e-12)


def test_contact_count_between_levels_is_linear_in_logarithms():
    depth = np.array([1.0, 2.0, 4.0])
    curve = LoadingCurve(depth, depth**2, 2 * depth, np.array([3, 12, 48]), 100, "cone", 1e-3, 0, 0 * depth)
    h, length = 0.5, 2.0
    x = np.array([1.0, 2.0, 4.0, 8.0, 16.0]) / (4 * h * length)  # at the levels, and half-way between them in ln F
    ensemble = aggregate([curve], {"disc": h}, length, x, hurst=0.5, ensemble="a")
    np.testing.assert_allclose(ensemble.contact_count.values[0, 0], [3, 6, 12, 24, 48], rtol=1e-12)


def test_averages_are_over_the_realizations_defined(gaps):
    x = abscissa(1e-3, 3, 10)
    curves = [line_curve(g, levels=20 if i < 4 else None) for i, g in enumerate(gaps)]  # four curves stop early
    ensemble = aggregate(curves, {"line": 1.0}, 1.0, x, hurst=0.5, ensemble="a")
    velocity, count = ensemble.velocity.values[0], ensemble.contact_count.values[0]
    assert np.array_equal(np.isnan(velocity), np.isnan(count))
    for j in range(x.size):
        v = velocity[~np.isnan(velocity[:, j]), j]
        mean = ensemble.isel(rms_convention=0, abscissa=j)
        assert mean.realizations_defined == v.size
        assert mean.fraction_defined == v.size / 12
        assert mean.velocity_arithmetic == pytest.approx(np.mean(v), rel=1e-12)
        assert mean.velocity_geometric == pytest.approx(np.prod(v) ** (1 / v.size), rel=1e-12)
        assert mean.velocity_spread == pytest.approx(np.std(np.log(v), ddof=1), rel=1e-9, abs=1e-12)
        assert mean.contact_count_median == np.median(count[~np.isnan(count[:, j]), j])
    assert set(ensemble.realizations_defined.values[0]) >= {8, 12}
    last = aggregate(curves[:1], {"line": 1.0}, 1.0, [0.1, 1e3], hurst=0.5, ensemble="a").isel(abscissa=1)
    assert last.realizations_defined == 0, "beyond all curves"
    assert all(np.isnan(last[name]) for name in ("velocity_arithmetic", "velocity_geometric", "contact_count_median"))
