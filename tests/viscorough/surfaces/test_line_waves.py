"""Random waves of lines: published outputs of the generator, the formula in numpy, statistics of many waves."""

import numpy as np
from scipy import stats

from viscorough.surfaces import line_waves
from viscorough.surfaces.line_waves import key_of, random_words, shortest_wave, waves

KEY = key_of(np.random.SeedSequence(7))
MANY = 2**18


def test_generator_gives_the_published_answers():
    """The answers for philox2x32 with ten rounds are Random123's (tests/kat_vectors): counter, key, answer."""
    for counter, key, answer in (
        ((0, 0), 0, (0xFF1DAE59, 0x6CD10DF2)),
        ((0xFFFFFFFF, 0xFFFFFFFF), 0xFFFFFFFF, (0x2C3F628B, 0xAB4FD7AD)),
        ((0x243F6A88, 0x85A308D3), 0x13198A2E, (0xDD7CE038, 0xF62A4C12)),
    ):
        low, high = np.empty((2, 1), np.uint32)
        random_words(counter[0], np.array([key, counter[1]], np.uint64), low, high)
        assert (low[0], high[0]) == answer


def test_waves_depend_on_their_number_and_key_alone():
    together = waves(1, KEY, np.ones(50), fixed=False)
    for first, last in ((1, 1), (7, 26), (50, 50)):
        alone = waves(first, KEY, np.ones(last - first + 1), fixed=False)
        np.testing.assert_array_equal(alone, together[first - 1 : last])
    other = waves(1, key_of(np.random.SeedSequence(8)), np.ones(50), fixed=False)
    assert len(np.intersect1d(together, other)) == 0


def test_coefficients_are_gaussian():
    """The test takes real and imaginary parts of many waves. Each line has a false alarm with a chance of 1e-4."""
    drawn = waves(1, KEY, np.ones(MANY), fixed=False)
    real, imag = drawn.real, drawn.imag
    normal = np.concatenate([real, imag])
    assert stats.kstest(normal, "norm").pvalue > 1e-4
    for power, moment, variance in ((1, 0, 1), (2, 1, 2), (3, 0, 15), (4, 3, 96), (6, 15, 10170)):
        assert abs(np.mean(normal**power) - moment) < 4 * np.sqrt(variance / normal.size)
    for x, y in ((real, imag), (real**2 - 1, imag**2 - 1), (real[1:], real[:-1]), (real[1:], imag[:-1])):
        assert abs(np.mean(x * y)) < 5 * np.sqrt(np.var(x) * np.var(y) / x.size)


def test_shortest_wave_has_the_same_mean_power_as_the_others():
    """This wave is a cosine of modulus √2 A times a normal variate; with fixed amplitudes, A with a random sign."""
    keys = [key_of(np.random.SeedSequence(seed)) for seed in range(2000)]
    drawn = np.array([shortest_wave(8, key, 3.0, fixed=False) for key in keys])
    assert stats.kstest(drawn / (3 * np.sqrt(2)), "norm").pvalue > 1e-4
    fixed = np.array([shortest_wave(8, key, 3.0, fixed=True) for key in keys])
    np.testing.assert_allclose(abs(fixed), 3, rtol=1e-15)
    assert abs(np.mean(np.sign(fixed))) < 4 / np.sqrt(len(keys))


def test_smallest_and_largest_moduli_are_finite():
    size, modulus = np.array([0, 1, 2**31, 2**32 - 1], np.uint32), np.empty(4, np.float32)
    line_waves._moduli(size, np.ones(4, np.float32), modulus)
    np.testing.assert_allclose(modulus, np.sqrt(-2 * np.log((size + 0.5) * 2.0**-32)), rtol=3e-7, atol=3e-4)
