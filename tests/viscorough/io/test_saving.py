"""What is saved from Python is read as it was, and as the command line reads it."""

import dataclasses

import numpy as np
import pytest

import viscorough
from support.contract import refused

DISC = viscorough.self_affine_disc(0.7, 9, rms=0.1, seed=3)


def test_heights(tmp_path):
    dataclasses.replace(DISC, length_unit="um").save(tmp_path / "disc.nc")
    loaded = viscorough.read_heights(tmp_path / "disc.nc")
    np.testing.assert_array_equal(loaded.heights, DISC.heights)
    assert loaded.length_unit == "um"
    assert loaded.spacing == pytest.approx(DISC.spacing, rel=1e-14)


def test_what_is_no_result_is_refused(tmp_path):
    with pytest.raises(TypeError, match="ndarray is no result; an Indenter"):
        viscorough.save(np.zeros(3), tmp_path / "a.nc")


def test_files_without_a_curve_are_named(tmp_path):
    DISC.save(tmp_path / "disc.nc")
    with refused(r"disc\.nc: .*a loading curve of viscorough indent is needed"):
        viscorough.load_curve(tmp_path / "disc.nc")
    with refused(r"none\.nc"):
        viscorough.load_curve(tmp_path / "none.nc")
