"""What is saved from Python is read as it was, and as the command line reads it."""

import dataclasses

import numpy as np
import pytest

import viscorough
from support.contract import refused


@pytest.fixture(scope="module")
def disc():
    return viscorough.self_affine_disc(0.7, 9, rms=0.1, seed=3)


@pytest.mark.parametrize("suffix", [".nc", ".csv"])
def test_loading_curves(tmp_path, disc, suffix):
    curve = viscorough.indent(disc)
    viscorough.save_curve(curve, str(tmp_path / f"curve{suffix}"))
    loaded = viscorough.load_curve(tmp_path / f"curve{suffix}")
    for field in dataclasses.fields(curve):
        np.testing.assert_array_equal(getattr(loaded, field.name), getattr(curve, field.name))


def test_heights(tmp_path, disc):
    disc = dataclasses.replace(disc, length_unit="um")
    viscorough.save_heights(disc, tmp_path / "disc.nc")
    loaded = viscorough.read_heights(tmp_path / "disc.nc")
    np.testing.assert_array_equal(loaded.heights, disc.heights)
    assert loaded.length_unit == "um"
    assert loaded.spacing == pytest.approx(disc.spacing, rel=1e-14)


def test_files_without_a_curve_are_named(tmp_path, disc):
    viscorough.save_heights(disc, tmp_path / "disc.nc")
    with refused(r"disc\.nc: .*a loading curve of viscorough indent is needed"):
        viscorough.load_curve(tmp_path / "disc.nc")
    with refused(r"none\.nc"):
        viscorough.load_curve(tmp_path / "none.nc")
