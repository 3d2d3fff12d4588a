"""Tables in CSV and NetCDF files."""

import os

import numpy as np
import pandas as pd
import pytest

from support.cf import violations
from viscorough.io.datasets import read_dataset
from viscorough_study.run.tables import write_table


def test_table_survives_both_files_exactly(tmp_path):
    table = pd.DataFrame({"source": ["discs", "lines"], "beta": [0.1 + 0.2, np.nan], "realizations": [8, 50]})
    table["passed"] = [True, False]
    columns = {name: (f"{name} in words", "1") for name in table} | {"source": ("origin of the curves", None)}
    files = [tmp_path / f"fits.{kind}" for kind in ("csv", "nc")]
    write_table(table, *files, columns=columns, dimension="fit", title="Fits", attributes={"trial": 1})
    pd.testing.assert_frame_equal(pd.read_csv(files[0]), table, check_exact=True)
    ds = read_dataset(files[1])
    assert dict(ds.sizes) == {"fit": 2}
    assert (ds.title, ds.trial) == ("Fits", 1)
    assert ds["beta"].attrs == {"long_name": "beta in words", "units": "1"}
    pd.testing.assert_frame_equal(ds.to_dataframe(), table, check_exact=True, check_names=False, check_index_type=False)
    del columns["beta"]
    with pytest.raises(ValueError, match="beta"):
        write_table(table, tmp_path / "b.csv", tmp_path / "b.nc", columns=columns, dimension="fit", title="")
    assert sorted(os.listdir(tmp_path)) == ["fits.csv", "fits.nc"]


def test_table_without_rows_keeps_what_its_columns_hold(tmp_path):
    columns = {"source": ("origin of the curves", ""), "beta": ("exponent", "1")}
    files = [tmp_path / f"fits.{kind}" for kind in ("csv", "nc")]
    write_table(pd.DataFrame(columns=list(columns)), *files, columns=columns, dimension="fit", title="Fits")
    assert violations(files[1]) == []
