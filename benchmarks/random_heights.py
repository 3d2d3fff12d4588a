"""Random height maps of kinds that are difficult for contact solvers."""

from dataclasses import replace

import numpy as np

from viscorough.surfaces.self_affine import self_affine_disc


def random_heights(generator, largest=12):
    """Draw heights of one of KINDS, of a random scale, and with missing elements with a chance of a third.

    generator : numpy Generator
    largest : elements across; a strip has up to eight times as many

    Returns an array of shape (rows, columns) with at least one element; nan at missing elements.
    """
    kind = KINDS[generator.choice(list(KINDS))]
    heights = kind(generator, *generator.integers(1, largest + 1, 2))
    if generator.random() < 0.3 and heights.size > 3:
        heights = np.where(_mask(generator, heights.shape), np.nan, heights)
        heights.flat[generator.integers(heights.size)] = 0.5
    return heights


def with_random_aspect(indenter, generator):
    """Give the indenter elements of a random aspect dy/dx from 1/5 to 5 with a chance of a third."""
    if generator.random() > 1 / 3:
        return indenter
    return replace(indenter, row_spacing=indenter.spacing * 5 ** generator.uniform(-1, 1))


def _mask(generator, shape):
    """Draw a mask of missing elements: scattered ones, all beyond a circle, or a hole in the middle."""
    row, column = _positions(generator, *shape)
    distance = np.hypot(row / shape[0], column / shape[1])
    choice, share = generator.integers(3), 0.8 * generator.random()
    if choice == 0:
        return generator.random(shape) < share
    return distance > 1 - share if choice == 1 else distance < 0.6 * share


def _positions(generator, rows, columns):
    """Return rows and columns relative to a random position on the map."""
    return np.mgrid[:rows, :columns] - np.array([rows, columns])[:, None, None] * generator.random((2, 1, 1))


def _rough(generator, rows, columns):
    """Return heights of a self-affine disc, of this shape; corners are as deep as the highest point is high."""
    heights = _rough_disc(generator, rows, columns)
    return np.nan_to_num(heights, nan=-np.nanmax(heights))[:rows, :columns]


def _hill(generator, rows, columns):
    return -(np.hypot(*_positions(generator, rows, columns)) ** generator.uniform(0.5, 4))


def _rough_disc(generator, rows, columns):
    hurst, across, seed = generator.random(), max(3, rows, columns), generator.integers(2**32)
    return self_affine_disc(hurst, int(across), seed=int(seed)).heights


def _steps(generator, rows, columns):
    row, column = _positions(generator, rows, columns)
    return np.floor(generator.uniform(0.1, 2) * row + generator.uniform(0.1, 2) * column)


def _ridge(generator, rows, columns):
    row, column = _positions(generator, rows, columns)
    return -abs(row + generator.normal() * column) + 1e-3 * generator.random((rows, columns))


def _one_spike(generator, rows, columns):
    heights = 1e-6 * generator.random((rows, columns))
    heights[rows // 2, columns // 2] = 1.0
    return heights


def _terraces(generator, rows, columns):
    """Return a rough surface rounded to a few heights, with a chance of one half with some noise."""
    heights = _rough(generator, rows, columns)
    step = np.ptp(heights) / generator.integers(1, 7) or 1.0
    return np.floor(heights / step) * step + _noise(generator, heights.shape) * step


def _bosses(generator, rows, columns):
    """Return one to three round bosses on a plate, of equal or different heights, half of the time with noise."""
    heights = np.zeros((rows, columns))
    for _ in range(generator.integers(1, 4)):
        radius = generator.uniform(0.1, 0.5) * max(rows, columns)
        boss = np.hypot(*_positions(generator, rows, columns)) <= radius
        heights = np.maximum(heights, boss * generator.choice([1.0, generator.random()]))
    return heights + _noise(generator, heights.shape)


def _plateau(generator, rows, columns):
    """Return a truncated hill, whose highest elements touch simultaneously."""
    hill = _hill(generator, rows, columns)
    return np.minimum(hill, np.quantile(hill, generator.random())) + _noise(generator, hill.shape) * np.ptp(hill)


def _comb(generator, rows, columns):
    """Return ridges at equal distances, or a checkerboard, over a plate at a lower height."""
    period = generator.integers(2, 6)
    row, column = np.mgrid[:rows, :columns]
    teeth = (row % period == 0) if generator.random() < 0.6 else ((row + column) % 2 == 0)
    return teeth * generator.choice([1.0, 1e-3]) + _noise(generator, teeth.shape)


def _quantized(generator, rows, columns):
    """Return a rough surface quantized as by an instrument of low resolution."""
    heights = _rough(generator, rows, columns)
    step = np.ptp(heights) / 2.0 ** generator.integers(2, 11) or 1.0
    return np.round(heights / step) * step


def _measured_like(generator, rows, columns):
    """Return a rough surface with tilt, noise, quantization and a few spikes."""
    heights = _rough(generator, rows, columns)
    span = np.ptp(heights) or 1.0
    row, column = _positions(generator, rows, columns)
    heights = heights / span + generator.normal() * row / rows + generator.normal() * column / columns
    heights = np.round((heights + _noise(generator, heights.shape)) * 2**10) / 2**10
    spikes = generator.random(heights.shape) < 0.01
    return np.where(spikes, heights + generator.normal(), heights)


def _islands(generator, rows, columns):
    """Return many small bumps of almost equal heights, far from each other on a plate at a lower height."""
    bumps = generator.random((rows, columns)) < generator.uniform(0.01, 0.2)
    return np.where(bumps, 1 + 10.0 ** generator.uniform(-4, 0) * generator.random((rows, columns)), 0.0)


def _edge_patch(generator, rows, columns):
    """Return a rough patch at an edge or in a corner of a plate at a lower height."""
    heights, (height, width) = np.zeros((rows, columns)), -(-np.array([rows, columns]) // 3)
    heights[:height, :width] = 1 + generator.random((height, width))
    return np.flip(heights, axis=tuple(np.flatnonzero(generator.random(2) < 0.5)))


def _noise(generator, shape):
    """Return uniform noise of an amplitude from 1e-6 to 0.1, or none with a chance of one half."""
    amplitude = 10.0 ** generator.uniform(-6, -1) if generator.random() < 0.5 else 0.0
    return amplitude * generator.random(shape)


KINDS = {
    "uniform": lambda generator, *shape: generator.random(shape),
    "normal": lambda generator, *shape: generator.standard_normal(shape),
    "whole numbers": lambda generator, *shape: generator.integers(0, generator.integers(2, 6), shape).astype(float),
    "hill": _hill,
    "rough disc": _rough_disc,
    "steps": _steps,
    "strip": lambda generator, rows, columns: generator.random((1, 8 * int(columns))),
    "ridge": _ridge,
    "one spike": _one_spike,
    "flat": lambda generator, *shape: np.zeros(shape),
    "terraces": _terraces,
    "bosses": _bosses,
    "plateau": _plateau,
    "comb": _comb,
    "quantized": _quantized,
    "measured-like": _measured_like,
    "islands": _islands,
    "edge patch": _edge_patch,
}
