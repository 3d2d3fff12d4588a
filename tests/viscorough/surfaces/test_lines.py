"""Lines of many realizations: heights in order and in any order, against numpy's transform of the same waves."""

import numpy as np
import pytest

from viscorough import self_affine_line
from viscorough.mdr import reduce, reduce_heights
from viscorough.surfaces import line_waves
from viscorough.surfaces.lines import SelfAffineLines


def by_numpy(points, hurst, seed, *, fixed):
    """Compute heights of rms 1 in double precision."""
    key = line_waves.key_of(np.random.SeedSequence(seed))
    wavenumber = np.arange(points // 2 + 1.0)
    amplitude = np.maximum(wavenumber, 1) ** -(hurst + 0.5)
    coefficients = line_waves.waves(0, key, amplitude, fixed=fixed)
    coefficients[0] = 0
    if points % 2 == 0:
        coefficients[-1] = line_waves.shortest_wave(points, key, amplitude[-1], fixed=fixed)
    heights = np.fft.irfft(coefficients, points, norm="forward")
    return heights / np.sqrt(np.mean(heights**2))


@pytest.mark.parametrize("amplitudes", ["random", "fixed"])
# The lengths are the smallest, odd numbers, twice a prime, the square of a prime, and several blocks of waves.
@pytest.mark.parametrize(
    "points", [2, 3, 4, 6, 257, 1000, 2 * 1009, 101**2, 2**15, 2 * 3 * 7 * 11 * 13, 50_001, 2 * 99_991]
)
def test_lines_of_any_length_agree_with_numpy(points, amplitudes):
    exact = by_numpy(points, 0.6, 4, fixed=amplitudes == "fixed")
    for dtype, atol in ((np.float32, 4e-6), (np.float64, 1e-12)):
        heights = SelfAffineLines(0.6, points, amplitudes=amplitudes, dtype=dtype).heights(4)
        assert heights.dtype == dtype
        np.testing.assert_allclose(heights, exact, atol=atol)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("points", [1000, 1001, 2 * 1009])
def test_any_order_has_the_same_heights(points, dtype):
    lines = SelfAffineLines(0.4, points, rms=0.2, length=3.0, dtype=dtype)
    first, second = lines.heights(1), lines.heights_in_any_order(2).copy()
    kept = first.copy()
    np.testing.assert_array_equal(np.sort(lines.heights_in_any_order(1)), np.sort(first))
    np.testing.assert_array_equal(np.sort(lines.heights(2)), np.sort(second))
    np.testing.assert_array_equal(lines.heights(1), first)
    np.testing.assert_array_equal(first, kept, "lines that are kept are not overwritten")
    assert not lines.heights_in_any_order(1).flags.writeable

    line = self_affine_line(0.4, points, rms=0.2, length=3.0, dtype=dtype, seed=1)
    np.testing.assert_array_equal(line.heights, first)
    assert line.heights.dtype == dtype
    assert line.spacing == lines.spacing == 3.0 / points
    assert np.std(line.heights, dtype=float) == pytest.approx(0.2, rel=1e-6 if dtype == np.float32 else 1e-12)
    curve = reduce_heights(lines.heights_in_any_order(1), lines.spacing, until_force=10.0)
    expected = reduce(line, until_force=10.0)
    np.testing.assert_array_equal(curve.contact_count, expected.contact_count)
    np.testing.assert_array_equal(curve.depth[:-1], expected.depth[:-1])
    np.testing.assert_allclose(curve.force, expected.force, rtol=1e-12)
