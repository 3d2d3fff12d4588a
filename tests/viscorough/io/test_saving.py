"""What is saved from Python is read as it was, and as the command line reads it."""

import dataclasses

import numpy as np
import pytest

import viscorough
from support.contract import refused
from viscorough.__main__ import main
from viscorough.io import netcdf


@pytest.fixture(scope="module")
def disc():
    return viscorough.self_affine_disc(0.7, 9, rms=0.1, seed=3)


@pytest.mark.parametrize("suffix", [".nc", ".csv"])
def test_loading_curves(tmp_path, disc, suffix):
    curve = viscorough.indent(disc)
    curve.save(str(tmp_path / f"curve{suffix}"))
    loaded = viscorough.load_curve(tmp_path / f"curve{suffix}")
    for field in dataclasses.fields(curve):
        np.testing.assert_array_equal(getattr(loaded, field.name), getattr(curve, field.name))


def test_heights(tmp_path, disc):
    disc = dataclasses.replace(disc, length_unit="um")
    disc.save(tmp_path / "disc.nc")
    loaded = viscorough.read_heights(tmp_path / "disc.nc")
    np.testing.assert_array_equal(loaded.heights, disc.heights)
    assert loaded.length_unit == "um"
    assert loaded.spacing == pytest.approx(disc.spacing, rel=1e-14)


def test_a_contact_has_the_maps_that_the_command_writes(tmp_path, disc, monkeypatch):
    contact = viscorough.contact_at(disc, depth=0.01)
    monkeypatch.chdir(tmp_path)
    contact.save("contact.nc")
    disc.save("disc.nc")
    assert main(["contact", "disc.nc", "--depth", "0.01", "-o", "written.nc"]) == 0
    saved, written = (netcdf.read(name).variables for name in ("contact.nc", "written.nc"))
    assert set(written) - set(saved) == {"heights"}
    for name, variable in saved.items():
        np.testing.assert_allclose(variable.values, written[name].values, rtol=1e-12, atol=1e-15, err_msg=name)


def test_what_is_no_result_is_refused(tmp_path):
    with pytest.raises(TypeError, match="ndarray is no result; an Indenter"):
        viscorough.save(np.zeros(3), tmp_path / "a.nc")


def test_files_without_a_curve_are_named(tmp_path, disc):
    disc.save(tmp_path / "disc.nc")
    with refused(r"disc\.nc: .*a loading curve of viscorough indent is needed"):
        viscorough.load_curve(tmp_path / "disc.nc")
    with refused(r"none\.nc"):
        viscorough.load_curve(tmp_path / "none.nc")
