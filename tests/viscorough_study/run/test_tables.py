"""Tables in CSV and NetCDF files."""

import os

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from support.cf import violations
from support.command_line import python
from support.contract import refused
from support.workflow import load_script
from viscorough_study.run.tables import read_table, write_table


def test_table_is_read_exactly_from_both_files(tmp_path):
    table = pd.DataFrame({"source": ["discs", "lines"], "beta": [0.1 + 0.2, np.nan], "realizations": [8, 50]})
    table["passed"] = [True, False]
    columns = {name: (f"{name} in words", "1") for name in table} | {"source": ("origin of the curves", None)}
    files = [tmp_path / f"fits.{kind}" for kind in ("csv", "nc")]
    write_table(table, *files, columns=columns, dimension="fit", title="Fits", attributes={"trial": 1})
    pd.testing.assert_frame_equal(pd.read_csv(files[0]), table, check_exact=True)
    ds = xr.load_dataset(files[1])  # as users read it
    assert dict(ds.sizes) == {"fit": 2}
    assert (ds.title, ds.trial) == ("Fits", 1)
    assert ds["beta"].attrs == {"long_name": "beta in words", "units": "1"}
    pd.testing.assert_frame_equal(ds.to_dataframe(), table, check_exact=True, check_names=False, check_index_type=False)
    del columns["beta"]
    with pytest.raises(ValueError, match="beta"):
        write_table(table, tmp_path / "b.csv", tmp_path / "b.nc", columns=columns, dimension="fit", title="")
    assert sorted(os.listdir(tmp_path)) == ["fits.csv", "fits.nc"]


def test_table_without_rows_keeps_the_types_of_its_columns(tmp_path):
    columns = {"source": ("origin of the curves", ""), "beta": ("exponent", "1")}
    files = [tmp_path / f"fits.{kind}" for kind in ("csv", "nc")]
    write_table(pd.DataFrame(columns=list(columns)), *files, columns=columns, dimension="fit", title="Fits")
    assert violations(files[1]) == []


@pytest.fixture
def files(tmp_path):
    """Write the two files of a table of three rows."""
    table = pd.DataFrame({"source": ["discs", "lines", "discs"], "beta": [0.125, 0.25, 0.5]})
    columns = {"source": ("origin of the curves", ""), "beta": ("exponent", "1")}
    files = [tmp_path / f"fits.{kind}" for kind in ("csv", "nc")]
    write_table(table, *files, columns=columns, dimension="fit", title="Fits")
    return files


CHANGES = {
    "a row less": lambda csv: csv[: csv.rindex("discs")],
    "part of a number": lambda csv: csv.removesuffix("5\n"),
    "no newline": lambda csv: csv.removesuffix("\n"),
    "another number": lambda csv: csv.replace("0.25", "0.35"),
    "nothing": lambda csv: "",
}


@pytest.mark.parametrize("change", CHANGES)
def test_truncated_or_changed_table_is_refused(files, change):
    csv, nc = files
    assert read_table(csv)["beta"].tolist() == [0.125, 0.25, 0.5]
    csv.write_text(CHANGES[change](csv.read_text()))
    with refused(r"fits\.csv: not readable \(it does not match fits\.nc, which was written with it\); remove both"):
        read_table(csv)
    with refused(r"fits\.csv"):
        load_script("plot").main("a.png", figure="exponent", scaling=str(csv))
    nc.unlink()
    with refused(r"fits\.nc: not readable"):
        read_table(csv)


def test_missing_texts_are_read_as_requested(files):
    csv, _ = files
    write_table(
        pd.DataFrame({"reason": ["", "NA"], "beta": [0.5, np.nan]}),
        *files,
        columns={"reason": ("reason", ""), "beta": ("exponent", "1")},
        dimension="fit",
        title="Fits",
    )
    assert read_table(csv)["reason"].isna().tolist() == [True, True]
    assert read_table(csv, keep_default_na=False, na_values=[""])["reason"].tolist()[1] == "NA"


def test_reading_imports_no_xarray():
    """Jobs that draw a figure only read tables; the import would take a sixth of their time to start."""
    python("-c", "import sys, viscorough_study.run.tables; assert 'xarray' not in sys.modules")
