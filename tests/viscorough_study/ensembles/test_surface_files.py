"""Files of surfaces: what is read is what was written, one realization at a time."""

import netCDF4
import numpy as np
import pytest

from support.cf import violations
from support.contract import refused
from viscorough.indenter import Indenter
from viscorough_study.ensembles.batches import Realization
from viscorough_study.ensembles.surface_files import Surfaces, write_surfaces


def surface(name, number, shape, dtype=float):
    """A map with a hole, on rectangles, whose spacings are no sums of powers of two."""
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
    with Surfaces(path) as surfaces:
        assert surfaces.settings == [{"seed": 5, "hurst": 0.3}, {"seed": 6}]
        assert len(surfaces) == 4
        for (realization, indenter), (same, as_written) in zip(surfaces, [*rough, *smooth], strict=True):
            assert realization == same
            np.testing.assert_array_equal(indenter.heights, as_written.heights)
            assert indenter.heights.dtype == as_written.heights.dtype
            spacings = as_written.spacing, as_written.row_spacing, "m"
            assert (indenter.spacing, indenter.row_spacing, indenter.length_unit) == spacings
        assert surfaces[2][0].number == 9
    with netCDF4.Dataset(path) as file:
        group = file["ensemble_0"]
        np.testing.assert_allclose(np.diff(group["x"]), 0.1 / 3)
        np.testing.assert_allclose(np.diff(group["y"]), 0.2 / 7)
        assert group["heights"].dimensions == ("realization", "y", "x")
    assert violations(path) == []


def test_surfaces_are_made_and_written_one_after_the_other(path):
    """Each is dropped before the next is made, and a file of some of them never appears."""
    made = []

    def surfaces():
        for number in range(3):
            assert not path.exists()
            made.append(number)
            yield surface("rough", number, (40, 40))
            (part,) = path.parent.iterdir()
            assert part.suffix == ".part"
        raise ValueError("the last one fails")

    with refused("the last one fails"):
        write_surfaces([({}, 4, surfaces())], path)
    assert made == [0, 1, 2]
    assert not list(path.parent.iterdir())


def test_a_realization_is_read_alone(path, monkeypatch):
    write_surfaces([({}, 50, (surface("rough", number, (30, 30)) for number in range(50)))], path)
    sizes, created = [], Indenter.__post_init__
    monkeypatch.setattr(Indenter, "__post_init__", lambda self: (sizes.append(self.heights.size), created(self))[1])
    with Surfaces(path) as surfaces:
        assert sizes == []
        assert surfaces[31][0].number == 31
    assert sizes == [900]


def test_a_damaged_file_is_named(path):
    path.write_bytes(b"no NetCDF")
    with refused("surfaces.nc: not readable"), Surfaces(path):
        pass


def test_an_error_of_who_reads_is_not_one_of_the_file(path):
    write_surfaces([({}, 1, [surface("rough", 1, (4, 5))])], path)
    with pytest.raises(RuntimeError, match=r"^the solver did not converge$"), Surfaces(path):
        raise RuntimeError("the solver did not converge")
