"""Measured surfaces, as the script prepares them."""

import json

import numpy as np
import pytest

from support.workflow import load_script
from viscorough.surfaces.self_affine import self_affine_disc
from viscorough_study.ensembles.surface_files import read_surfaces


def test_prepared_scan_has_its_lengths_in_metres(tmp_path):
    """All lengths differ, so a mix-up would show."""
    disc = self_affine_disc(0.6, 25, rms=0.5, diameter=250.0, seed=1)
    np.save(tmp_path / "scan.npy", disc.heights)
    reading = {"spacing": [10.0, 20.0], "unit": "um", "preparation": {}}
    load_script("prepare_measured").main(
        tmp_path / "scan.npy", tmp_path / "surfaces.nc", name="ground_a", group="ground", **reading
    )
    ((settings, realization, indenter),) = read_surfaces(tmp_path / "surfaces.nc")
    area = disc.elements * 10e-6 * 20e-6
    assert realization.diameter == pytest.approx(2 * np.sqrt(area / np.pi), rel=1e-12)
    assert realization.spacing == pytest.approx(10e-6, rel=1e-12)
    assert indenter.row_spacing == pytest.approx(20e-6, rel=1e-12)
    assert realization.rms == {"disc": pytest.approx(0.5e-6, rel=1e-6)}
    assert (realization.ensemble, realization.number) == ("ground_a", 0)
    assert np.isnan(realization.hurst)
    np.testing.assert_allclose(indenter.heights, 1e-6 * disc.heights, rtol=1e-12)
    assert json.loads(json.dumps(settings))["lengths"]["diameter"] == realization.diameter
    assert (settings["name"], settings["group"]) == ("ground_a", "ground")
