"""Reading and preparing surfaces from the command line: right numbers or one error line."""

import numpy as np
import pytest
import xarray as xr

from support.command_line import run
from viscorough import Indenter, indent, load_curve, prepare
from viscorough.io.datasets import read_dataset

N = 17
DX, DY = 0.5, 0.75  # micrometres
X, Y = DX * (np.arange(N) - 8), DY * (np.arange(N) - 8)[:, None]
ROUGH = -(X**2 + Y**2) / 200 + 1e-3 * np.random.default_rng(0).standard_normal((N, N))  # micrometres
DEPTHS = "--depths 0.05,0.2"
SPACING = "--spacing '500 nm,0.75 um' --unit um"


pytestmark = pytest.mark.usefixtures("here")


def curve_of(capsys, arguments, *warnings):
    """Return the loading curve and the attributes of the file that indent makes, after a check of its stderr."""
    assert run(f"indent {arguments} -o curve.nc") == 0
    lines, attributes = capsys.readouterr().err.splitlines(), read_dataset("curve.nc").attrs
    assert len(lines) == len(warnings)
    for line, warning in zip(lines, warnings, strict=True):
        assert line.startswith("viscorough indent: warning: ")
        assert warning in line
        assert warning in attributes["warnings"]
    return load_curve("curve.nc"), attributes


def test_channel_and_preparation_are_passed_on_and_recorded(capsys):
    marked = -ROUGH - 3 * X + 2 * Y
    marked[0, :3], marked[8, 8] = -9999, np.nan
    variables = {name: (("y", "x"), values, {"units": "um"}) for name, values in (("a", 0 * ROUGH), ("b", marked))}
    xr.Dataset(variables).to_netcdf("marked.nc")
    preparation = "--nodata -9999 --crop 0:15,0:16 --detrend plane --fill harmonic --flip"
    curve, attributes = curve_of(capsys, f"marked.nc {SPACING} {DEPTHS} --channel b {preparation}")
    surface = Indenter(marked, DX, DY)
    crop = (0, 15), (0, 16)
    surface = prepare(surface, nodata=-9999, crop=crop, detrend="plane", fill="harmonic", flip=True)
    expected = indent(surface, depths=[0.05, 0.2])
    np.testing.assert_allclose(curve.force, 1e-12 * expected.force, rtol=1e-9)
    np.testing.assert_allclose(curve.stiffness, 1e-6 * expected.stiffness, rtol=1e-9)
    assert curve.elements == 15 * 16 - 3
    expected = {"spacing": DX, "row_spacing": DY, "length_unit": "um", "heights": "marked.nc", "channel": "b"}
    assert {name: attributes[name] for name in expected} == expected
    assert set(attributes["preparation"].split()) == set(preparation.split())
