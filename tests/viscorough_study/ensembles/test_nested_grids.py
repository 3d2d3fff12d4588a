"""Check that the maps of one surface on two grids are what independent maps on these grids would be."""

import numpy as np
import pytest

from viscorough.contact.one_contact import contact_at
from viscorough.surfaces.indenter import Indenter
from viscorough.surfaces.self_affine import cut_disc, self_affine_square
from viscorough_study.ensembles.nested_grids import (
    coarser_waves,
    curve_of_disc,
    disc_of_waves,
    nested_curves,
    surface_waves,
    wave_variances,
)

HURST = 0.4


def cropped_disc(seed, across, finest):
    return disc_of_waves(coarser_waves(surface_waves(HURST, finest, seed), across))


def independent_disc(seed, across):
    square = self_affine_square(HURST, across, normalised=False, seed=seed)
    return cut_disc(square * np.sqrt(wave_variances(HURST, across)[0]), across)


def test_both_grids_show_the_same_long_waves_at_the_same_points():
    coarse = coarser_waves(surface_waves(HURST, 33, 1), 11)
    same_waves = np.zeros((33, 17), complex)
    same_waves[:6, :6], same_waves[-5:, :6] = coarse[:6], coarse[-5:]
    fine_disc, coarse_disc = disc_of_waves(same_waves), disc_of_waves(coarse)
    shared = fine_disc[1::3, 1::3]  # 33 is three times 11, and the centres coincide
    inside = np.isfinite(coarse_disc) & np.isfinite(shared)
    assert inside.sum() > 80
    np.testing.assert_allclose(shared[inside], coarse_disc[inside], rtol=1e-12, atol=1e-12)


def test_waves_of_a_coarse_grid_lie_within_its_nyquist_circle():
    waves = coarser_waves(surface_waves(HURST, 33, 1), 17)
    rows = np.fft.fftfreq(17, 1 / 17)
    square = rows[:, None] ** 2 + np.arange(9) ** 2
    assert (waves[(square == 0) | (square > 8.5**2)] == 0).all()
    assert (waves[(square > 0) & (square <= 8.5**2)] != 0).all()


def test_cropped_maps_have_mean_variance_and_spectrum_of_independent_maps():
    def statistics(disc):
        heights = np.where(np.isfinite(disc), disc - np.nanmean(disc), 0)
        power = np.abs(np.fft.rfft2(heights)) ** 2
        ring = np.hypot(np.fft.fftfreq(17, 1 / 17)[:, None], np.arange(9)).round()
        rings = [np.log(power[ring == k].mean()) for k in range(1, 9)]
        return [np.nanmean(disc), np.nanvar(disc), np.nanmax(disc), *rings]

    cropped = np.array([statistics(cropped_disc(seed, 17, 65)) for seed in range(600)])
    independent = np.array([statistics(independent_disc(seed, 17)) for seed in range(1000, 1600)])
    difference = cropped.mean(axis=0) - independent.mean(axis=0)
    error = np.sqrt((cropped.var(axis=0) + independent.var(axis=0)) / 600)
    assert np.abs(difference / error).max() < 4
    np.testing.assert_allclose(cropped.var(axis=0), independent.var(axis=0), rtol=0.35)


@pytest.mark.parametrize("hurst", [0.1, 0.9])
def test_variances_of_present_and_missing_waves_add_up_to_all_waves(hurst):
    totals = [sum(wave_variances(hurst, across)) for across in (17, 257, 511, 513, 4097)]
    np.testing.assert_allclose(totals, totals[0], rtol=1e-12)
    wave = np.arange(-600, 601.0)
    square = wave[:, None] ** 2 + wave**2
    inside = (square > 0) & (square <= 512.5**2)
    np.testing.assert_allclose(wave_variances(hurst, 1025)[0], np.sum(square[inside] ** (-1 - hurst)), rtol=1e-4)


def test_curve_has_the_stiffness_of_a_contact_at_the_same_force():
    disc, x = disc_of_waves(surface_waves(HURST, 33, 3)), np.array([0.01, 0.1])
    logarithm, count = curve_of_disc(disc, HURST, x, 1e-4)
    rms = np.sqrt(np.nanvar(disc) + wave_variances(HURST, 33)[1])
    contact = contact_at(Indenter(disc * 1e-3 / rms, 1 / 33), force=4e-3 * x[1], tolerance=1e-6)
    assert abs(logarithm[1] - np.log(4 * x[1] / contact.stiffness)) < 1e-3
    assert 1 <= count[0] < count[1]


def test_curves_depend_on_number_and_grid_of_a_disc_only():
    options = {"until_x": 0.1, "tolerance": 1e-2, "spawn_key": (19,)}
    three = nested_curves(HURST, [33, 17, 9], [0, 3], seed=5, **options)["log_velocity"].values
    last = nested_curves(HURST, [33, 17, 9], [2, 3], seed=5, **options)["log_velocity"].values
    np.testing.assert_array_equal(last, three[2:])
    other = nested_curves(HURST, [33, 17, 9], [2, 3], seed=6, **options)["log_velocity"].values
    assert (last != other).any()
    alone = nested_curves(HURST, [33], [0, 3], seed=5, **options)["log_velocity"].values
    np.testing.assert_array_equal(three[:, :, :1], alone)


def test_second_curve_is_that_of_the_other_side():
    options = {"until_x": 0.1, "tolerance": 1e-2}
    made = nested_curves(HURST, [33], [0, 1], seed=5, spawn_key=(19,), **options)
    disc = disc_of_waves(surface_waves(HURST, 33, np.random.SeedSequence(5, spawn_key=(19, 0))))
    for side, heights in enumerate((disc, -disc)):
        logarithm, count = curve_of_disc(heights, HURST, made["x"].values, 1e-2)
        np.testing.assert_array_equal(made["log_velocity"].values[0, side, 0], logarithm)
        np.testing.assert_array_equal(made["contact_count"].values[0, side, 0], count)
