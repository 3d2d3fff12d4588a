"""MDR of lines against sums over their sorted gaps, and lines of maps against the spectra of the maps."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from support.contract import refused
from viscorough.mdr import line_of_map, line_of_surface, reduce, reduce_heights
from viscorough.surfaces.indenter import Indenter
from viscorough.surfaces.lines import self_affine_line
from viscorough.surfaces.self_affine import cut_disc, self_affine_square


def assert_exact(curve, line):
    """Compare with F/G and the number of points in contact at every depth, from sums over all points."""
    pressed = curve.depth[:, None] - line.initial_gap.astype(float)
    count, force = (pressed > 0).sum(axis=1), 4 * line.spacing * np.clip(pressed, 0, None).sum(axis=1)
    np.testing.assert_array_equal(curve.contact_count, count)
    np.testing.assert_allclose(curve.stiffness, 4 * line.spacing * count, rtol=1e-15)
    # F is the difference of two sums that may cancel to the width of a bin: 1e-16 x 64 x a safety of 100.
    np.testing.assert_allclose(curve.force, force, rtol=1e-12)
    assert np.all(np.diff(curve.depth) > 0)
    assert curve.depth[0] > 0


@given(
    arrays(
        st.sampled_from([np.float32, np.float64]),
        st.integers(1, 40),
        elements=st.floats(-1000, 1000, width=32, allow_subnormal=False) | st.sampled_from([0.0, 1.0, 1.5]),
    )
)
@settings(max_examples=80, deadline=None)
@example(np.array([0.0, -0.0], dtype=np.float32))
def test_any_line_is_reduced_exactly(heights):
    """The lines have ties, plateaus, spikes, one point, and zeros of either sign."""
    line = Indenter(heights, 0.5)
    curve = reduce(line)
    assert curve.depth.size >= 2
    assert curve.contact_count[-1] == heights.size
    assert_exact(curve, line)


def test_curve_stops_at_fraction_or_force():
    line = self_affine_line(0.5, 1000, seed=2)
    full, part = reduce(line), reduce(line, until_fraction=0.25)
    assert part.contact_fraction[-1] >= 0.25 > part.contact_fraction[-2]
    np.testing.assert_array_equal(part.force, full.force[: part.force.size])

    force = 0.01 * full.force[-1]
    early = reduce(line, until_fraction=0.25, until_force=force)
    assert early.force[-1] >= force > early.force[-2]
    assert reduce(line, until_fraction=0.25, until_force=1e9).depth.size == part.depth.size

    beyond = reduce(line, until_force=10 * full.force[-1])
    np.testing.assert_array_equal(beyond.force, np.append(full.force, 10 * full.force[-1]))
    assert_exact(beyond, line)


def test_curve_ends_at_the_level_with_exactly_the_fraction_or_force():
    line = Indenter(-np.arange(8.0), 0.5)
    full = reduce(line)
    for level in range(2, full.depth.size):
        fraction, force = full.contact_fraction[level], full.force[level]
        first = np.argmax(full.contact_fraction == fraction)  # the count can be the same at several levels
        limits = {"until_fraction": fraction} | ({"until_force": 1e9} if fraction < 1 else {})
        np.testing.assert_array_equal(reduce(line, **limits).force, full.force[: max(first, 1) + 1])
        np.testing.assert_array_equal(reduce(line, until_force=force).force, full.force[: level + 1])


def test_invalid_options_are_refused():
    for options, message in (
        ({"until_fraction": 0}, "argument until_fraction must lie in"),
        ({"until_force": 0}, "argument until_force: must be a positive number"),
    ):
        with refused(message):
            reduce(self_affine_line(0.5, 10, seed=1), **options)


@pytest.mark.parametrize(("place", "value"), [(0, np.nan), (500, np.inf), (-1, -np.inf)])
def test_heights_without_bins_are_refused(place, value):
    heights = np.random.default_rng(1).random(1000, np.float32)
    heights[place] = value
    with pytest.raises(ValueError, match="reduce: heights must be finite"):
        reduce_heights(heights, 1.0)
    with pytest.raises(ValueError, match="one-dimensional"):
        reduce(Indenter(np.zeros((3, 3)), 1.0))


# ---- lines of maps


def octave_means(heights):
    """Return the power spectrum of a line, averaged over octaves, from two waves per length on."""
    power = np.abs(np.fft.rfft(heights)) ** 2
    edges = 2 ** np.arange(1, int(np.log2(power.size)) + 1)
    return np.array([power[a:b].sum() for a, b in zip(edges, 2 * edges, strict=True)])


@pytest.mark.parametrize(("hurst", "outline"), [(0.2, "disc"), (0.9, "square"), (0.9, "disc")])
def test_line_of_a_map_has_its_spectrum(hurst, outline):
    """The line of the whole periodic square has the exact spectrum. Without a window short waves are 50 times off."""
    n, lines, exact = 256, [], []
    for seed in range(12):
        square = self_affine_square(hurst, n, seed=seed)
        map_ = square if outline == "square" else cut_disc(square, n)
        lines.append(octave_means(line_of_map(Indenter(map_, 0.1), 1).heights))
        exact.append(octave_means(line_of_surface(square, 0.1, 1).heights))
    ratio = np.sum(lines, axis=0) / np.sum(exact, axis=0)
    np.testing.assert_allclose(ratio, 1, atol=0.25)


@pytest.mark.parametrize("scale", [1e-300, 0.5, 1.7e308])
def test_line_of_a_map_has_its_rms_height_unit_and_length(scale):
    map_ = np.pad(self_affine_square(0.7, 64, seed=1)[:40], 3, constant_values=np.nan)
    line = line_of_map(Indenter(map_, scale, row_spacing=scale / 2, length_unit="m"), 3)
    assert line.heights.std() == pytest.approx(np.nanstd(map_), rel=1e-12)
    assert (line.length_unit, line.spacing) == ("m", scale)
    assert line.heights.shape == (70,)  # 70 columns are longer than 46 rows, which are half as far apart
    other = line_of_map(Indenter(map_, 1.0, row_spacing=0.5), 3)
    np.testing.assert_array_equal(line.heights, other.heights)
    assert line_of_map(Indenter(map_.T, 1.0), [3, 4]).heights.shape == (70,)


def test_maps_without_a_spectrum_are_refused():
    for heights, what in (
        (np.zeros((8, 8)), "the map is flat"),
        (1e300 * np.eye(8), "its squares overflow"),
        (np.zeros(8), "must be two-dimensional"),
    ):
        with pytest.raises(ValueError, match=what):
            line_of_map(Indenter(heights, 1.0), 1)
