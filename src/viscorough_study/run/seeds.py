"""Define random streams: the keys of `numpy.random.SeedSequence` for all parts of the study.

A seed consists of a root, the setting `seed`, and a spawn key that begins with the number of its stream. Keys are built
from properties of a realization (Hurst exponent, grid, combination), never from its position in a list. So its random
numbers do not depend on other realizations, on the order, or on the number of cores. The numbers of the streams are
part of every published result: do not change them, and give a new stream a new number.

Three parts use a root without a stream. The bootstrap of the fits and the disc of the level-placement scenes use the
root itself; the key of a random indenter of the stability campaign is only the number of its case
(`random_indenter_key`), under the root of this campaign.
"""

import zlib

import numpy as np


def realization_seed(root, *key):
    """Return the SeedSequence of a root and a key of integers >= 0; different keys give independent random numbers."""
    return np.random.SeedSequence(root, spawn_key=key)


def disc_key(hurst, combination):
    """Return the key of discs of the nine combinations; combination : its number in the settings"""
    return _key(1, _millionths(hurst), combination)


def variant_key(hurst, name):
    """Return the key of discs of a variant of the surfaces; name : name of the variant"""
    return _key(2, _millionths(hurst), zlib.crc32(name.encode()))


def line_key(hurst):
    """Return the key of lines that the method of dimensionality reduction indents."""
    return _key(3, _millionths(hurst))


def method_problem_key(hurst, elements):
    """Return the key of the rough disc in the comparison of methods; elements : number across it"""
    return _key(4, _millionths(hurst), elements)


def solver_race_key(task, hurst):
    """Return the key of the rough disc in the race with other solvers; task : its position in the race"""
    return _key(5, task, _millionths(hurst))


def failure_map_key():
    """Return the key of the indenters of the stress-test cases."""
    return _key(6)


# Stream 7 belonged to a table that no longer exists; it must not be reused.


def size_disc_key(hurst, elements):
    """Return the key of discs on grids from coarse to fine; elements : number across the disc"""
    return _key(8, _millionths(hurst), elements)


def size_line_key(hurst, points):
    """Return the key of lines on grids from coarse to fine; points : number on the line"""
    return _key(9, _millionths(hurst), points)


def large_disc_key(elements):
    """Return the key of the disc for the cost on grids up to the finest; elements : number across it"""
    return _key(10, elements)


def gamma_factor_key(hurst):
    """Return the key of the rough disc that is integrated directly in time."""
    return _key(11, _millionths(hurst))


def mdr_comparison_key(hurst, realization):
    """Return the key of a disc and the line with its spectrum, which share a seed and spawn one each."""
    return _key(12, _millionths(hurst), realization)


def size_control_key(hurst, elements):
    """Return the key of discs without a power law, on grids from coarse to fine; elements : number across the disc"""
    return _key(13, _millionths(hurst), elements)


def plateau_key(hurst, group):
    """Return the key of bootstrap and synthetic ensembles of the test for a power law; group : base or the control"""
    return _key(14, _millionths(hurst), zlib.crc32(group.encode()))


def periodic_key(hurst, realization):
    """Return the key of periodic surfaces of the control of two springs, the same with and without a roll-off."""
    return _key(15, _millionths(hurst), realization)


def law_disc_key(hurst, elements, realization):
    """Return the key of discs of the penetration law, up to complete contact; elements : number across the disc"""
    return _key(16, _millionths(hurst), elements, realization)


def light_map_key(hurst, elements, number):
    """Return the key of square maps under a light load; elements : number across the map"""
    return _key(17, _millionths(hurst), elements, number)


def one_surface_key(hurst, number):
    """Surfaces that are sampled with grids from coarse to fine, each with a line of the same h, L and H."""
    return _key(18, _millionths(hurst), number)


def random_indenter_key(case):
    """Return the key of a small indenter of the stability campaign; case : its number"""
    return _key(case)


def _millionths(hurst):
    return round(hurst * 1e6)


def _key(*numbers):
    """Return plain integers, suitable for settings, file attributes and Snakemake's parameters."""
    return tuple(int(number) for number in numbers)
