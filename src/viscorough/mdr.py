"""The method of dimensionality reduction (MDR): a line of independent springs instead of the half-space.

Each point of a line with spacing Δx is a spring of stiffness 4G Δx, with the shear modulus G. The initial gap g of a
point is its depth below the highest point. At the depth u of the indenter the springs carry the force F with
F/G = 4 Δx Σ(u - g)₊. On a fluid of viscosity η the springs become dashpots of damping 4η Δx, and ∫F dt/η takes the
place of F/G (paper, Sec. V). No equation has to be solved or integrated in time: the loading curve follows from the
gaps. The gaps need not be sorted. It suffices to divide them into narrow bins, and to know their number and their sum
in each bin.
"""

from typing import Any

import numpy as np
from ducc0 import fft
from numpy.typing import NDArray

from viscorough.basics.arrays import fraction, positive, real_numbers
from viscorough.basics.compilation import njit
from viscorough.basics.types import Array, Integers, Seed
from viscorough.results.loading_curve import LoadingCurve
from viscorough.surfaces.indenter import Indenter, check_indenter
from viscorough.surfaces.spectrum import seed_sequence

# Number of bins between any gap g and the gap 2g (an octave). It must be a power of 2. With 64 bins, the width of a bin
# is 0.8 to 1.6 % of the gap.
_BINS_PER_OCTAVE = 64
# Number of octaves (factors of 2) below the largest gap that are divided into bins. All smaller gaps share one bin.
_OCTAVES = 128
# The window function in `line_of_map` changes the powers of the longest waves of a map. This is the number of these
# waves.
_SPOILED = 3
# Number of counters per bin. Neighbouring points often fall into the same bin. With several counters, the processor
# does not wait for the update by the previous point.
_LANES = 4
# Number of points whose bins are computed in one vectorized loop.
_BLOCK = 512


def reduce(line: Indenter, *, until_fraction: float = 1.0, until_force: float | None = None) -> LoadingCurve:
    """Compute the loading curve of a line by the method of dimensionality reduction (MDR).

    The initial gap g of a point is its depth below the highest point. The gaps are divided into narrow bins, and the
    levels of the curve are at the edges of those bins that contain a gap. Force and stiffness at a level are::

        F/G = 4 Δx Σ(u - g)₊,   k/G = 4 Δx (number of g < u)

    These values are exact, up to the rounding of gaps and sums in double precision. If at most one point comes into
    contact between two levels, LoadingCurve.at_force is exact between these levels. Otherwise the levels are one bin
    apart, 0.8 to 1.6 % in depth, and the error of the interpolated depth is a small part of this width.

    At the first level only the highest points touch. The curve ends at the first level that reaches `until_fraction` or
    `until_force`, but it has at least two levels. If the line is flat, all gaps are zero, and the levels are at the
    depths of half a spacing and of one spacing.

    Parameters
    ----------
    line : Indenter
        Indenter with one-dimensional heights.
    until_fraction : float, optional
        Contact fraction of the last level, in (0, 1].
    until_force : float, optional
        Force F/G of the last level [length²]. If the whole line is in contact at a smaller force, a level at exactly
        `until_force` is added, unless the curve ends earlier at `until_fraction`.

    Returns
    -------
    LoadingCurve

    Raises
    ------
    ValueError
        For a map instead of a line, and for values out of range.

    Notes
    -----
    Source: V. L. Popov and M. Heß, Method of Dimensionality Reduction in Contact Mechanics and Friction (2015); paper,
    Sec. V.

    Examples
    --------
    >>> import viscorough
    >>> line = viscorough.self_affine_line(0.7, 257, rms=0.1, seed=1)
    >>> curve = viscorough.reduce(line, until_fraction=0.5)
    >>> bool((curve.stiffness[1:] >= curve.stiffness[:-1]).all())
    True
    """
    check_indenter("reduce", line, 1)
    until: dict[str, Any] = {"until_fraction": until_fraction, "until_force": until_force}
    return reduce_heights(line.heights, line.spacing, length_unit=line.length_unit, **until)


def reduce_heights(
    heights: Array,
    spacing: float,
    *,
    until_fraction: float = 1.0,
    until_force: float | None = None,
    length_unit: str = "1",
) -> LoadingCurve:
    """Compute the loading curve of a line, like `reduce`. The heights may be in any order: springs are independent.

    heights : heights in single or double precision, shape (points,) [length]
    spacing : distance between neighbouring points [length]
    until_fraction, until_force : arguments of `reduce`
    length_unit : unit of heights and spacing; see Indenter

    Raises the same errors as `reduce`, and ValueError for heights that are not finite.
    """
    until_fraction = fraction("argument until_fraction", until_fraction)
    if until_force is not None:
        until_force = positive("argument until_force", until_force)

    depth, force, stiffness, contact_count = _levels(heights, spacing)
    if until_force is not None and force[-1] < until_force:
        depth = np.append(depth, depth[-1] + (until_force - force[-1]) / stiffness[-1])
        force = np.append(force, until_force)
        stiffness, contact_count = (np.append(column, column[-1]) for column in (stiffness, contact_count))
    last = force.size - 1 if until_force is None else np.searchsorted(force, until_force)
    if until_fraction < 1:
        last = min(last, np.searchsorted(contact_count / heights.size, until_fraction))
    levels = slice(max(last, 1) + 1)
    return LoadingCurve(
        depth=depth[levels],
        force=force[levels],
        stiffness=stiffness[levels],
        contact_count=contact_count[levels],
        elements=heights.size,
        method="reduction",
        tolerance=0.0,
        operator_applications=0,
        residual=np.zeros_like(depth[levels]),
        length_unit=length_unit,
    )


def _levels(heights: Array, spacing: float) -> tuple[Array, Array, Array, Integers]:
    """Return depth, force F/G, stiffness k/G and contact count at the edges of all bins that contain a gap."""
    edges, counts, sums = _binned_gaps(heights)
    grown = 1 + np.flatnonzero(counts[1:])
    # Bins with the numbers `grown` contain gaps. Bin r lies between edges[r] and edges[r + 1], so the levels are at the
    # edges with the numbers r and r + 1 of these bins.
    levels = np.union1d(grown, grown + 1)
    depth, below = edges[levels], levels - 1
    if levels.size == 0:
        depth, below = np.array([0.5, 1.0]) * spacing, np.array([0, 0])
    contact_count = np.cumsum(counts)[below]
    stiffness = 4 * spacing * contact_count
    force = stiffness * depth - 4 * spacing * np.cumsum(sums)[below]
    return depth, force, stiffness, contact_count


def line_of_surface(square: Array, spacing: float, seed: Seed) -> Indenter:
    """Generate a line with random phases and the power spectrum C1D = π q C2D (Eq. 13) of a periodic map.

    C1D and C2D are the power spectral densities of the line and of the map at the wavenumber q. The wave with k periods
    along the line has the power of all waves of the map with wavenumbers from k - 1/2 to k + 1/2 periods per side of
    the map. Waves shorter than the Nyquist wavelength, two spacings, are left out.

    Parameters
    ----------
    square : array
        Heights of the map, shape (n, n) [length].
    spacing : float
        Distance between the points of the map and of the line [length].
    seed : int or SeedSequence
        Seed of the phases. The same seed gives the same line.

    Returns
    -------
    Indenter
        Line of n points.

    Raises
    ------
    ValueError
        For a map that is not square.

    Examples
    --------
    >>> import numpy as np
    >>> from viscorough.mdr import line_of_surface
    >>> heights = np.random.default_rng(1).normal(size=(16, 16))
    >>> line_of_surface(heights, 1.0, seed=2).heights.shape
    (16,)
    """
    square = real_numbers("line_of_surface: square", square)
    n = len(square) if square.ndim else 0
    if n == 0 or square.shape != (n, n):
        raise ValueError(f"square: the map must be square, its shape is {square.shape}")
    power = np.abs(np.fft.fft2(square)) ** 2 / n**4
    wavenumber = np.fft.fftfreq(n, 1 / n)
    rings = _ring_sums(power, np.hypot(wavenumber[:, None], wavenumber), n)
    return Indenter(_random_line(rings, n, seed), spacing)


def line_of_map(surface: Indenter, seed: Seed) -> Indenter:
    """Generate a line with the radially averaged power spectrum and the rms height of a map that is not periodic.

    1. Multiply the deviations of the heights from their mean by a Hann window. The window is cos²(πr/2), where r grows
       from 0 at the centre of the map to 1 on the inscribed ellipse. Without a window, the heights would jump at the
       edges of the periodically repeated map, and the jumps would add to the short waves.
    2. Compute the power spectrum of the line from the windowed map, as `line_of_surface` does.
    3. The window changes the three longest waves. Take their relative powers from the heights without a window, and
       scale these powers so that the line has the rms height of the map.

    The line is as long as the longer side of the map. Its spacing is the larger of the two spacings of the map.

    Parameters
    ----------
    surface : Indenter
        Indenter with two-dimensional heights. Elements that are nan are treated as having the mean height.
    seed : int or SeedSequence
        Seed of the phases. The same seed gives the same line.

    Returns
    -------
    Indenter

    Raises
    ------
    ValueError
        For a line or a flat map.

    Examples
    --------
    >>> import numpy as np
    >>> import viscorough
    >>> from viscorough.mdr import line_of_map
    >>> heights = np.random.default_rng(1).normal(size=(16, 16))
    >>> line_of_map(viscorough.Indenter(heights, 1.0), seed=2).heights.shape
    (16,)
    """
    check_indenter("line_of_map", surface, 2)
    heights = surface.heights.astype(float)
    (rows, columns), spacing = heights.shape, max(surface.spacing, surface.row_spacing)
    # dx, dy and the length are in units of the larger spacing.
    dx, dy = surface.spacing / spacing, surface.row_spacing / spacing
    length = max(rows * dy, columns * dx)
    points = round(length)
    y, x = ((np.arange(n) - (n - 1) / 2) / (n / 2) for n in heights.shape)
    window = np.cos(np.pi / 2 * np.minimum(np.hypot(y[:, None], x), 1)) ** 2
    window[np.isnan(heights)] = 0
    wavenumber = length * np.hypot(np.fft.fftfreq(rows, dy)[:, None], np.fft.fftfreq(columns, dx))
    with np.errstate(all="ignore"):  # squares of heights may overflow, which is checked below
        long, rings = (
            _ring_sums(_power_of_piece(heights, weights), wavenumber, points) for weights in (window > 0, window)
        )
        square, spoiled = np.nanvar(heights), slice(1, _SPOILED + 1)
    if not (0 < square < np.inf and 0 < rings[1:].sum() < np.inf and 0 < long[spoiled].sum() < np.inf):
        raise ValueError("surface: the map is flat or its squares overflow; heights that vary, less, are needed")
    rings[spoiled] = long[spoiled] * max(square - rings[_SPOILED + 1 :].sum(), 0) / long[spoiled].sum()
    line = _random_line(rings * (square / rings[1:].sum()), points, seed)
    return Indenter(line, spacing, length_unit=surface.length_unit)


def _power_of_piece(heights: Array, weights: Array) -> Array:
    """Return the power of each wave of the weighted heights, divided by the mean square of the weights.

    The weights multiply the deviations of the heights from their weighted mean. Heights that are nan have weight 0.
    """
    over_mean = np.where(weights > 0, heights - np.sum(weights * np.nan_to_num(heights)) / weights.sum(), 0)
    return np.abs(np.fft.fft2(weights * over_mean)) ** 2 / (weights.size * np.sum(weights**2, dtype=float))


def _ring_sums(power: Array, wavenumber: Array, points: int) -> NDArray[Any]:
    """Return the sum of the powers of all waves whose wavenumber rounds to k, for k = 0, 1, ..., points // 2.

    power : power of each wave
    wavenumber : number of periods of each wave along the line
    points : number of points of the line
    """
    ring = np.rint(wavenumber).astype(int)
    most = points // 2 + 1
    return np.bincount(ring.ravel(), weights=power.ravel(), minlength=most)[:most]


def _random_line(power: Array, points: int, seed: Seed) -> Array:
    """Return the heights, shape (points,), of a line that consists of waves with random phases; their mean is 0.

    power : power of the waves with 0, 1, ..., points // 2 periods along the line; the first value is ignored
    """
    amplitude = np.sqrt(power / 2)
    if points % 2 == 0:
        # The power of a wave is divided between two complex conjugate coefficients. Only the shortest wave has a
        # single, real coefficient, which must therefore be larger by √2.
        amplitude[-1] *= np.sqrt(2)
    phase = np.random.default_rng(seed_sequence(seed)).uniform(0, 2 * np.pi, amplitude.size)
    spectrum = amplitude * (np.exp(1j * phase) if points % 2 else np.append(np.exp(1j * phase[:-1]), 1.0))
    spectrum[0] = 0
    return fft.c2r(spectrum, lastsize=points, forward=False)


def _binned_gaps(heights: Array) -> tuple[Array, Integers, Array]:
    """Divide initial gaps into bins; return the edges of the bins, and number and sum of the gaps in every bin.

    Bin r contains the gaps g with edges[r] <= g < edges[r + 1]; bin 0 contains all g < edges[1]. All floating-point
    numbers in a bin have the same leading bits (exponent and first bits of the mantissa), and these bits give the
    number of the bin. Bins therefore divide every octave evenly.
    """
    highest, lowest = np.float64(heights.max()), np.float64(heights.min())
    if not np.isfinite([highest, lowest]).all():  # bins of infinite gaps and of nan would lie outside the table
        raise ValueError("reduce: heights must be finite")
    # Adding 0.0 turns -0.0 into 0.0. With -0.0, a gap could be -0.0, and its sign bit would change its bin.
    highest += 0.0
    shift = np.uint64(52 - (_BINS_PER_OCTAVE.bit_length() - 1))
    top = int((highest - lowest).view(np.uint64) >> shift)
    base = max(0, top - _OCTAVES * _BINS_PER_OCTAVE)
    table = np.zeros((top - base + 1, _LANES, 2))
    _bin_gaps(heights, highest, shift, np.uint64(base), table, np.empty(_BLOCK), np.empty(_BLOCK, np.uint32))
    edges = (np.arange(base, top + 2, dtype=np.uint64) << shift).view(np.float64)
    counts, sums = np.einsum("blk->kb", table)  # sums over the lanes, five times as fast as table.sum
    return edges, counts.astype(np.int64), sums


@njit
def _bin_gaps(heights, highest, shift, base, table, gaps, bins):
    """Add the number and the sum of the gaps in every bin to table[bin, lane, :]; see `_binned_gaps`.

    Point i uses lane i % _LANES, so that neighbouring points update different counters of a bin.

    gaps, bins : scratch arrays for the gaps and the bins of a block of points, shape (_BLOCK,)
    """
    for start in range(0, heights.size, _BLOCK):
        block = heights[start : start + _BLOCK]
        for i in range(block.size):  # separate from the next loop, so that the compiler can vectorize this loop
            gaps[i] = highest - np.float64(block[i])
            bins[i] = max(np.float64(gaps[i]).view(np.uint64) >> shift, base) - base
        for i in range(block.size):
            bin_, lane = (
                np.uint64(bins[i]),
                np.uint64(i % _LANES),
            )  # an unsigned index such as bin_ is never negative, which saves a check
            table[bin_, lane, 0] += 1
            table[bin_, lane, 1] += gaps[i]
