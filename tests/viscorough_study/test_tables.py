"""Tables in CSV and NetCDF files and as pages of HTML."""

import os
import re

import numpy as np
import pandas as pd
import pytest

from support.cf import violations
from support.study import ROOT
from viscorough.io.datasets import read_dataset
from viscorough_study.html_table import html_table
from viscorough_study.tables import write_table


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


# ---- as pages


def cells(page):
    """The texts of the cells of every row."""
    rows = re.findall("<tr.*?</tr>", page, re.DOTALL)
    return [[re.sub("<.*?>", "", cell) for cell in re.findall("<t[hd].*?</t[hd]>", row, re.DOTALL)] for row in rows]


def page_of(table, columns, folder, title="Fits"):
    files = folder / "fits.csv", folder / "fits.nc"
    write_table(table, *files, columns=columns, dimension="fit", title=title)
    return html_table((ROOT / "workflow/page/table.html.jinja").read_text(), *files)


def test_every_row_and_column_is_shown(tmp_path):
    table = pd.DataFrame(
        {"name": ["a<b", "c & d"], "beta": [1 / 3, np.nan], "count": [12345678, 0], "passed": [True, False]}
    )
    columns = {"name": ("which", None), "beta": ("exponent", "1"), "count": ("how many", "m"), "passed": ("yes?", "1")}
    page = page_of(table, columns, tmp_path, "Fits <1>")
    rows = [["a&lt;b", "0.3333", "12345678", "yes"], ["c &amp; d", "", "0", "no"]]
    assert [[cell.strip() for cell in row] for row in cells(page)] == [list(columns), *rows]
    for text in ("Fits &lt;1&gt;", "2 rows", "fits.csv", "how many [m]", "exponent"):
        assert text in page
    assert "http" not in page, "it opens offline"
    assert cells(page_of(table[["beta"]][:0], {"beta": ("exponent", "1")}, tmp_path)) == [["beta"]]
