"""The registry of random streams: which key of `numpy.random.SeedSequence` belongs to which part of the study.

A seed is a root, the setting `seed`, and a spawn key that begins with the number of its stream. Keys are built from
what a realization is (Hurst exponent, grid, combination), never from its position in a list, so that its random
numbers do not depend on which others are computed, in which order, or on how many cores. The numbers in `Stream` are
part of every published result: do not change them, and give a new stream a new one.

Three things draw from a root without a stream. The bootstrap of the fits and the disc of the level-placement scenes
use the root itself (`ROOT_KEY`); the random indenters of the stability campaign have keys that are the number of the
case alone (`random_indenter_key`), under a root of that campaign.
"""

import zlib
from enum import IntEnum

import numpy as np


class Stream(IntEnum):
    """First number of the spawn keys of each stream."""

    DISCS = 1
    VARIANTS = 2
    LINES = 3
    METHOD_PROBLEMS = 4
    SOLVER_RACE = 5
    FAILURE_MAP = 6
    # 7 was that of a table which is no longer made; no other stream may have it.
    SIZE_DISCS = 8
    SIZE_LINES = 9
    LARGE_DISC = 10
    GAMMA_FACTOR = 11
    MDR_COMPARISON = 12
    SIZE_CONTROLS = 13
    PLATEAUS = 14


ROOT_KEY = ()


def realization_seed(root, *key):
    """SeedSequence of a root and a key of integers >= 0; different keys give independent random numbers."""
    return np.random.SeedSequence(root, spawn_key=key)


def disc_key(hurst, combination):
    """Discs of the nine combinations; combination : its number in the settings."""
    return _key(Stream.DISCS, _millionths(hurst), combination)


def variant_key(hurst, name):
    """Discs of a variant of the surfaces; name : of the variant."""
    return _key(Stream.VARIANTS, _millionths(hurst), zlib.crc32(name.encode()))


def line_key(hurst):
    """Lines that the reduction of dimensionality indents."""
    return _key(Stream.LINES, _millionths(hurst))


def method_problem_key(hurst, elements):
    """Rough disc on which methods are compared; elements : across it."""
    return _key(Stream.METHOD_PROBLEMS, _millionths(hurst), elements)


def solver_race_key(task, hurst):
    """Rough disc on which other solvers are timed; task : its position in the settings."""
    return _key(Stream.SOLVER_RACE, task, _millionths(hurst))


def failure_map_key():
    """Indenters of the stress-test cases."""
    return _key(Stream.FAILURE_MAP)


def size_disc_key(hurst, elements):
    """Discs on grids from coarse to fine; elements : across the disc."""
    return _key(Stream.SIZE_DISCS, _millionths(hurst), elements)


def size_line_key(hurst, points):
    """Lines on grids from coarse to fine; points : of the line."""
    return _key(Stream.SIZE_LINES, _millionths(hurst), points)


def size_control_key(hurst, elements):
    """Discs without a power law, on grids from coarse to fine; elements : across the disc."""
    return _key(Stream.SIZE_CONTROLS, _millionths(hurst), elements)


def large_disc_key(elements):
    """The disc on which cost is measured up to the finest grids; elements : across it."""
    return _key(Stream.LARGE_DISC, elements)


def gamma_factor_key(hurst):
    """Rough disc that is integrated directly in time."""
    return _key(Stream.GAMMA_FACTOR, _millionths(hurst))


def mdr_comparison_key(hurst, realization):
    """Disc and line with its spectrum, which share a seed and spawn one each."""
    return _key(Stream.MDR_COMPARISON, _millionths(hurst), realization)


def plateau_key(hurst, group):
    """Bootstrap and synthetic ensembles of the test for a power law; group : base or name of the control."""
    return _key(Stream.PLATEAUS, _millionths(hurst), zlib.crc32(group.encode()))


def random_indenter_key(case):
    """Small indenter of the stability campaign; case : its number."""
    return _key(case)


def _millionths(hurst):
    return round(hurst * 1e6)


def _key(*numbers):
    """Plain integers, which settings, file attributes and Snakemake's parameters can hold."""
    return tuple(int(number) for number in numbers)
