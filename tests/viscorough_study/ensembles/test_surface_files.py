"""Files of surfaces: surfaces are read exactly as written, one realization at a time."""

import netCDF4
import numpy as np
import pytest

from support.cf import violations
from support.contract import refused
from viscorough.surfaces.indenter import Indenter
from viscorough_study.ensembles.realization import Realization
from viscorough_study.ensembles.surface_files import read_surfaces, write_surfaces


def surface(name, number, shape, dtype=float):
    """Return a map with a hole, on rectangles, whose spacings are no sums of powers of two."""
    heights = np.random.default_rng(number).normal(size=shape).astype(dtype)
    heights[0, 1] = np.nan
    indenter = Indenter(heights, 0.1 / 3, 0.2 / 7, length_unit="m")
    return Realization(name, number, 0.3, 1 / 7, indenter.spacing, {"disc": 0.1 + number, "square": 1 / 3}), indenter


@pytest.fixture
def path(tmp_path):
    return tmp_path / "surfaces.nc"


def test_surfaces_are_read_as_they_were_written(path):
    rough = [surface("rough", number, (4, 5)) for number in (7, 8, 9)]
    smooth = [surface("smooth", 0, (3, 2), np.float32)]
    write_surfaces([({"seed": 5, "hurst": 0.3}, 3, iter(rough)), ({"seed": 6}, 1, smooth)], path)
    settings, *read = zip(*read_surfaces(path), strict=True)
    assert settings == (*3 * ({"seed": 5, "hurst": 0.3},), {"seed": 6})
    for realization, indenter, (same, as_written) in zip(*read, [*rough, *smooth], strict=True):
        assert realization[:-1] == same[:-1]  # surfaces have no until_x
        np.testing.assert_array_equal(indenter.heights, as_written.heights)
        assert indenter.heights.dtype == as_written.heights.dtype
        spacings = as_written.spacing, as_written.row_spacing, "m"
        assert (indenter.spacing, indenter.row_spacing, indenter.length_unit) == spacings
    with netCDF4.Dataset(path) as file:
        group = file["ensemble_0"]
        np.testing.assert_allclose(np.diff(group["x"]), 0.1 / 3)
        np.testing.assert_allclose(np.diff(group["y"]), 0.2 / 7)
        assert group["heights"].dimensions == ("realization", "y", "x")
    assert violations(path) == []


def test_error_names_a_damaged_file(path):
    path.write_bytes(b"no NetCDF")
    with refused("surfaces.nc: not readable"):
        next(read_surfaces(path))
