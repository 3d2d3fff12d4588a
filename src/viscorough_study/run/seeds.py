"""Define random streams: the keys of `numpy.random.SeedSequence` for all parts of the study.

A seed consists of a root, the setting `seed`, and a spawn key. The first number of a spawn key is the number of the
stream; each part of the study has one, but for the two below. The other numbers are properties of a realization, such
as its Hurst exponent, grid or combination, but never its position in a list. So the random numbers of a realization do
not depend on other realizations, on their order, or on the number of cores. The numbers of the streams are part of
every published result: do not change them, and give a new stream a new number. The numbers 7, 9, 13 and 17 belonged to
parts that are gone.

Two parts have no stream. The bootstrap of the fits uses the root without a spawn key. The spawn key of a random
indenter in the campaign of random contacts is only its number (`random_indenter_key`). It may be the key of another
part, since the results of the campaign are not combined with those of the study.
"""

import zlib

import numpy as np


def realization_seed(root, *key):
    """Return the SeedSequence of a root and a spawn key of integers >= 0.

    Different keys give independent random numbers.
    """
    return np.random.SeedSequence(root, spawn_key=key)


def disc_key(hurst, combination):
    """Return the spawn key of the discs of a combination of force, viscosity, diameter and rms height.

    combination : number of the combination, as in the setting discs.combinations
    To make the seed of a disc, append the number of the realization to the key.
    """
    return _key(1, _millionths(hurst), combination)


def variant_key(hurst, name):
    """Return the spawn key of the discs of a variant, whose surfaces differ from the base discs in some settings.

    name : name of the variant
    """
    return _key(2, _millionths(hurst), zlib.crc32(name.encode()))


def line_key(hurst):
    """Return the spawn key of the lines whose curves are computed by the method of dimensionality reduction."""
    return _key(3, _millionths(hurst))


def method_problem_key(hurst, elements):
    """Return the spawn key of the rough disc in the comparison of methods; elements : elements across the disc"""
    return _key(4, _millionths(hurst), elements)


def solver_race_key(task, hurst):
    """Return the spawn key of the rough disc in the race with other solvers; task : number of the task in the race"""
    return _key(5, task, _millionths(hurst))


def failure_map_key():
    """Return the spawn key of the indenters in the stress tests of all methods (robustness.failure_map)."""
    return _key(6)


def grid_disc_key(hurst, elements):
    """Return the spawn key of the discs on coarse grids, and of the discs of the calibrated law.

    elements : number of elements across the disc
    """
    return _key(8, _millionths(hurst), elements)


def large_disc_key(elements):
    """Return the spawn key of the disc on which benchmarks/large_discs.py measures time and memory for a given grid.

    elements : elements across the disc
    """
    return _key(10, elements)


def gamma_factor_key(hurst):
    """Return the spawn key of the rough disc whose motion is integrated directly in time."""
    return _key(11, _millionths(hurst))


def mdr_comparison_key(hurst, realization):
    """Return the spawn key of a disc and of a line with the same spectrum, whose curves are compared.

    The seed with this key spawns two seeds, one seed for the disc and one for the line.
    """
    return _key(12, _millionths(hurst), realization)


def local_slope_key(hurst, group):
    """Return the spawn key of the bootstrap for the local slope within region (b).

    group : group of the discs, such as "base" or the name of the control
    """
    return _key(14, _millionths(hurst), zlib.crc32(group.encode()))


def periodic_key(hurst, realization):
    """Return the spawn key of a periodic surface on which the model of fits.interface is tested.

    The surfaces with and without a roll-off use the same key.
    """
    return _key(15, _millionths(hurst), realization)


def law_disc_key(hurst, elements, realization):
    """Return the spawn key of a disc whose curve, up to complete contact, calibrates or tests the penetration law.

    elements : elements across the disc
    """
    return _key(16, _millionths(hurst), elements, realization)


def one_surface_key(hurst, number):
    """Return the spawn key of a surface that is sampled on grids from coarse to fine.

    A line with the same h, L and H also gets its seed from this key.
    """
    return _key(18, _millionths(hurst), number)


def nested_disc_key(hurst, elements):
    """Return the spawn key of the discs that are indented on several grids.

    elements : elements across the disc on the finest grid
    """
    return _key(19, _millionths(hurst), elements)


def random_indenter_key(number):
    """Return the spawn key of a small random indenter in the stability campaign; number : number of the indenter"""
    return _key(number)


def _millionths(hurst):
    return round(hurst * 1e6)


def _key(*numbers):
    """Return numbers as a tuple of plain integers, for settings, file attributes and Snakemake's parameters."""
    return tuple(int(number) for number in numbers)
