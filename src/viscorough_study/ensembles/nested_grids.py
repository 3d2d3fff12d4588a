"""Generate the same self-affine surface on several grids, and compute its loading curves on them.

A surface is a sum of waves in the unit square, z(r) = Σ c_k exp(2πi k·r), with wave vectors k of whole numbers, random
complex Gaussian amplitudes c_k, and ⟨|c_k|²⟩ = |k|^(−2−2H), H the Hurst exponent. A grid with n points across contains
the waves with 1 ≤ |k| ≤ n/2. The amplitudes are drawn once for the finest grid. A coarser grid has the waves of the
finest grid that fit in its circle, with the same amplitudes. So its map has the distribution of an independent map on
the coarse grid. Every second point of the fine map has not: it contains the short waves as well.

The number of points across is odd, and r = 0 is the central point of every grid. The centres of the discs coincide.

The heights z and −z have the same distribution, and other elements of them touch first. Every disc is therefore
indented from both sides, which gives two curves for one surface; most of the time at 4097 points is its generation.

The rms height h that makes curves dimensionless contains all waves of the spectrum, also those that no grid has:
h² is the variance of the heights over the disc plus the expected variance of all waves with |k| > n/2. It depends only
on the map itself, so a difference between two grids contains the same quantity of each grid as an independent map does.
"""

import time
from functools import cache

import numpy as np
import xarray as xr
from ducc0 import fft

from viscorough.contact.loading_path import indent
from viscorough.contact.options import SolverOptions
from viscorough.surfaces.indenter import Indenter
from viscorough.surfaces.self_affine import cut_disc
from viscorough_study.ensembles.averages import ROUNDING, abscissa

# Sum the weights of single waves up to this wave number; an integral replaces the sum beyond.
_LATTICE = 256
# Ratio of the rms height to the diameter. Results do not depend on it; small heights keep depths below the diameter.
_RMS = 1e-3
# Abscissae of a curve per decade of X, and its first X, below which a single element touches on every grid.
PER_DECADE, _X_LOW = 20, 1e-9
# Solve contacts of up to this many elements with a dense matrix. They are spread over the whole disc, so that an
# iteration on the grid takes longer.
_OPTIONS = SolverOptions(dense_contacts=1500, dense_interactions=20_000_000)
_SIDES = (1.0, -1.0)  # factors of the heights of a disc


def surface_waves(hurst, across, seed):
    """Draw the amplitudes c_k of a surface, with the wave vectors of a grid with `across` points across.

    across : n, odd; seed : int or SeedSequence
    Returns an array of shape (n, (n + 1)/2) in the layout of a real Fourier transform: rows are k_y = 0, 1, ..., −1 and
    columns are k_x = 0, 1, ...
    """
    random = np.random.Generator(np.random.SFC64(seed))
    half = across // 2
    rows = np.fft.fftfreq(across, 1 / across)
    waves = random.standard_normal((across, 2 * (half + 1))).view(complex)
    waves[-1 : -half - 1 : -1, 0] = waves[1 : half + 1, 0].conj()  # real heights: c(−k) is the conjugate of c(k)
    square = rows[:, None] ** 2 + np.arange(half + 1) ** 2
    square[0, 0] = np.inf
    weight = square ** (-(1 + hurst) / 2)
    weight[square > (across / 2) ** 2] = 0
    waves *= np.sqrt(0.5) * weight
    return waves


def coarser_waves(waves, across):
    """Return the waves that a coarser grid with `across` points across contains, in the layout of `surface_waves`."""
    half = across // 2
    kept = np.concatenate([waves[: half + 1, : half + 1], waves[len(waves) - half :, : half + 1]])
    rows = np.fft.fftfreq(across, 1 / across)
    kept[rows[:, None] ** 2 + np.arange(half + 1) ** 2 > (across / 2) ** 2] = 0
    return kept


def disc_of_waves(waves):
    """Return the heights of the disc at the centre of a surface, shape (n, n), nan outside the disc.

    The point r = 0 of the surface is the central point of the disc.
    """
    across = len(waves)
    heights = fft.c2r(waves, lastsize=across, forward=False)
    return cut_disc(np.roll(heights, (across // 2, across // 2), axis=(0, 1)), across)


@cache
def wave_variances(hurst, across):
    """Return the expected variances Σ |k|^(−2−2H) of the waves that a grid contains, and of all shorter waves.

    The variances are in the units of `surface_waves`. A grid contains the waves with 1 ≤ |k| ≤ n/2.

    hurst : H > 0; for H = 0 the sum over all waves diverges
    across : n, the number of points across
    """
    square = np.arange(-_LATTICE, _LATTICE + 1)[:, None] ** 2 + np.arange(-_LATTICE, _LATTICE + 1) ** 2
    square = square[(square > 0) & (square <= _LATTICE**2)]
    weight = square ** (-1.0 - hurst)
    beyond = np.pi / hurst * np.maximum(across / 2, _LATTICE) ** (-2 * hurst)
    present = weight[square <= (across / 2) ** 2].sum() + np.pi / hurst * _LATTICE ** (-2 * hurst) - beyond
    return present, beyond + weight[square > (across / 2) ** 2].sum()


def curve_of_disc(disc, hurst, x, tolerance):
    """Compute vt/h of a disc at given X by boundary elements; return ln(vt/h) and the number of elements in contact.

    disc : heights from `disc_of_waves`
    x : X = F/(4GhL), increasing, shape (abscissae,); the curve is computed up to the last X
    tolerance : argument of viscorough.indent
    Both results have the shape (abscissae,).
    """
    across = len(disc)
    rms = np.sqrt(np.nanvar(disc) + wave_variances(hurst, across)[1])
    force = 4 * _RMS * x
    indenter = Indenter(disc * (_RMS / rms), 1 / across)
    until_force = force[-1] * (1 + ROUNDING)  # so that rounding does not exclude the last abscissa
    curve = indent(indenter, tolerance=tolerance, until_fraction=1.0, until_force=until_force, options=_OPTIONS)
    stiffness = curve.at_force(force)[1] / 4
    return np.log(x / stiffness), np.exp(np.interp(np.log(force), np.log(curve.force), np.log(curve.contact_count)))


def nested_curves(hurst, elements, numbers, *, until_x, tolerance, seed, spawn_key):
    """Compute the curves of the same discs on several grids; return them as a dataset.

    hurst : Hurst exponent
    elements : elements across on the grids, from fine to coarse; the waves are drawn for the first grid
    numbers : [first, end] of the numbers of the discs; end is not included
    until_x : X = F/(4GhL) at which the curves end
    tolerance : argument of viscorough.indent
    seed, spawn_key : root seed and spawn key of the discs; the seed of a disc has the key followed by its number

    The variables have the dimensions (surface, side, grid, abscissa), with side 0 for z and side 1 for −z, and with
    grid 0 the finest grid. The processor time of a grid includes the generation of the disc and both curves.
    """
    numbers = range(*numbers)
    x, shape = abscissa(_X_LOW, until_x, PER_DECADE), (len(numbers), len(_SIDES), len(elements))
    logarithm, count = np.empty((2, *shape, len(x)))
    seconds = np.empty((len(numbers), len(elements)))
    for surface, number in enumerate(numbers):
        start = time.process_time()
        waves = surface_waves(hurst, elements[0], np.random.SeedSequence(seed, spawn_key=(*spawn_key, number)))
        for grid, across in enumerate(elements):
            disc = disc_of_waves(waves if grid == 0 else coarser_waves(waves, across))
            for side, sign in enumerate(_SIDES):
                logarithm[surface, side, grid], count[surface, side, grid] = curve_of_disc(
                    sign * disc, hurst, x, tolerance
                )
            seconds[surface, grid], start = time.process_time() - start, time.process_time()
    axes = ("surface", "side", "grid", "abscissa")
    described = {
        "log_velocity": (axes, logarithm, "ln(vt/h), with h over all waves of the spectrum", "1"),
        "contact_count": (axes, count, "elements in contact", "1"),
        "processor_s": (("surface", "grid"), seconds, "processor time of a disc and its two curves", "s"),
        "elements": (("grid",), np.array(elements), "elements across the disc", "1"),
        "hurst": ((), np.array(hurst), "Hurst exponent", "1"),
        "x": (("abscissa",), x, "dimensionless force F/(4GhL) or time Ft/(4ηhL)", "1"),
    }
    variables = {
        name: (dimensions, values, {"long_name": text, "units": units})
        for name, (dimensions, values, text, units) in described.items()
    }
    return xr.Dataset(variables, attrs={"title": "Curves of the same discs on several grids"})
