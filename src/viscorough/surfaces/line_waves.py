"""Compute the random waves of a self-affine line from a counter-based random generator.

Two 32-bit random numbers for wave k are computed from the counter k and the key of the realization alone (Philox2x32
with ten rounds, J. K. Salmon et al., Parallel random numbers: as easy as 1, 2, 3, 2011). They depend neither on the
order in which waves are computed nor on the number of waves computed at a time. The first random number gives the phase
φ, the second a number U in (0, 1). The complex Gaussian coefficient of the wave is then (Box and Muller)
    X_k = A_k √(-2 ln U) exp(iφ)
with the amplitude A_k of the spectrum. With fixed amplitudes the coefficient is A_k exp(iφ).

The function `waves` evaluates this formula in double precision. The compiled functions evaluate it in single precision
for lines with an even number of points. They use polynomials for logarithm, sine and cosine, because the compiler can
vectorize polynomials.
"""

import numpy as np

from viscorough.basics.compilation import njit
from viscorough.basics.types import Array, Complex, Integers

# Largest number of waves: the counter of the random generator has 32 bits.
MOST_WAVES = 2**32 - 1
# Number of waves computed at a time, so small that their arrays stay in the fastest cache.
_BLOCK = 1024
# Constants are converted to these types, so that numba does not compute in wider types.
_U64, _U32, _I32, _F32 = np.uint64, np.uint32, np.int32, np.float32

# Number of rounds, multiplier and key increment (Weyl constant) of Philox2x32, and mask of the lower 32 bits.
_ROUNDS, _MULTIPLIER, _WEYL, _LOW = 10, _U64(0xD256D193), _U64(0x9E3779B9), _U64(0xFFFFFFFF)
# Coefficients of polynomials from S. Moshier's Cephes library, the highest power first. In single precision, their
# relative error is 1e-7. _LOG is a polynomial of z for (ln(1+z) - z + z²/2) / z³. For |x| <= π/4, _SINE is a polynomial
# of x² for (sin x - x) / x³, and _COSINE is a polynomial of x² for (cos x - 1) / x².
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
# Bit pattern of √(1/2) in single precision, as a whole number, and number of bits in a mantissa.
_ROOT_HALF, _MANTISSA = _I32(0x3F3504F3), _I32(23)


def key_of(seed_sequence: np.random.SeedSequence) -> Integers:
    """Return the key of the random generator for a seed: two 32-bit numbers."""
    return seed_sequence.generate_state(2, np.uint32).astype(np.uint64)


def waves(first: int, key: Integers, amplitude: Array, *, fixed: bool) -> Complex:
    """Return the coefficients X_k of the waves k = first, first + 1, ..., one for each entry of `amplitude`.

    The coefficients are in double precision.

    first : number k of the first wave, at least 0
    key : key of the realization, from `key_of`
    amplitude : amplitudes A_k of the waves in the spectrum
    fixed : True for coefficients with exactly the moduli A_k, False for random moduli
    """
    direction, size = np.empty((2, len(amplitude)), np.uint32)
    random_words(first, key, direction, size)
    modulus = amplitude if fixed else amplitude * np.sqrt(-2 * np.log((size + 0.5) * 2.0**-32))
    return modulus * np.exp(2j * np.pi * 2.0**-32 * direction)


@njit(fastmath=True)
def random_words(first, key, low, high):
    """Fill `low` and `high` with the random numbers of the counters first, first + 1, ... (Philox2x32-10).

    key : key[0] is the key of the generator, and key[1] the upper half of its 64-bit counter
    low, high : arrays of equal shape, for the first and for the second random number of each counter
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
    """Return the real coefficient of the shortest wave, k = n/2, of a line with an even number n of points.

    This wave has two points per period. Its values at the points are those of a cosine, so its coefficient is real. The
    factor √2 gives it the same mean power as a complex coefficient would have.

    points : number n of points
    key, fixed : arguments of `waves`
    amplitude : amplitude of the wave in the spectrum
    """
    wave = waves(points // 2, key, np.array([amplitude]), fixed=fixed)[0]
    return np.copysign(abs(wave), wave.real) if fixed else np.sqrt(2) * wave.real


def fill_packed_spectrum(spectrum: Complex, key: Integers, amplitude: Array, *, fixed: bool) -> float:
    """Fill `spectrum` with the spectrum of a line whose points are combined in pairs; return the mean square height.

    A line with the waves X_k has the real heights y at its n = 2m points. Neighbouring heights are combined into the m
    complex numbers y_2j + i y_2j+1. The spectrum Z of these numbers is
        Z_k = X_k + X*_(m-k) + i exp(iπk/m) (X_k - X*_(m-k)).
    The complex Fourier transform of Z, with positive exponents and without a factor, gives the pairs of heights.

    spectrum : array for Z, shape (m,), complex, single precision
    key, fixed : arguments of `waves`
    amplitude : amplitudes A_k of the waves k = 0, 1, ..., m in single precision; A_0 is ignored: there is no wave k = 0
    """
    half = len(spectrum)
    shortest = shortest_wave(2 * half, key, amplitude[half], fixed=fixed)
    spectrum[0] = shortest * (1 - 1j)
    square = _fill_pairs(spectrum, key, amplitude, fixed, *_scratch_of_blocks())
    if half % 2 == 0:
        middle = waves(half // 2, key, amplitude[half // 2 : half // 2 + 1], fixed=fixed)[0]
        spectrum[half // 2] = 2 * np.conj(middle)
        square += abs(middle) ** 2
    return 2 * square + shortest**2


def _scratch_of_blocks() -> tuple[Array, ...]:
    """Return the scratch arrays of `_fill_pairs`."""
    numbers = np.empty((3, 2, _BLOCK), np.float32)
    return *numbers, *np.empty((2, _BLOCK), np.uint32), np.empty(_BLOCK, np.float32)


@njit
def _fill_pairs(spectrum, key, amplitude, fixed, longer, shorter, rotation, direction, size, modulus):
    """Fill Z_k and Z_(m-k) for 0 < k < m/2, block by block; return the sum of |X_k|² of these waves.

    See `fill_packed_spectrum` for Z, X, m and the arguments.

    longer, shorter, rotation : scratch arrays for complex numbers; the first index is 0 for real and 1 for imaginary
        parts, shape (2, _BLOCK)
    direction, size, modulus : scratch arrays of `_draw`
    """
    half, square = spectrum.size, 0.0
    # The angle π/m, where m is `half`, as a whole number; 2^64 is a full turn.
    turn = _U64(2.0**63 / half)
    for start in range(1, (half + 1) // 2, _BLOCK):
        count = min(_BLOCK, (half + 1) // 2 - start)
        # The block contains the waves k = start, start + 1, ...; `mirrored` is the smallest of the numbers m - k.
        mirrored = half - start - count + 1
        random = direction, size, modulus[:count]
        square += _draw(start, key, amplitude[start : start + count], fixed, longer, *random)
        square += _draw(mirrored, key, amplitude[mirrored : mirrored + count], fixed, shorter, *random)
        _unit_vectors(start, turn, rotation)
        _pack(longer, shorter, rotation, count)
        _store(longer, spectrum[start : start + count])
        _store(shorter, spectrum[mirrored : mirrored + count])
    return square


@njit(inner=True)
def _draw(first, key, amplitude, fixed, parts, direction, size, modulus):
    """Compute the coefficients X_k of the waves k = first, first + 1, ...; return the sum of |X_k|².

    first, key, amplitude, fixed : arguments of `waves`
    parts : array for the real parts, parts[0], and the imaginary parts, parts[1]
    direction, size : scratch arrays for random numbers, of equal shape, at least as long as `amplitude`
    modulus : scratch array in the shape of `amplitude`
    """
    random_words(first, key, direction, size)
    if fixed:
        return _polar(direction, amplitude, parts)
    _moduli(size, amplitude, modulus)
    return _polar(direction, modulus, parts)


@njit(fastmath=True)
def _moduli(size, amplitude, modulus):
    """Compute random moduli A √(-2 ln U), with U = (size + 1/2) / 2^32 from 32-bit random numbers `size`.

    size : at least as long as `amplitude`
    amplitude : amplitudes A
    modulus : array for the results
    """
    for i in range(modulus.size):
        modulus[i] = amplitude[i] * np.sqrt(_TWO * _minus_log(size[i]))


@njit(inner=True, fastmath=True)
def _polar(direction, modulus, parts):
    """Compute complex numbers from their moduli and directions; return the sum of the squared moduli.

    direction : angles as 32-bit whole numbers; 2^32 is a full turn; at least as long as `modulus`
    parts : array for the real parts, parts[0], and the imaginary parts, parts[1]
    """
    square = _F32(0)
    for i in range(modulus.size):
        cosine, sine = _cos_sin(direction[i])
        parts[0, i], parts[1, i] = modulus[i] * cosine, modulus[i] * sine
        square += modulus[i] * modulus[i]
    return square


@njit(inner=True, fastmath=True)
def _unit_vectors(first, turn, parts):
    """Compute exp(2πi (first + j) turn / 2^64) for j = 0, 1, ..., parts.shape[1] - 1.

    parts : array for the real parts, parts[0], and the imaginary parts, parts[1]
    """
    for i in range(parts.shape[1]):
        parts[0, i], parts[1, i] = _cos_sin(_U32(_U64(first + i) * turn >> _U64(32)))


@njit(inner=True, fastmath=True)
def _pack(longer, shorter, rotation, size):
    """Replace the coefficients X_k and X_(m-k) by Z_k and Z_(m-k), in place (see `fill_packed_spectrum`).

    With S = X_k + X*_(m-k) and W = i exp(iπk/m) (X_k - X*_(m-k)), the results are Z_k = S + W and Z_(m-k) = (S - W)*.

    longer : real and imaginary parts of X_k, in the order of increasing k, shape (2, at least `size`)
    shorter : real and imaginary parts of X_(m-k), in the order of decreasing k
    rotation : real and imaginary parts of exp(iπk/m)
    size : number of waves k
    """
    for i in range(size):
        j = _U64(size - 1 - i)  # unsigned indices need no check for negative values, so the loop can be vectorized
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
def twiddle(spectrum, factor, rotation):
    """Multiply the complex number in row j and column k of a spectrum by factor · exp(2πi jk/m), in place.

    m is the number of all complex numbers in the spectrum.

    spectrum : alternating real and imaginary parts along each row, single precision, shape (rows, 2 · columns)
    factor : real number
    rotation : scratch array in single precision, shape (2, columns)
    """
    rows, columns = spectrum.shape[0], spectrum.shape[1] // 2
    for j in range(rows):
        _unit_vectors(0, _U64(2.0**64 / (rows * columns) * j), rotation)
        _rotate(spectrum[j], rotation, factor)


@njit(inner=True, fastmath=True)
def _rotate(pairs, rotation, factor):
    """Multiply complex numbers by factor · rotation, in place.

    pairs : complex numbers to be multiplied, as alternating real and imaginary parts, shape (2 · columns,)
    rotation : complex numbers of modulus 1, with the real parts in rotation[0] and the imaginary parts in rotation[1]
    """
    for i in range(rotation.shape[1]):
        j, k = _U64(2 * i), _U64(2 * i + 1)
        cosine, sine = factor * rotation[0, i], factor * rotation[1, i]
        real, imag = pairs[j], pairs[k]
        pairs[j], pairs[k] = real * cosine - imag * sine, real * sine + imag * cosine


@njit(inner=True, fastmath=True)
def _cos_sin(direction):
    """Return cosine and sine of an angle, which is given as the whole number direction = 2^32 · angle / 2π.

    The angle is split into a multiple of π/2 and a remainder x between -π/4 and π/4. Polynomials then give sin x and
    cos x.
    """
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
    """Return -ln((size + 1/2) / 2^32), computed from the exponent and the mantissa of size + 1/2."""
    bits = np.float32(_F32(size) + _HALF).view(np.int32)
    exponent = (bits - _ROOT_HALF) >> _MANTISSA  # this exponent leaves a mantissa between √(1/2) and √2
    z = np.int32(bits - (exponent << _MANTISSA)).view(np.float32) - _ONE
    cubic = _LOG[0]
    for c in _LOG[1:]:
        cubic = cubic * z + c
    return (_BITS - _F32(exponent)) * _LN2 - (z + z * z * (z * cubic - _HALF))
