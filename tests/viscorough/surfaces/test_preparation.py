"""Preparation of measured maps for contact, and warnings about maps that need it."""

import numpy as np
import pytest

from support.contract import refused
from viscorough import Indenter, self_affine_disc
from viscorough.surfaces.preparation import doubts, prepare

DX, DY = 0.5, 0.7
ROWS, COLUMNS = 31, 41
X = DX * (np.arange(COLUMNS) - (COLUMNS - 1) / 2)
Y = (DY * (np.arange(ROWS) - (ROWS - 1) / 2))[:, None]
ROUGH = np.random.default_rng(5).standard_normal((ROWS, COLUMNS))
PLANE = 3 + 0.2 * X - 0.1 * Y


def indenter(heights, **options):
    return Indenter(heights, DX, DY, **options)


def test_nodata_crop_and_flip():
    heights = ROUGH.astype("f4")
    heights[3, 4], heights[20, 30], heights[0, 0] = 1e-3 - 9999, 1e38, 77  # the first of them is rounded
    options = {"nodata": (1e-3 - 9999, 1e38), "crop": ((2, 40), (3, 25)), "flip": True}
    surface = prepare(indenter(heights, length_unit="m"), **options)
    expected = heights[3:25, 2:40].copy()
    expected[0, 2] = expected[17, 28] = np.nan
    np.testing.assert_array_equal(surface.heights, -expected)
    assert (surface.spacing, surface.row_spacing, surface.length_unit) == (DX, DY, "m")


def test_a_crop_reaches_the_ends_of_the_map():
    (rows, columns), surface = ROUGH.shape, indenter(ROUGH)
    for first, end in ((0, 1), (0, columns), (columns - 1, columns)):
        cropped = prepare(surface, crop=((first, end), (0, rows)))
        np.testing.assert_array_equal(cropped.heights, ROUGH[:, first:end])
    for first, end in ((3, 3), (4, 3), (0, columns + 1)):
        with refused(f"crop to columns {first}:{end}; within 0:{columns} is allowed"):
            prepare(surface, crop=((first, end), (0, rows)))
    with refused("crop: must be a whole number of at least 0, not -1"):
        prepare(surface, crop=((-1, 3), (0, rows)))


@pytest.mark.parametrize("form", ["mean", "plane"])
def test_detrended_heights_have_no_mean_and_no_tilt(form):
    heights = ROUGH + PLANE
    heights[5:9, 20:] = np.nan
    residual = prepare(indenter(heights), detrend=form).heights
    measured = np.isfinite(heights)
    np.testing.assert_array_equal(np.isfinite(residual), measured)
    for weight in [1] if form == "mean" else [1, X, Y]:
        assert (residual * weight)[measured].mean() == pytest.approx(0, abs=1e-11)
    removed = prepare(indenter(heights - residual), detrend=form).heights
    np.testing.assert_allclose(removed[measured], 0, atol=1e-12)


@pytest.mark.parametrize("radius", [18.0, 1e4, -30.0])
def test_detrend_sphere_is_exact_for_spheres(radius):
    """The caps have polar angles up to 54°; a negative radius gives a hollow."""
    sphere = np.sign(radius) * np.sqrt(radius**2 - X**2 - Y**2)
    residual = prepare(indenter(sphere + 0.2 * X + 5), detrend="sphere").heights
    np.testing.assert_allclose(residual, 0, atol=1e-9 * abs(radius))
    with pytest.raises(ValueError, match="crop to a cap"):
        prepare(indenter(-(np.hypot(X, Y) ** 2)), detrend="sphere")


def test_harmonic_fill_is_exact_for_harmonic_heights():
    """x² − y² and planes are harmonic for the five-point equation on any rectangles; points outside stay nan."""
    heights = PLANE + X**2 - Y**2
    holes = heights.copy()
    holes[4:15, 6:30], holes[20, 20], holes[25:28, 33:36] = np.nan, np.nan, np.nan
    holes[:2, :3] = holes[-1, 10:20] = np.nan
    filled = prepare(indenter(holes), fill="harmonic").heights
    outside = np.zeros(heights.shape, bool)
    outside[:2, :3] = outside[-1, 10:20] = True
    np.testing.assert_allclose(filled, np.where(outside, np.nan, heights), atol=1e-10)


def test_what_cannot_be_prepared_is_refused():
    surface = indenter(np.ones((ROWS, COLUMNS)))
    for options, what in (
        ({"detrend": "cubic"}, "allowed: none, mean, plane, sphere"),
        ({"fill": "mean"}, "none, harmonic"),
        ({"crop": ((0, 42), (0, 3))}, "crop to columns 0:42; within 0:41"),
        ({"nodata": 1.0}, "no height is left"),
    ):
        with refused(what):
            prepare(surface, **options)
    assert prepare(surface) is surface
    with pytest.raises(ValueError, match="two-dimensional"):
        prepare(Indenter(np.arange(3.0), 1.0), flip=True)


# ---- doubts


def test_tilt_is_told_with_numbers():
    rough = ROUGH + 2.0 * X
    (text,) = doubts(indenter(rough))
    assert "rises by 40, 41.2 times the rms height" in text  # 41 columns, 2 per unit of length
    assert "detrend='plane' removes it" in text
    assert doubts(prepare(indenter(rough), detrend="plane")) == []
    assert "nothing is left" in doubts(indenter(PLANE))[0]
    assert "tilted" in doubts(indenter(1e-8 + 1e-11 * rough))[0]
    assert doubts(indenter(1e3 + 1e-12 * rough)) == []  # the rise is lost in the rounding of the heights


def test_enclosed_holes_are_counted():
    holes = ROUGH.copy()
    holes[3:5, 3:5] = holes[9, 9] = holes[0, :5] = np.nan
    (text,) = doubts(indenter(holes))
    assert text.startswith("2 enclosed regions without heights (5 points, 0.39 %)")
    assert doubts(prepare(indenter(holes), fill="harmonic")) == []


@pytest.mark.parametrize(("mark", "points"), [(-9999, 3), (9999, 5), (3.4028234663852886e38, 1), (1000, 4)])
def test_marks_of_missing_points_are_told(mark, points):
    heights = ROUGH.copy()
    heights.flat[:points] = mark
    (text,) = doubts(indenter(heights))
    assert text.startswith(f"{points} points (")
    assert float(text.partition("nodata=")[2].split()[0]) == mark
    assert doubts(prepare(indenter(heights), nodata=mark)) == []


def test_spikes_are_told():
    heights = self_affine_disc(0.8, 65, rms=1.0, diameter=65.0, seed=1).heights.copy()
    heights[30, 30] += 40
    heights[10, 31] += 30
    (text,) = doubts(Indenter(heights, 1.0))
    assert text.startswith("2 single points stand up to ")
