"""Tables as CSV: what they hold, that they are read back exactly, and which are refused."""

import csv

import numpy as np
import pytest

from support.contract import refused
from support.curves import assert_same_curve, random_curve
from viscorough.io import tables
from viscorough.io.curves import curve_from_content, curve_to_content
from viscorough.io.netcdf import Content, Variable


@pytest.fixture
def path(tmp_path):
    return tmp_path / "curve.csv"


@pytest.mark.parametrize("unit", ["1", "(1e-6 m)"])
def test_curve_survives_a_table_exactly(path, unit):
    curve = random_curve(length_unit=unit)
    tables.write(curve_to_content(curve).with_attributes(heights='a "ψ"\n#.npy'), path)
    content = tables.read(path)
    assert_same_curve(curve_from_content(content), curve)
    assert content.attributes["heights"] == 'a "ψ"\n#.npy'
    assert content.attributes["source"].startswith("viscorough ")
    assert content.variables["depth"].attributes["long_name"] == "depth of indentation u"


def test_table_is_plain_csv_with_units_in_its_header(path):
    curve = random_curve(3, length_unit="um")
    tables.write(curve_to_content(curve), path)
    lines = [line for line in path.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    header, *rows = csv.reader(lines)
    assert header[:4] == ["depth (um)", "force (um2)", "stiffness (um)", "contact_count"]
    assert [float(row[0]) for row in rows] == curve.depth.tolist()
    assert len(header) == len(rows[0]) == 6


def test_missing_values_are_empty_fields(path):
    attributes = {"long_name": "velocity", "units": "m s-1"}
    columns = {name: Variable(("level",), np.array([1.5, np.nan]), attributes) for name in "vw"}
    tables.write(Content(columns, {}), path)
    assert path.read_text(encoding="utf-8").endswith("v (m s-1),w (m s-1)\n1.5,1.5\n,\n")
    assert np.isnan(tables.read(path).variables["w"].values).tolist() == [False, True]


def test_maps_are_no_tables(path):
    attributes = {"long_name": "height", "units": "m"}
    content = Content({"heights": Variable(("y", "x"), np.zeros((2, 2)), attributes)}, {})
    with refused(r"no table of one dimension; a NetCDF file \(\.nc\) is needed"):
        tables.write(content, path)
    assert not path.exists()


@pytest.mark.parametrize("heading", ["depth [um]", "depth[um]", " depth  (um) "])
def test_units_in_other_brackets_are_read(path, heading):
    path.write_text(f"{heading},force (um2)\n1.0,2.0\n", encoding="utf-8")
    variables = tables.read(path).variables
    assert [variables[name].attributes["units"] for name in ("depth", "force")] == ["um", "um2"]


@pytest.mark.parametrize(
    "text",
    [
        *[f"{heading},force\n1.0,2.0\n" for heading in ("depth/um", "depth in um", "depth (um", "um)", "force")],
        *["depth,force\n1.0,2.0\n#N/A,3.0\n2.0,4.0\n", "depth (um);force (um2)\n1,0;2,0\n", "a b\n1.0\n"],
        *["", "# title: only\n", "depth\n", "depth,force\n1.0\n", "depth\none\n", 'depth\n"1.0\n', "\0\n1\n"],
    ],
)
def test_other_texts_are_refused_in_one_line(path, text):
    path.write_text(text, encoding="utf-8")
    with refused(r"curve\.csv: not readable \((?!.*NoneType).*\); a whole table of viscorough is needed"):
        tables.read(path)


def test_attributes_that_no_netcdf_file_could_hold_are_texts_or_ignored(path):
    path.write_text("# a: [1]\n# b: 1e400\n# 1c: 2\n# d: 99999999999999999999\n#\n# e: null\nx (m)\n1.0\n", "utf-8")
    content = tables.read(path)
    assert content.attributes == {"a": "[1]", "b": np.inf, "d": "99999999999999999999", "e": "null"}
    assert content.variables["x"].attributes == {"long_name": "x", "units": "m"}
