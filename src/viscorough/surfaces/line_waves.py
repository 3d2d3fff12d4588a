"""Compute the random waves of a self-affine line from a counter-based random generator.

Wave k gets two 32-bit random numbers from the counter k alone (Philox2x32 with ten rounds, J. K. Salmon et al.,
Parallel random numbers: as easy as 1, 2, 3, 2011). They depend neither on the order nor on the number of waves computed
at a time. They determine a phase φ and a number U in (0, 1), and the complex Gaussian coefficient (Box and Muller)
    X_k = A_k √(-2 ln U) exp(iφ)
with the modulus A_k of the spectrum. With fixed amplitudes the coefficient is A_k exp(iφ).
`waves` is this formula in double precision. The compiled functions compute it in single precision for lines of an even
number of points, with polynomials for logarithm, sine and cosine, because the compiler can vectorize those.
"""

import numpy as np

from viscorough.basics.compilation import njit
from viscorough.basics.types import Array, Complex, Integers

# Largest counter of the generator.
MOST_WAVES = 2**32 - 1
# Waves computed at a time, so that their arrays stay in the fastest cache.
_BLOCK = 1024
# Numba computes in exactly these types.
_U64, _U32, _I32, _F32 = np.uint64, np.uint32, np.int32, np.float32

_ROUNDS, _MULTIPLIER, _WEYL, _LOW = 10, _U64(0xD256D193), _U64(0x9E3779B9), _U64(0xFFFFFFFF)
# Polynomials of S. Moshier's Cephes library for single precision, relative errors of 1e-7: (ln(1+z) - z + z²/2) / z³,
# (sin x - x) / x³ and (cos x - 1) / x² for |x| <= π/4.
_LOG = tuple(
    _F32(c)
    for c in (
        7.0376836292e-2,
        -1.1514610310e-1,
        1.1676998740e-1,
        -1.2420140846e-1,
        1.4249322787e-1,
        -1.6668057665e-1,
        2.0000714765e-1,
        -2.4999993993e-1,
        3.3333331174e-1,
    )
)
_SINE = tuple(_F32(c) for c in (-1.9515295891e-4, 8.3321608736e-3, -1.6666654611e-1))
_COSINE = tuple(_F32(c) for c in (2.443315711809948e-5, -1.388731625493765e-3, 4.166664568298827e-2, -0.5))
_LN2, _ONE, _HALF, _TWO, _BITS = _F32(np.log(2)), _F32(1), _F32(0.5), _F32(2), _F32(32)
_EIGHTH_TURN = _F32(np.pi / 4 * 2.0**-31)
# Bits of √(1/2) in single precision, and number of bits of a mantissa.
_ROOT_HALF, _MANTISSA = _I32(0x3F3504F3), _I32(23)


def key_of(seed_sequence: np.random.SeedSequence) -> Integers:
    """Return the key of the random numbers: two 32-bit numbers."""
    return seed_sequence.generate_state(2, np.uint32).astype(np.uint64)


def waves(first: int, key: Integers, amplitude: Array, *, fixed: bool) -> Complex:
    """Return the coefficients X_k of the waves k = first, first + 1, ... in double precision, shape of `amplitude`.

    first : number of the first wave, at least 0
    key : key of the realization, from `key_of`
    amplitude : moduli A_k of the waves
    fixed : True if the moduli of X_k are exactly A_k, False if they are random
    """
    direction, size = np.empty((2, len(amplitude)), np.uint32)
    random_words(first, key, direction, size)
    modulus = amplitude if fixed else amplitude * np.sqrt(-2 * np.log((size + 0.5) * 2.0**-32))
    return modulus * np.exp(2j * np.pi * 2.0**-32 * direction)


@njit(fastmath=True)
def random_words(first, key, low, high):
    """Fill `low` and `high` with the random numbers of the counters first, first + 1, ... (Philox2x32-10).

    key : key of the generator, and upper half of its counter
    """
    for i in range(low.size):
        left, right, round_key = _U64(first + i), key[1], key[0]
        for _ in range(_ROUNDS):
            product = left * _MULTIPLIER
            left = (product >> _U64(32)) ^ round_key ^ right
            right = product & _LOW
            round_key = (round_key + _WEYL) & _LOW
        low[i] = _U32(left)
        high[i] = _U32(right)


def shortest_wave(points: int, key: Integers, amplitude: float, *, fixed: bool) -> float:
    """Return the real coefficient of wave n/2 of a line of an even number n of points.

    This wave equals its mirror image, so it is a cosine. Its mean power is the same as with a random phase.

    amplitude : modulus of the wave
    """
    wave = waves(points // 2, key, np.array([amplitude]), fixed=fixed)[0]
    return np.copysign(abs(wave), wave.real) if fixed else np.sqrt(2) * wave.real


def fill_packed_spectrum(spectrum: Complex, key: Integers, amplitude: Array, *, fixed: bool) -> float:
    """Fill `spectrum` with the spectrum of a line of pairs of points; return the mean square of the heights.

    spectrum : Z, shape (m,), complex, single precision, for a line of n = 2m points
    key, fixed : arguments of `waves`
    amplitude : moduli A_k of the waves k = 0, 1, ..., m in single precision; there is no wave k = 0

    The complex transform of Z of length m, with positive exponents and without a factor, is y_2j + i y_2j+1 for the
    real line y of the waves X_k:
        Z_k = X_k + X*_(m-k) + i exp(iπk/m) (X_k - X*_(m-k)).
    """
    half = len(spectrum)
    shortest = shortest_wave(2 * half, key, amplitude[half], fixed=fixed)
    spectrum[0] = shortest * (1 - 1j)
    square = _fill_pairs(spectrum, key, amplitude, fixed)
    if half % 2 == 0:
        middle = waves(half // 2, key, amplitude[half // 2 : half // 2 + 1], fixed=fixed)[0]
        spectrum[half // 2] = 2 * np.conj(middle)
        square += abs(middle) ** 2
    return 2 * square + shortest**2


@njit
def _fill_pairs(spectrum, key, amplitude, fixed):
    """Fill Z_k and Z_(m-k) for 0 < k < m/2 block by block; return the sum of the squares of the moduli."""
    half, square = spectrum.size, 0.0
    turn = _U64(2.0**63 / half)  # half a turn over m
    longer, shorter = np.empty((2, _BLOCK), np.float32), np.empty((2, _BLOCK), np.float32)
    rotation = np.empty((2, _BLOCK), np.float32)
    for start in range(1, (half + 1) // 2, _BLOCK):
        size = min(_BLOCK, (half + 1) // 2 - start)
        mirrored = half - start - size + 1  # the first of the waves m - k
        square += _draw(start, key, amplitude[start : start + size], fixed, longer)
        square += _draw(mirrored, key, amplitude[mirrored : mirrored + size], fixed, shorter)
        _unit_vectors(start, turn, rotation)
        _pack(longer, shorter, rotation, size)
        _store(longer, spectrum[start : start + size])
        _store(shorter, spectrum[mirrored : mirrored + size])
    return square


@njit(inner=True)
def _draw(first, key, amplitude, fixed, parts):
    """Compute the parts of X_k for k = first, first + 1, ...; return the sum of the squares of the moduli."""
    direction, size = np.empty(amplitude.size, np.uint32), np.empty(amplitude.size, np.uint32)
    random_words(first, key, direction, size)
    if fixed:
        return _polar(direction, amplitude, parts)
    modulus = np.empty(amplitude.size, np.float32)
    _moduli(size, amplitude, modulus)
    return _polar(direction, modulus, parts)


@njit(fastmath=True)
def _moduli(size, amplitude, modulus):
    """Compute the moduli A √(-2 ln U) with U = (size + 1/2) / 2^32."""
    for i in range(size.size):
        modulus[i] = amplitude[i] * np.sqrt(_TWO * _minus_log(size[i]))


@njit(inner=True, fastmath=True)
def _polar(direction, modulus, parts):
    """Compute the parts of numbers of this modulus and direction; return the sum of the squared moduli."""
    square = _F32(0)
    for i in range(direction.size):
        cosine, sine = _cos_sin(direction[i])
        parts[0, i], parts[1, i] = modulus[i] * cosine, modulus[i] * sine
        square += modulus[i] * modulus[i]
    return square


@njit(inner=True, fastmath=True)
def _unit_vectors(first, turn, parts):
    """Compute the real and imaginary parts of exp(2πi (first + i) turn / 2^64)."""
    for i in range(parts.shape[1]):
        parts[0, i], parts[1, i] = _cos_sin(_U32(_U64(first + i) * turn >> _U64(32)))


@njit(inner=True, fastmath=True)
def _pack(longer, shorter, rotation, size):
    """Overwrite the parts of X_k and of X_(m-k), the latter in reverse order, by the parts of Z_k and Z_(m-k).

    With S = X_k + X*_(m-k) and W = i exp(iπk/m) (X_k - X*_(m-k)): Z_k = S + W and Z_(m-k) = (S - W)*.
    """
    for i in range(size):
        j = _U64(size - 1 - i)  # unsigned: no check for negative indices, so that the loop is vectorized
        sum_real, sum_imag = longer[0, i] + shorter[0, j], longer[1, i] - shorter[1, j]
        real, imag = longer[0, i] - shorter[0, j], longer[1, i] + shorter[1, j]
        turned_real = -rotation[1, i] * real - rotation[0, i] * imag
        turned_imag = rotation[0, i] * real - rotation[1, i] * imag
        longer[0, i], longer[1, i] = sum_real + turned_real, sum_imag + turned_imag
        shorter[0, j], shorter[1, j] = sum_real - turned_real, turned_imag - sum_imag


@njit(inner=True, fastmath=True)
def _store(parts, numbers):
    for i in range(numbers.size):
        numbers[i] = complex(parts[0, i], parts[1, i])


@njit
def twiddle(spectrum, factor):
    """Multiply spectrum[j, k] in place by factor exp(2πi jk/m), with m the size of the spectrum.

    spectrum : complex, single precision, as pairs of real numbers; shape (rows, 2 columns)
    """
    rows, columns = spectrum.shape[0], spectrum.shape[1] // 2
    rotation = np.empty((2, columns), np.float32)
    for j in range(rows):
        _unit_vectors(0, _U64(2.0**64 / (rows * columns) * j), rotation)
        _rotate(spectrum[j], rotation, factor)


@njit(inner=True, fastmath=True)
def _rotate(pairs, rotation, factor):
    """Multiply complex numbers, stored as pairs of real numbers, by other complex numbers."""
    for i in range(rotation.shape[1]):
        j, k = _U64(2 * i), _U64(2 * i + 1)
        cosine, sine = factor * rotation[0, i], factor * rotation[1, i]
        real, imag = pairs[j], pairs[k]
        pairs[j], pairs[k] = real * cosine - imag * sine, real * sine + imag * cosine


@njit(inner=True, fastmath=True)
def _cos_sin(direction):
    """Return cosine and sine of the angle direction / 2^32 of a turn, from an angle within an eighth of a turn."""
    quadrant = _U32(_U32(direction + _U32(1 << 29)) >> _U32(30))
    x = _F32(_I32(_U32(direction << _U32(2)))) * _EIGHTH_TURN
    square = x * x
    sine = x + x * square * ((_SINE[0] * square + _SINE[1]) * square + _SINE[2])
    cosine = ((_COSINE[0] * square + _COSINE[1]) * square + _COSINE[2]) * square + _COSINE[3]
    cosine = _ONE + square * cosine
    odd = (quadrant & _U32(1)) != _U32(0)
    along, across = (sine, cosine) if odd else (cosine, sine)
    along = -along if (quadrant == _U32(1)) | (quadrant == _U32(2)) else along
    return along, -across if quadrant > _U32(1) else across


@njit(inner=True, fastmath=True)
def _minus_log(size):
    """Return -ln((size + 1/2) / 2^32) from the exponent and the mantissa of size + 1/2."""
    bits = np.float32(_F32(size) + _HALF).view(np.int32)
    exponent = (bits - _ROOT_HALF) >> _MANTISSA  # with mantissas from √(1/2) to √2
    z = np.int32(bits - (exponent << _MANTISSA)).view(np.float32) - _ONE
    cubic = _LOG[0]
    for c in _LOG[1:]:
        cubic = cubic * z + c
    return (_BITS - _F32(exponent)) * _LN2 - (z + z * z * (z * cubic - _HALF))
