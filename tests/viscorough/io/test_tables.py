"""Tables as CSV: their contents, in full precision, and contents that are refused."""

import json

import numpy as np
import pytest

from support.contract import refused
from support.curves import random_curve
from support.tables import read_table
from viscorough.io import tables
from viscorough.io.curves import curve_to_content


@pytest.fixture
def path(tmp_path):
    return tmp_path / "curve.csv"


def test_table_is_plain_csv_with_units_in_its_header(path):
    curve = random_curve()
    variables, attributes = curve_to_content(curve)
    tables.write(path, variables, attributes | {"heights": 'a "ψ"\n#.npy'})
    table, units = read_table(path)
    for name, values in table.items():
        np.testing.assert_array_equal(values, getattr(curve, name))
    assert [*units.items()][:4] == [("depth", "m"), ("force", "m2"), ("stiffness", "m"), ("contact_count", "1")]
    lines = path.read_text(encoding="utf-8").splitlines()
    about = dict(line[2:].split(": ", 1) for line in lines if line.startswith("# "))
    assert json.loads(about["heights"]) == 'a "ψ"\n#.npy'
    assert json.loads(about["source"]).startswith("viscorough ")
    assert about["column depth"] == '"depth of indentation u"'


def test_missing_values_are_empty_fields(path):
    attributes = {"long_name": "velocity", "units": "m s-1"}
    columns = {name: (("level",), np.array([1.5, np.nan]), attributes) for name in "vw"}
    tables.write(path, columns, {})
    assert path.read_text(encoding="utf-8").endswith("v (m s-1),w (m s-1)\n1.5,1.5\n,\n")


def test_maps_are_refused_as_tables(path):
    attributes = {"long_name": "height", "units": "m"}
    heights = {"heights": (("y", "x"), np.zeros((2, 2)), attributes)}
    with refused(r"no table of one dimension; a NetCDF file \(\.nc\) is needed"):
        tables.write(path, heights, {})
    assert not path.exists()
